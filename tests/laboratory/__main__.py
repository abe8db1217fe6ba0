"""Command line of the virtual laboratory: python -m laboratory COMMAND."""

import argparse
import sys
import time

from . import demo as demo_records
from . import noise_free
from .blind import blind_test
from .case import draw_case, write_case
from .effects import CATALOGUE, EFFECTS
from .follow_up import follow_ups, measure_dummy, run_load
from .scorecard import card


def _span(text):
    low, _, high = text.partition(":")
    return float(low), float(high or low)


def main(arguments=None):
    """Run one command; returns the exit status."""
    parser = argparse.ArgumentParser(prog="laboratory", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    draw = commands.add_parser("draw", help="records of one case, and the truth beside them")
    draw.add_argument("--case", type=int, default=0)
    draw.add_argument("--effect", default=None)
    draw.add_argument("--ratio", type=float, default=None, help="misfit after refit over noise")
    blind = commands.add_parser("blind", help="draw cases, run the finder, judge it")
    blind.add_argument("--cases", type=int, default=24)
    blind.add_argument("--iwan", required=True, help="path of the command line")
    blind.add_argument("--effects", default=None, help="names, separated by commas")
    blind.add_argument("--ratio", type=_span, default=(1.0, 5.0), help="R or LOW:HIGH")
    blind.add_argument("--jobs", type=int, default=2)
    blind.add_argument("--pass", dest="more", default="", help="further words for diagnose")
    run = commands.add_parser("run", help="the same hidden joint under a given load")
    run.add_argument("--truth", required=True, help="truth.json of the case")
    run.add_argument("--load", required=True, help="time, and force or displacement")
    dummy = commands.add_parser("dummy", help="a monolithic specimen through the same chain")
    dummy.add_argument("--truth", required=True, help="truth.json of the case")
    follow = commands.add_parser("follow_up", help="ambiguous cases before and after")
    follow.add_argument("--cases", type=int, default=12)
    follow.add_argument("--iwan", required=True, help="path of the command line")
    follow.add_argument("--effects", default="viscous_damping,sensor_delay")
    follow.add_argument("--ratio", type=_span, default=(1.0, 2.0), help="R or LOW:HIGH")
    follow.add_argument("--dummy", action="store_true", help="settle by a dummy instead")
    known = commands.add_parser("noise_free", help="records of a known power-law joint")
    known.add_argument("--softening", type=float, default=None, help="of the tangent, at the peak")
    demo = commands.add_parser("demo", help="the example records")
    board = commands.add_parser("scorecard", help="several blind tests on one card")
    board.add_argument("tests", nargs="+", help="blind.json files")
    commands.add_parser("effects", help="names of the effects")
    for one in (draw, blind, known, follow):
        one.add_argument("--seed", type=int, default=None, help="from the clock unless given")
    for one in (draw, blind, known, demo, board, run, dummy, follow):
        one.add_argument("-o", "--output", required=True)
    asked = parser.parse_args(arguments)
    seed = getattr(asked, "seed", None)
    seed = int(time.time()) if seed is None else seed
    if asked.command == "draw":
        records, truth, style = draw_case(seed, asked.case, asked.effect, asked.ratio)
        for path in write_case(asked.output, records, truth, style):
            print(path)
        print(f"seed {seed}", file=sys.stderr)
    elif asked.command == "blind":
        effects = asked.effects.split(",") if asked.effects else None
        more = tuple(asked.more.split())
        blind_test(
            seed, asked.cases, asked.iwan, asked.output, effects, asked.ratio, asked.jobs, more
        )
    elif asked.command == "run":
        print(run_load(asked.truth, asked.load, asked.output))
    elif asked.command == "dummy":
        print(measure_dummy(asked.truth, asked.output))
    elif asked.command == "follow_up":
        effects = asked.effects.split(",")
        follow_ups(
            seed, asked.cases, asked.iwan, asked.output, effects, asked.ratio, by_dummy=asked.dummy
        )
    elif asked.command == "noise_free":
        print(noise_free.make(seed, asked.output, asked.softening))
        print(f"seed {seed}", file=sys.stderr)
    elif asked.command == "demo":
        print(demo_records.make(asked.output))
    elif asked.command == "scorecard":
        card(asked.tests, asked.output)
    else:
        for name in EFFECTS:
            print(name, "catalogue" if name in CATALOGUE else "")
    return 0


if __name__ == "__main__":
    sys.exit(main())
