#!/usr/bin/env bash
# Measured records of others through the program, and a Bouc-Wen model beside it; writes the numbers and
# figures of docs/real-*.md anew.
#
#   scripts/real_records.sh [damper|rubber|mr|beam]…
#
# The records are no part of the repository; docs/real-*.md say whose they are. They are looked for in the
# folder that IWAN_REAL_DATA names, else in shared/data beside the repository: friction_damper_backlash,
# rubber_bearing, mr_damper, brake_reuss_beam. Exit status 2 where there is none.
#
# Uses the release build and the Python environment that scripts/setup.sh makes; PYTHON names another.
set -euo pipefail
# Said before scripts/setup.sh is sourced, which sets PYTHON.
python=${PYTHON:-.venv/bin/python}
if [ -n "${IWAN_REAL_DATA:-}" ]; then
    IWAN_REAL_DATA=$(realpath "$IWAN_REAL_DATA")
    export IWAN_REAL_DATA
fi
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$REPOSITORY"
exec "$python" scripts/real_records.py --iwan "$IWAN" "$@"
