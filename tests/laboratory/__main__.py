"""Command line of the virtual laboratory: python -m laboratory COMMAND."""

import argparse
import signal
import sys
import time

from . import demo as demo_records
from . import noise_free, plan
from .bench import Task
from .blind import blind_test
from .case import write_case
from .effects import CATALOGUE, EFFECTS
from .follow_up import follow_ups, measure_dummy, run_load
from .marks import Foreign
from .noise import KINDS
from .scorecard import Mixed, card
from .speed import RATES, speed


def _span(text):
    low, _, high = text.partition(":")
    return float(low), float(high or low)


def _names(text):
    return tuple(text.split(","))


def _strengths(text):
    strengths = tuple(float(word) for word in text.split(","))
    unknown = set(strengths) - set(plan.STRENGTHS)
    if unknown:
        raise argparse.ArgumentTypeError(f"of {plan.STRENGTHS} only, not {sorted(unknown)}")
    return strengths


def _parser():
    parser = argparse.ArgumentParser(prog="laboratory", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    draw = commands.add_parser("draw", help="records of one case, and the truth beside them")
    draw.add_argument("--case", type=int, default=0)
    draw.add_argument("--effect", default=None, help="or two, joined by +; pair: by the seed")
    draw.add_argument("--ratio", type=float, default=None, help="misfit after refit over noise")
    way = draw.add_mutually_exclusive_group()
    way.add_argument("--goes-on", action="store_true", help="one joint through all files")
    way.add_argument("--begin", action="store_true", help="files cut, or a zero of the drive moved")
    blind = commands.add_parser("blind", help="draw cases, run the finder, judge it")
    blind.add_argument("--cases", type=int, default=24)
    blind.add_argument("--effects", type=_names, default=None, help="names, by commas")
    blind.add_argument("--ratio", type=_span, default=(1.0, 5.0), help="R or LOW:HIGH")
    blind.add_argument("--pass", dest="more", default="", help="further words for diagnose")
    power = commands.add_parser("power", help="every effect of the catalogue at every strength")
    power.add_argument("--cases", type=int, default=3, help="of each effect at each strength")
    power.add_argument("--effects", type=_names, default=None, help="names, by commas")
    power.add_argument("--strengths", type=_strengths, default=plan.STRENGTHS)
    clean = commands.add_parser("clean", help="false alarms under each kind of noise")
    clean.add_argument("--cases", type=int, default=75, help="of each kind")
    clean.add_argument("--kinds", type=_names, default=KINDS, help=", ".join(KINDS))
    foreign = commands.add_parser("foreign", help="effects outside the catalogue")
    foreign.add_argument("--cases", type=int, default=3, help="of each effect at each strength")
    foreign.add_argument("--strengths", type=_strengths, default=plan.STRENGTHS)
    pairs = commands.add_parser("pairs", help="two effects planted at once")
    pairs.add_argument("--cases", type=int, default=60)
    pairs.add_argument("--ratio", type=float, default=plan.PAIR_STRENGTH, help="of each alone")
    run = commands.add_parser("run", help="the same hidden joint under a given load")
    run.add_argument("--truth", required=True, help="truth.json of the case")
    run.add_argument("--load", required=True, help="time, and force or displacement")
    dummy = commands.add_parser("dummy", help="a monolithic specimen through the same chain")
    dummy.add_argument("--truth", required=True, help="truth.json of the case")
    follow = commands.add_parser("follow_up", help="ambiguous cases before and after")
    follow.add_argument("--cases", type=int, default=12)
    follow.add_argument("--effects", type=_names, default=("viscous_damping", "sensor_delay"))
    follow.add_argument("--ratio", type=_span, default=(1.0, 2.0), help="R or LOW:HIGH")
    follow.add_argument("--dummy", action="store_true", help="settle by a dummy instead")
    known = commands.add_parser("noise_free", help="records of a known power-law joint")
    known.add_argument("--softening", type=float, default=None, help="of the tangent, at the peak")
    demo = commands.add_parser("demo", help="the example records")
    board = commands.add_parser("scorecard", help="everything, round by round, and the card")
    board.add_argument("--rounds", type=int, default=1)
    board.add_argument("--only", type=_names, default=None, help=", ".join([*plan.PLANS]))
    report = commands.add_parser("report", help="the card of marks that exist")
    commands.add_parser("effects", help="names of the effects")
    fast = commands.add_parser("speed", help="seconds that a diagnosis takes")
    fast.add_argument("--cases", type=int, default=6)
    fast.add_argument("--samples", type=int, default=16_000, help="of all records of a joint")
    fast.add_argument("--records", type=int, default=3, choices=(1, 2, 3))
    for one in (blind, power, clean, foreign, pairs, follow, board, fast):
        one.add_argument("--iwan", required=True, help="path of the command line")
        if one is not fast:  # whose threads are what is measured
            one.add_argument("--jobs", type=int, default=2)
    for one in (draw, blind, power, pairs):
        one.add_argument("--noise", choices=KINDS, default=None, help="white or coloured if absent")
    for one in (draw, blind, power, clean, foreign, pairs, known, follow, board, fast):
        one.add_argument("--seed", type=int, default=None, help="from the clock unless given")
    for one in (power, clean, foreign, pairs, board, report):
        one.add_argument("--commit", default=None, help="of the finder, for the card")
        one.add_argument("--readme", default=None, help="file whose scorecard block is filled")
        one.add_argument("--figures", default=None, help="folder for a copy of the drawings")
    measured = (power, clean, foreign, pairs, board, report)
    for one in (draw, blind, known, demo, run, dummy, follow, fast, *measured):
        one.add_argument("-o", "--output", required=True)
    return parser


def _task(asked, seed):
    """The case that `draw` asks for, as a measurement puts it."""
    effects = () if asked.effect == "pair" else tuple((asked.effect or "").split("+"))
    if len(effects) == 1:
        span = Task.span if asked.ratio is None else (asked.ratio, asked.ratio)
        effects = (asked.effect,)
    else:
        span = (asked.ratio or plan.PAIR_STRENGTH,) * 2
        if asked.goes_on or asked.begin:
            raise SystemExit("--goes-on and --begin are of cases with one effect, or none")
    way = "begun" if asked.begin else "draw"
    return Task(seed, asked.case, effects, span, asked.noise, way, asked.goes_on)


def _measured(asked, seed):
    """One measurement, or rounds of all; the card is drawn from whatever the folder holds."""
    if asked.command == "scorecard":
        steps = plan.rounds(seed, asked.rounds, asked.iwan, asked.output, asked.jobs, asked.only)
    else:
        if asked.command == "power":
            turns = range(asked.cases)
            lists = (
                plan.power(seed, t, asked.effects, asked.strengths, asked.noise) for t in turns
            )
        elif asked.command == "foreign":
            lists = (plan.foreign(seed, t, asked.strengths) for t in range(asked.cases))
        elif asked.command == "clean":
            lists = [plan.clean(seed, 0, asked.kinds, asked.cases)]
        else:
            lists = [plan.pairs(seed, 0, asked.ratio, asked.cases, asked.noise)]
        tasks = [task for some in lists for task in some]
        steps = [plan.measure(tasks, asked.iwan, asked.output, asked.jobs)] if tasks else []
    for _ in steps:
        _, written = card(asked.output, None, asked.commit, asked.readme, asked.figures)
    print(f"\n{written}\nseed {seed}" if steps else "no case asked for")


def main(arguments=None):
    """Run one command; returns the exit status."""
    asked = _parser().parse_args(arguments)
    # So that a run that is told to end takes its workers with it.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    seed = getattr(asked, "seed", None)
    seed = int(time.time()) if seed is None else seed
    try:
        return _run(asked, seed)
    except (Foreign, Mixed) as reason:
        print(reason, file=sys.stderr)
        return 2


def _run(asked, seed):
    if asked.command == "speed":
        rates = RATES[: asked.records]
        speed(seed, asked.cases, asked.samples, rates, asked.iwan, asked.output)
        return 0
    if asked.command == "draw":
        for path in write_case(asked.output, *_task(asked, seed).draw()):
            print(path)
        print(f"seed {seed}", file=sys.stderr)
    elif asked.command == "blind":
        more = tuple(asked.more.split())
        rest = (asked.effects, asked.ratio, asked.jobs, more, asked.noise)
        blind_test(seed, asked.cases, asked.iwan, asked.output, *rest)
    elif asked.command in ("power", "clean", "foreign", "pairs", "scorecard"):
        _measured(asked, seed)
    elif asked.command == "report":
        print(card(asked.output, None, asked.commit, asked.readme, asked.figures)[1])
    elif asked.command == "run":
        print(run_load(asked.truth, asked.load, asked.output))
    elif asked.command == "dummy":
        print(measure_dummy(asked.truth, asked.output))
    elif asked.command == "follow_up":
        rest = (asked.effects, asked.ratio, asked.dummy, asked.jobs)
        follow_ups(seed, asked.cases, asked.iwan, asked.output, *rest)
    elif asked.command == "noise_free":
        print(noise_free.make(seed, asked.output, asked.softening))
        print(f"seed {seed}", file=sys.stderr)
    elif asked.command == "demo":
        print(demo_records.make(asked.output))
    else:
        for name in EFFECTS:
            print(name, "catalogue" if name in CATALOGUE else "")
    return 0


if __name__ == "__main__":
    sys.exit(main())
