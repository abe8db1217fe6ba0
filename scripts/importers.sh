#!/usr/bin/env bash
# The exported joint in every importer that the registries offer, beside `iwan simulate` and beside the
# same joint made with pythonfmu. Prints a table; with --readme it also goes into README.md.
#
#   scripts/importers.sh [--quick] [--readme]
#
#   --quick     what installs in seconds and takes no compiler, and no pythonfmu: a step of the tests
#
# The importers live in an environment of their own, target/importers. Exit status 0: all of them
# answer as `iwan simulate`; 1: one does not; 4: all that were run do, but some could not be had, each
# told in a line `NOT RUN`; 2: usage.
set -euo pipefail

quick=()
readme=()
for argument in "$@"; do
    case "$argument" in
    --quick) quick=(--quick) ;;
    --readme) readme=(--readme) ;;
    *) echo "usage: scripts/importers.sh [--quick] [--readme]" >&2; exit 2 ;;
    esac
done

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
tools="$REPOSITORY/scripts/importers"
folder="$REPOSITORY/target/importers"
python="$folder/environment/bin/python"
mkdir -p "$folder"

# Prepares the environment once. A package that the index lacks must not keep the others away: each
# line is then tried alone, and what is missing is told by table.py.
install() {
    local install=("$python" -m pip install --quiet --disable-pip-version-check --retries 1)
    "${install[@]}" --requirement "$1" >&2 && return
    local line missing=no
    while read -r line; do
        case "$line" in "" | "#"*) continue ;; esac
        # One argument, with what it says of the version of Python.
        "${install[@]}" "$line" >&2 || missing=yes
    done <"$1"
    [ "$missing" = no ]
}

lists=(requirements)
[ ${#quick[@]} -gt 0 ] || lists+=(requirements-more)
for list in "${lists[@]}"; do
    cmp -s "$tools/$list.txt" "$folder/$list.txt" && continue
    say "fetching the importers of $list.txt"
    [ -x "$python" ] || python3 -m venv "$folder/environment"
    if install "$tools/$list.txt"; then
        cp "$tools/$list.txt" "$folder/$list.txt"
    else
        say "some importers could not be fetched (messages above)"
    fi
done
"$python" -c 'import fmpy, numpy' 2>/dev/null || {
    echo "NOT RUN: no importer at all: the package index has no fmpy (messages above)"
    exit 4
}
if [ ${#quick[@]} -eq 0 ]; then
    say "building the host of the crate fmu-runner"
    (cd "$tools/fmu-runner" &&
        CARGO_TARGET_DIR="$folder/fmu-runner" cargo build --quiet --locked --release >&2) ||
        say "fmu-runner could not be built (messages above)"
fi
# ecospy's library looks for the threading library that pip puts into the environment.
export LD_LIBRARY_PATH="$folder/environment/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
export IWAN_FMU_LIBRARY="$FMU_LIBRARY"
arguments=(--iwan "$IWAN" --folder "$folder" ${quick[@]+"${quick[@]}"})
[ ${#readme[@]} -eq 0 ] || arguments+=(--readme "$REPOSITORY/README.md")
exec "$python" "$tools/table.py" "${arguments[@]}"
