"""What the marks of many cases say about the finder: rates, calibration, errors, coverage."""

from random import Random

from .parameters import NOT_COMPARABLE, compare
from .score import matrix, median, pair_totals, share, totals

POWER_LAWS = {"power_law", "uniform_with_tip"}  # the form of the four-parameter joint
SEPARABLE = 25.0  # chi squared that the nearest rival leaves
BINS = 10
DRAWS = 1000  # of what probabilities would show if they were right
NEAR = 1.05  # held-out error over the noise that counts as nothing left to explain


def _over(group, holds):
    return share(sum(bool(holds(c)) for c in group), len(group))


def _groups(cases, key):
    return {
        value: [c for c in cases if key(c) == value] for value in sorted({key(c) for c in cases})
    }


def _within(cases, rank):
    return _over(cases, lambda c: 0 < c.get("ranks", {}).get(c["effect"], 0) <= rank)


def rates(cases):
    """The marks of one strength, the places of the effect in the ranking, and the matrix."""
    known = [c for c in cases if c["known"]]
    return {
        **totals(cases),
        "top_1": _within(known, 1),
        "top_3": _within(known, 3),
        "matrix": matrix(cases),
    }


def power(cases):
    """By cause and strength: shares in the stated set, alone, first, and among the first three."""
    return {
        cause: {
            f"{strength:g}": {
                "in_set": _over(some, lambda c: c["in_set"]),
                "alone": _over(some, lambda c: c["alone"]),
                "first": _over(some, lambda c: c["first"]),
                "top_1": _within(some, 1),
                "top_3": _within(some, 3),
            }
            for strength, some in _groups(group, lambda c: c["asked"][0]).items()
        }
        for cause, group in _groups(cases, lambda c: c["effect"]).items()
    }


def false_alarms(cases):
    """Over the clean cases: by kind of noise, and within it by baseline and by drive."""

    def baseline(case):
        return "of power-law form" if case["law"] in POWER_LAWS else "of another form"

    def one(group):
        return {
            "all": _over(group, lambda c: c["false_alarm"]),
            "named": _over(group, lambda c: c["named"]),
            **{
                f"{title} {value}": _over(some, lambda c: c["false_alarm"])
                for title, key in (
                    ("joint", baseline),
                    ("law", lambda c: c["law"]),
                    ("driven in", lambda c: c["drive"]),
                )
                for value, some in _groups(group, key).items()
            },
        }

    kinds = _groups(cases, lambda c: c["noise_asked"] or "as drawn")
    return {kind: one(group) for kind, group in kinds.items()}


def begun(cases):
    """Records that do not begin with a virgin joint at zero, by how they begin."""

    def one(group):
        planted = [c for c in group if c["known"]]
        clean = [c for c in group if not c["known"]]
        return {
            "false_alarms": _over(clean, lambda c: c["false_alarm"]),
            "right_alone": _over(planted, lambda c: c["alone"]),
            "in_stated_set": _over(planted, lambda c: c["in_set"]),
            "wrong_name": _over(planted, lambda c: c["wrong_name"]),
        }

    return {way: one(group) for way, group in _groups(cases, lambda c: c["beginning"]).items()}


def unknowns(cases):
    """Effects outside the catalogue: what is said of them, all and each."""

    def one(group):
        return {
            "wrong_explained": _over(group, lambda c: c["wrong_explained"]),
            "abstained": _over(
                group, lambda c: c["verdict"] in ("unexplained", "partly_explained")
            ),
            "called_clean": _over(group, lambda c: c["verdict"] == "clean"),
        }

    return {
        "all": one(cases),
        "by_effect": {k: one(g) for k, g in _groups(cases, lambda c: c["effect"]).items()},
        "by_strength": {
            f"{k:g}": one(g) for k, g in _groups(cases, lambda c: c["asked"][0]).items()
        },
    }


def reliability(stated):
    """Stated probabilities against how often they came true, in equal bins; `stated` holds pairs
    of probability and truth. `expected_error` weighs each bin's difference by its count;
    `of_right_ones` is what it would be on average if each came true as often as stated, which few
    cases do not bring to zero, and `most_of_right_ones` its 95 % quantile."""
    if not stated:
        unknown = ("expected_error", "of_right_ones", "most_of_right_ones")
        return {"of": 0, **dict.fromkeys(unknown), "bins": []}
    bins = []
    for j, inside in _binned(stated):
        mean = sum(p for p, _ in inside) / len(inside)
        came_true = share(sum(t for _, t in inside), len(inside))
        bins.append(
            {
                "from": j / BINS,
                "to": (j + 1) / BINS,
                "mean_probability": mean,
                "true": came_true,
            }
        )
    chance = Random(0)
    right = sorted(
        _expected_error([(p, chance.random() < p) for p, _ in stated]) for _ in range(DRAWS)
    )
    return {
        "of": len(stated),
        "expected_error": _expected_error(stated),
        "of_right_ones": sum(right) / DRAWS,
        "most_of_right_ones": right[int(0.95 * DRAWS)],
        "bins": bins,
    }


def _binned(stated):
    bins = {}
    for p, true in stated:
        bins.setdefault(min(int(p * BINS), BINS - 1), []).append((p, true))
    return sorted(bins.items())


def _expected_error(stated):
    return sum(abs(sum(p - t for p, t in inside)) for _, inside in _binned(stated)) / len(stated)


def calibration(cases):
    """Three readings of `probability`: of the first name among catalogue effects, of the first
    name whatever was planted, and of every candidate among catalogue effects."""

    def first(group):
        return [
            (c["probabilities"][c["named"][0]], c["first"])
            for c in group
            if c["named"] and c.get("probabilities", {}).get(c["named"][0]) is not None
        ]

    known = [c for c in cases if c["known"]]
    every = [
        (p, name == c["effect"])
        for c in known
        for name, p in c.get("probabilities", {}).items()
        if p is not None
    ]
    return {
        "first_name": reliability(first(known)),
        "first_name_of_all_cases": reliability(first(cases)),
        "every_candidate": reliability(every),
    }


def separability(cases):
    """How far a large separability, and a single name, can be relied upon."""
    known = [c for c in cases if c["known"]]

    def apart(case):
        value = (case.get("lambda_sep") or {}).get(case["effect"])
        return value is not None and value >= SEPARABLE

    def of_its_size(case):
        return apart(case) and (case.get("lambda_of_its_size") or {}).get(case["effect"])

    def marks(group):
        return {m: _over(group, lambda c, m=m: c[m]) for m in ("alone", "first", "in_set")}

    single = [c for c in cases if c.get("single")]
    return {
        "at_least": SEPARABLE,
        "where_separable": marks([c for c in known if apart(c)]),
        "where_separable_at_the_size_found": marks([c for c in known if of_its_size(c)]),
        "elsewhere": marks([c for c in known if not apart(c)]),
        "single_name_right": _over([c for c in single if c["known"]], lambda c: c["first"]),
        "single_name_right_of_all_cases": _over(single, lambda c: c["first"]),
    }


def parameters(cases):
    """Errors and coverage of comparable parameters where the effect was named first."""
    rows = [row for c in cases if c["known"] and c["first"] for row in compare(c)]

    def one(group):
        judged = [row for row in group if row["covered"] is not None]
        return {
            "cases": len(group),
            "median_error": median(row["error"] for row in group),
            "covered": _over(judged, lambda row: row["covered"]),
            "without_interval": sum(row["same_law"] and row["covered"] is None for row in group),
        }

    return {
        "same_law": one([row for row in rows if row["same_law"]]),
        "another_law": one([row for row in rows if not row["same_law"]]),
        "by_quantity": {
            name: one(group)
            for name, group in _groups(rows, lambda r: f"{r['cause']}.{r['name']}").items()
        },
        "not_comparable": NOT_COMPARABLE,
    }


def held_out(cases):
    """Held-out error with the named causes over the true noise, which the best model would leave.

    Only where the finder judges the channel that carries the noise. The noise is that of the very
    samples that the finder says it held out: over a part of a record it scatters, by some per cent
    where it is coloured.
    """
    known = [c for c in cases if c["known"] and c.get("held_out_over_noise") is not None]

    def one(group):
        return {
            "within": _over(group, lambda c: c["held_out_over_noise"] <= NEAR),
            "median": median(c["held_out_over_noise"] for c in group),
            "median_before": median(c["baseline_over_noise"] for c in group),
        }

    right = [c for c in known if c["first"]]
    return {
        "limit": NEAR,
        "all": one(known),
        "right_first": one(right),
        "right_first_white": one([c for c in right if not c["coloured"]]),
        "right_first_coloured": one([c for c in right if c["coloured"]]),
        "not_comparable": sum(c["known"] and c.get("held_out_over_noise") is None for c in cases),
    }


def pairs(cases):
    """Two effects at once: all, by kinds, and which effect was lost how often."""
    kinds = _groups(
        cases, lambda c: "joint and chain" if len(set(c["kinds"])) == 2 else "two of the joint"
    )
    lost = {}
    for case in cases:
        for effect in case["effects"]:
            lost.setdefault(effect, []).append(effect not in case["covered"])
    return {
        "all": pair_totals(cases),
        "by_kinds": {kind: pair_totals(group) for kind, group in kinds.items()},
        "lost": {effect: share(sum(x), len(x)) for effect, x in sorted(lost.items())},
    }
