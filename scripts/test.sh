#!/usr/bin/env bash
# Every check of the repository. The last line counts the steps; the exit status is 1 where one failed.
# A step that ends with status 4 passed as far as this machine lets it run; what was not run it tells in
# lines `NOT RUN`, and the end of the output names it again.
#
#   scripts/test.sh             all steps
#   scripts/test.sh WORD…       only the steps whose name contains one of the words
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$REPOSITORY"

for component in fmt clippy; do
    cargo "$component" --version >/dev/null 2>&1 ||
        stop "cargo $component is missing: rustup component add rustfmt clippy"
done

# A folder whose name has a space, as users have them.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
demo_result="$scratch/demo result"

# What the steps below may rely on.
export PYTHONPATH="$REPOSITORY/tests"
export IWAN PYTHON
export IWAN_FMU_LIBRARY="$FMU_LIBRARY"

# Some of these tests are of measured records that are no part of the repository.
rust_tests() {
    cargo test --locked --quiet --release --features importer || return
    local records=${IWAN_REAL_DATA:-$REPOSITORY/../shared/data}
    [ -d "$records" ] && return
    echo "NOT RUN: three tests of measured records of others: no folder $records (IWAN_REAL_DATA names another; docs/real-*.md say whose they are)"
    return 4
}

names=()
commands=()
step() {
    names+=("$1")
    commands+=("$(printf '%q ' "${@:2}")")
}

#    name                             command
step "Rust formatting"                cargo fmt --check
step "Rust lints"                     cargo clippy --locked --quiet --release --all-targets --features importer -- -D warnings
step "Python formatting"              "$PYTHON" -m ruff format --check --quiet .
step "Python lints"                   "$PYTHON" -m ruff check --quiet .
step "Rust tests"                     rust_tests
step "laboratory"                     "$PYTHON" -m unittest -q laboratory.self_test blind.self_test
step "blind tests"                    "$PYTHON" tests/blind/run.py --iwan "$IWAN"
step "what was once missed"           "$PYTHON" tests/blind/put_again.py --iwan "$IWAN"
step "demo"                           scripts/demo.sh "$demo_result"
step "what the demo leaves"           "$PYTHON" tests/demo/check.py "$demo_result"
step "FMU in fmpy"                    "$PYTHON" tests/fmu/run_fmpy.py
step "the demo's FMU in fmpy"        "$PYTHON" tests/fmu/run_fmpy.py "$demo_result/joint.fmu"
step "coupled resonator"              "$PYTHON" -m unittest -q resonator_decay
step "FMU in other importers"         scripts/importers.sh --quick
step "FMU on other platforms"         scripts/build-platforms.sh --check

wanted() {
    [ $# -eq 1 ] && return 0
    local word
    for word in "${@:2}"; do
        [[ "$1" == *"$word"* ]] && return 0
    done
    return 1
}

passed=0
failed=()
partly=()
for i in "${!names[@]}"; do
    name=${names[$i]}
    wanted "$name" "$@" || continue
    printf '\n== %d/%d %s\n' "$((i + 1))" "${#names[@]}" "$name"
    begun=$SECONDS
    status=0
    eval "${commands[$i]}" || status=$?
    case "$status" in
    0)
        passed=$((passed + 1))
        outcome=passed
        ;;
    4)
        passed=$((passed + 1))
        partly+=("$name")
        outcome="passed, not all of it was run"
        ;;
    *)
        failed+=("$name")
        outcome=FAILED
        ;;
    esac
    printf '== %s: %s, %d s (%d s in all)\n' "$name" "$outcome" "$((SECONDS - begun))" "$((SECONDS - SETUP_STARTED))"
done

if [ $((passed + ${#failed[@]})) -eq 0 ]; then
    stop "no step is named like that"
fi
echo
for name in ${partly[@]+"${partly[@]}"}; do
    echo "passed in part: $name (see its lines NOT RUN)"
done
for name in ${failed[@]+"${failed[@]}"}; do
    echo "failed: $name"
done
echo "$passed passed, ${#failed[@]} failed"
[ ${#failed[@]} -eq 0 ]
