#!/usr/bin/env bash
# How often the finder is right, measured over hundreds of blind cases drawn from one seed.
#
#   scripts/scorecard.sh [ROUNDS] [SEED] [OUTPUT_DIR] [WORDS…]
#
# One round: every effect of the catalogue (23) at 0.1, 0.3, 1 and 5 times the noise, every effect outside it
# (7) likewise, 25 clean records under each of five kinds of noise, 20 pairs of effects, 12 clean records
# and 12 with an effect that are cut from a longer test or driven from another zero, as many of one joint that
# goes on through all files, and the next experiment for whatever ended ambiguous, a dozen: some 300 cases,
# about an hour on two cores. JOBS=2 sets how many run at a time. WORDS go to the laboratory:
# `--readme README.md --figures docs/figures` fills the README's block and copies the drawings, `--only power,clean` leaves out the rest.
#
# Writes OUTPUT_DIR/*.jsonl, one line a case as it comes, and after every round scorecard.json,
# scorecard.md, matrix.svg, power.svg and reliability.svg; prints the tables. Called again with the same
# seed and folder it goes on where it stopped, with the program it began with (OUTPUT_DIR/iwan).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
rounds=${1:-3}
seed=${2:-$(date +%s)}
output=${3:-result/scorecard-$seed}
[ $# -gt 3 ] && shift 3 || shift $#
# Said before scripts/setup.sh is sourced, which sets PYTHON.
python=${PYTHON:-.venv/bin/python}

mkdir -p "$output"
if [ ! -x "$output/iwan" ]; then
    source scripts/setup.sh
    cp "$IWAN" "$output/iwan"
    git describe --always --dirty --exclude '*' >"$output/commit" 2>/dev/null || echo unknown >"$output/commit"
fi
# One case per job: threads within a case would only fight over the cores.
export RAYON_NUM_THREADS=1 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 PYTHONPATH=tests
"$python" -m laboratory scorecard --seed "$seed" --rounds "$rounds" --iwan "$output/iwan" \
    --jobs "${JOBS:-2}" --commit "$(cat "$output/commit")" -o "$output" "$@"
