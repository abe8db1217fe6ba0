#!/usr/bin/env bash
# The main job on the bundled record: identify, diagnose, report, export, and a co-simulation of the
# exported FMU in fmpy, plotted over the measurement.
#
#   scripts/demo.sh [FOLDER]      results go to FOLDER (default: result/ in the repository)
set -euo pipefail

if [ $# -gt 1 ] || [[ "${1-}" == -* ]]; then
    echo "usage: scripts/demo.sh [FOLDER]" >&2
    exit 2
fi
target=${1-}
case "$target" in
"" | /*) ;;
*) target="$PWD/$target" ;;
esac

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
result=${target:-"$REPOSITORY/result"}
records=("$REPOSITORY"/examples/bolt-*.csv)

started=$SECONDS
say "diagnosing ${#records[@]} records of examples/"
"$IWAN" diagnose "${records[@]}" -o "$result"
diagnosed=$((SECONDS - started))

say "co-simulating joint.fmu in fmpy"
"$PYTHON" "$REPOSITORY/scripts/cosimulate.py" "$result" "${records[@]}"
say "done: diagnosis $diagnosed s, co-simulation $((SECONDS - started - diagnosed)) s"

cat <<EOF

report          $result/report.html
diagnosis       $result/diagnosis.json
joint           $result/joint.json
FMU             $result/joint.fmu
co-simulation   $result/cosimulation.svg
EOF
