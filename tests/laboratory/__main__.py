"""Command line of the virtual laboratory: python -m laboratory COMMAND."""

import argparse
import sys
import time


def _span(text):
    low, _, high = text.partition(":")
    return float(low), float(high or low)


def main(arguments=None):
    """Run one command; returns the exit status."""
    parser = argparse.ArgumentParser(prog="laboratory", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    draw = commands.add_parser("draw", help="records of one case, and the truth beside them")
    draw.add_argument("--seed", type=int, default=None)
    draw.add_argument("--case", type=int, default=0)
    draw.add_argument("--effect", default=None)
    draw.add_argument("--ratio", type=float, default=None)
    draw.add_argument("-o", "--output", required=True)
    asked = parser.parse_args(arguments)
    if asked.command == "draw":
        from .case import draw_case, write_case

        seed = int(time.time()) if asked.seed is None else asked.seed
        records, truth, style = draw_case(seed, asked.case, asked.effect, asked.ratio)
        for path in write_case(asked.output, records, truth, style):
            print(path)
        print(f"seed {seed}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
