#!/usr/bin/env bash
# Every measured record of ../shared/data through the program, and a Bouc-Wen model beside it; writes
# the numbers and figures of docs/real-*.md anew.
#
#   scripts/real_records.sh [damper|rubber|mr|beam]…
#
# Uses the release build and the Python environment that scripts/setup.sh makes; PYTHON names another.
set -euo pipefail
# Said before scripts/setup.sh is sourced, which sets PYTHON.
python=${PYTHON:-.venv/bin/python}
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$REPOSITORY"
exec "$python" scripts/real_records.py --iwan "$IWAN" "$@"
