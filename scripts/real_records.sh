#!/bin/sh
# Every measured record of ../shared/data through the program, and a Bouc-Wen model beside it; writes
# the numbers and figures of docs/real-*.md anew.
#
#   scripts/real_records.sh [damper|rubber|mr|beam]…
#
# Uses the release build and the Python environment that scripts/setup.sh makes.
set -eu
cd "$(dirname "$0")/.."
python=${PYTHON:-.venv/bin/python}
cargo build --release --locked --bin iwan
exec "$python" scripts/real_records.py --iwan "${CARGO_TARGET_DIR:-target}/release/iwan" "$@"
