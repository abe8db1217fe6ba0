#!/usr/bin/env bash
# The exported joint in every importer that the registries offer, beside `iwan simulate` and beside the
# same joint made with pythonfmu. Prints a table; with --readme it also goes into README.md.
#
#   scripts/importers.sh [--readme]
#
# The importers live in an environment of their own, target/importers. Exit status 1 where an importer
# does not answer as `iwan simulate`.
set -euo pipefail

case "${1-}" in
"" | --readme) ;;
*) echo "usage: scripts/importers.sh [--readme]" >&2; exit 2 ;;
esac
readme=${1-}

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
tools="$REPOSITORY/scripts/importers"
folder="$REPOSITORY/target/importers"
python="$folder/environment/bin/python"
mkdir -p "$folder"
if ! cmp -s "$tools/requirements.txt" "$folder/installed.txt"; then
    say "fetching the importers (about 150 MB)"
    python3 -m venv "$folder/environment"
    "$python" -m pip install --quiet --disable-pip-version-check --requirement "$tools/requirements.txt" >&2
    cp "$tools/requirements.txt" "$folder/installed.txt"
fi
# ecospy's library looks for the threading library that pip puts into the environment.
export LD_LIBRARY_PATH="$folder/environment/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
export IWAN_FMU_LIBRARY="$FMU_LIBRARY"
arguments=(--iwan "$IWAN" --folder "$folder")
[ -z "$readme" ] || arguments+=(--readme "$REPOSITORY/README.md")
exec "$python" "$tools/table.py" "${arguments[@]}"
