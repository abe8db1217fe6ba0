#!/bin/sh
# The score of the finder over hundreds of blind cases, at three strengths.
#
#   scripts/scorecard.sh [CASES_PER_STRENGTH] [SEED] [OUTPUT_DIR]
#
# Uses the release build and the Python environment that scripts/setup.sh makes. Writes one
# blind.json per strength, scorecard.json and scorecard.svg; prints the matrices and the totals.
set -eu
cd "$(dirname "$0")/.."
cases=${1:-120}
seed=${2:-$(date +%s)}
output=${3:-result/scorecard}
python=${PYTHON:-.venv/bin/python}
jobs=${JOBS:-2}

cargo build --release --bin iwan
iwan=${CARGO_TARGET_DIR:-target}/release/iwan
mkdir -p "$output"
for span in 0.3:1 1:2 2:5; do
    echo "== misfit after refit, over noise: $span"
    PYTHONPATH=tests "$python" -m laboratory blind --seed "$seed" --cases "$cases" \
        --iwan "$iwan" --ratio "$span" --jobs "$jobs" -o "$output/ratio-$(echo "$span" | tr : -)"
done
PYTHONPATH=tests "$python" -m laboratory scorecard "$output"/ratio-*/blind.json -o "$output"
echo "seed $seed"
