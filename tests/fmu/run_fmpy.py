"""Runs exported joints in fmpy and holds them against `iwan simulate`.

    python tests/fmu/run_fmpy.py [--iwan target/release/iwan] [JOINT.fmu …]

Without archives six are exported first, each for FMI 2.0 and FMI 3.0: driven in force and in
displacement, without causes, with two, and with all; the archive that the environment variable
IWAN_FMU names is run too. Exit status 0 where all passed; the last line says `N passed, N failed`.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import traceback
from pathlib import Path

import fmpy_archive
import fmpy_capabilities
import fmpy_dependencies
import fmpy_hosts
import fmpy_simulation
import fmpy_three

BOLT = {
    "format": "iwan-joint/1",
    "version": "0.1.0",
    "units": "SI",
    "density": {
        "family": "four_parameter",
        "slip_force": 1000.0,
        "stiffness": 1.5e7,
        "exponent": -0.4,
        "ratio": 0.3,
    },
    "series_stiffness": 4e7,
    "causes": [],
    "provenance": {
        "date": "2024-05-01",  # as hands write it
        "records": [
            {
                "name": "bolt.csv",
                "samples": 2001,
                "sha256": "0" * 64,
                "duration": 2.0,
                "sample_interval": 1e-3,
            }
        ],
    },
}
CAUSES = [
    {
        "name": "pinning",
        "parameters": {
            "stiffness": 2e6,
            "gap_positive": 1e-5,
            "gap_negative": 2e-5,
            "rounding": 0,
            "stiffness_ratio": 1,
        },
    },
    {"name": "viscous_damping", "parameters": {"coefficient": 500.0, "contact_coefficient": 200.0}},
]
OTHERS = {
    "quadratic_damping": {"coefficient": 1e4, "contact_coefficient": 2e3},
    "clearance": {"gap": 2e-6, "seating_force": 20.0, "drag": 5.0},
    "slack_growth": {"growth": 1e-9, "threshold": 100.0, "seating_force": 20.0, "drag": 4.0},
    "cubic_stiffness": {
        "cubic_compliance": 1e-15,
        "levelling": 1e-7,
        "across": 1e18,
        "across_levelling": 1e9,
        "across_contact": 1e18,
        "across_contact_levelling": 1e9,
    },
    "joint_opening": {
        "compliance": 2e-9,
        "opening_force": 50.0,
        "rounding": 5.0,
        "closed_stiffness": 1e5,
        "closing": 1e-7,
        "contact_stiffness": 1e5,
        "contact_closing": 1e-7,
        "opening_displacement": 1e-7,
        "contact_opening": 1e-7,
    },
    "asymmetric_friction": {"asymmetry": 0.1},
    "normal_load_variation": {
        "force_sensitivity": 1e-4,
        "displacement_sensitivity": 1e3,
        "even_force_sensitivity": 2e-5,
        "even_displacement_sensitivity": 1e2,
        "force_curvature": 1e-8,
        "displacement_curvature": 1e6,
    },
    "preload_loss": {"loss": 0.1, "energy": 1.0, "tail": 0.3, "per_path": 10.0},
    "running_in": {
        "deficit": 0.1,
        "energy": 0.1,
        "tail": 0.0,
        "per_path": 5.0,
        "softness": 1e-9,
    },
    "rate_dependent_friction": {"gain": 0.01, "reference_rate": 1e-5, "memory": 0.01},
    "velocity_weakening": {"drop": 0.05, "stribeck_rate": 1e-3, "memory": 0.01, "exponent": 0.8},
    "static_friction_drop": {"excess": 0.1, "breakaway_distance": 0.0, "sharpness": 2.0},
    "creep": {"compliance": 2e-9, "time_constant": 0.05, "faster": 0.5, "slower": 0.5},
}
EVERY = CAUSES + [{"name": name, "parameters": values} for name, values in OTHERS.items()]


def export(iwan: Path, folder: Path) -> list[Path]:
    """Archives of one bolt, in both drives: without causes, with two, and with all there are."""
    archives = []
    joints = (("bolt", []), ("bolt-with-causes", CAUSES), ("bolt-with-every-cause", EVERY))
    for name, causes in joints:
        joint = folder / f"{name}.json"
        joint.write_text(json.dumps({**BOLT, "causes": causes}))
        for drive in ("force", "displacement"):
            archive = folder / f"{name}-{drive}.fmu"
            command = [iwan, "export", joint, "--drive", drive, "-o"]
            subprocess.run([*command, archive], check=True)
            subprocess.run([*command, three(archive), "--fmi", "3"], check=True)
            archives.append(archive)
    if "IWAN_FMU" in os.environ:
        archives.append(Path(os.environ["IWAN_FMU"]))
    return archives


def three(archive: Path) -> Path:
    """Where the FMI 3.0 archive of the same joint stands, if there is one."""
    return archive.with_suffix(".3.fmu")


def passes(name: str, check, subject) -> bool:
    try:
        check(subject)
    except Exception:  # whatever went wrong, the check failed and the others still run
        print(f"FAILED {name}")
        traceback.print_exc(file=sys.stdout)
        return False
    print(f"passed {name}")
    return True


def main() -> int:
    root = fmpy_archive.ROOT
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("archives", nargs="*", type=Path, metavar="JOINT.fmu")
    program = os.environ.get("IWAN", root / "target/release/iwan")
    parser.add_argument("--iwan", type=Path, default=program)
    arguments = parser.parse_args()
    iwan = arguments.iwan.resolve()
    outcomes = []
    with tempfile.TemporaryDirectory() as folder:
        archives = arguments.archives or export(iwan, Path(folder))
        for archive in archives:
            for check in fmpy_archive.CHECKS:
                outcomes.append(passes(f"{archive.name} {check.__name__}", check, archive))
            unit = fmpy_simulation.Unit(archive, iwan)
            declared = [*fmpy_capabilities.CHECKS, *fmpy_dependencies.CHECKS]
            for check in [*fmpy_simulation.checks(unit), *declared]:
                outcomes.append(passes(f"{archive.name} {check.__name__}", check, unit))
            if three(archive).exists():
                pair = fmpy_three.Pair(archive, three(archive), iwan)
                declared = [*fmpy_capabilities.CHECKS_OF_3, *fmpy_dependencies.CHECKS_OF_3]
                for check in [*fmpy_three.CHECKS, *declared]:
                    outcomes.append(passes(f"{pair.archive.name} {check.__name__}", check, pair))
        made = [archive for archive in archives if archive.is_relative_to(folder)]
        for check in fmpy_hosts.CHECKS if made else []:
            with tempfile.TemporaryDirectory() as place:
                hosted = fmpy_hosts.Pair(made, Path(place))
                outcomes.append(passes(f"all archives {check.__name__}", check, hosted))
    print(f"{sum(outcomes)} passed, {len(outcomes) - sum(outcomes)} failed")
    return 0 if outcomes and all(outcomes) else 1


if __name__ == "__main__":
    sys.exit(main())
