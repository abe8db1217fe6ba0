"""How a diagnosis is judged against the truth; the rules are in README.md."""

from collections import Counter
from math import sqrt


class Unreadable(Exception):
    """The diagnosis breaks the contract of iwan-diagnosis/1."""


VERDICTS = {"clean", "explained", "partly_explained", "unexplained"}


def _stated(diagnosis):
    """(verdict, names in order, each with the names it may be instead)."""
    if diagnosis.get("schema") not in (None, "iwan-diagnosis/1"):
        raise Unreadable(f"schema {diagnosis.get('schema')!r}")
    verdict = diagnosis.get("verdict")
    if verdict not in VERDICTS:
        raise Unreadable(f"verdict {verdict!r}")
    causes = diagnosis.get("causes") or []
    named = [cause["name"] for cause in causes]
    sets = [{cause["name"], *(cause.get("ambiguous_with") or [])} for cause in causes]
    return verdict, named, sets


def judge(truth, diagnosis):
    """One case: what was said, and which marks it earns."""
    if "effects" in truth:
        return judge_pair(truth, diagnosis)
    verdict, named, sets = _stated(diagnosis)
    stated = sets[0] if sets else set()
    effect, known = truth["effect"], truth["in_catalogue"]
    return {
        "case": truth["case"],
        "effect": effect,
        "known": known,
        "ratio": truth["ratio_achieved"],
        "verdict": verdict,
        "named": named,
        "ambiguous_with": sorted(stated - set(named[:1])),
        "column": named[0] if named else verdict,
        "alone": known and named == [effect] and len(stated) == 1,
        "first": known and named[:1] == [effect],
        "single": len(named) == 1 and len(stated) == 1,
        "in_set": known and effect in stated,
        "missed": known and verdict == "clean" and not named,
        "false_alarm": effect == "clean" and (verdict != "clean" or bool(named)),
        "wrong_name": known and bool(named) and effect not in stated | set(named),
        "extra_names": max(len(named) - 1, 0),
        "wrong_explained": effect != "clean" and not known and verdict == "explained",
        "called_unexplained": effect != "clean" and not known and verdict == "unexplained",
        "held_out_rms_ratio": (diagnosis.get("gain") or {}).get("held_out_rms_ratio"),
        "failed": None,
    }


def judge_pair(truth, diagnosis):
    """A case with two effects: each asks for a name of its own that is it or may be it."""
    verdict, named, sets = _stated(diagnosis)
    one, other = truth["effects"]
    # A single name that may be either is one statement, not two.
    both = any(
        one in a and other in b for i, a in enumerate(sets) for j, b in enumerate(sets) if i != j
    )
    covered = set().union(*sets)
    return {
        "case": truth["case"],
        "effect": f"{one}+{other}",
        "effects": [one, other],
        "kinds": truth["kinds"],
        "known": True,
        "ratio": truth["ratio_together"],
        "ratios": truth["ratios_achieved"],
        "likeness": truth["likeness"],
        "verdict": verdict,
        "named": named,
        "ambiguous_with": sorted(covered - set(named)),
        "both": both,
        "both_alone": both and len(named) == 2,
        "both_by_name": sorted(named) == sorted([one, other]),
        "covered": [effect for effect in (one, other) if effect in covered],
        "needless": sum(not {one, other} & stated for stated in sets),
        "third": len(named) > 2,
        "missed": verdict == "clean" and not named,
        "failed": None,
    }


def said(mark):
    """One line about a case."""
    if "not_drawn" in mark:
        return f"{mark['case']:4d} {mark['effect']:<24} could not be drawn"
    told = mark["failed"] or " ".join([mark["verdict"], *mark["named"]])
    also = f" (or {', '.join(mark['ambiguous_with'])})" if mark["ambiguous_with"] else ""
    return (
        f"{mark['case']:4d} {mark['effect']:<24} x{mark['ratio']:.2f} "
        f"{mark['drive'][:5]} -> {told}{also}  {mark['seconds']:.1f} s"
    )


def failure(truth, reason):
    """A case that gave no diagnosis: no mark but for the failure."""
    marks = judge(truth, {"verdict": "unexplained"})
    marks.update(failed=reason, verdict=None)
    if "effects" not in truth:
        marks.update(column="failed", false_alarm=False, called_unexplained=False)
    return marks


def share(count, total):
    """Count, total, share and its 95 % Wilson interval."""
    if total == 0:
        return {"count": 0, "of": 0, "share": None, "interval": None}
    z, p = 1.96, count / total
    middle = (p + z * z / (2 * total)) / (1 + z * z / total)
    half = z * sqrt(p * (1 - p) / total + z * z / (4 * total * total)) / (1 + z * z / total)
    return {
        "count": count,
        "of": total,
        "share": p,
        "interval": [max(middle - half, 0.0), min(middle + half, 1.0)],
    }


def median(values):
    """Median of those that are not None, or None."""
    values = sorted(v for v in values if v is not None)
    if not values:
        return None
    n = len(values)
    return values[n // 2] if n % 2 else 0.5 * (values[n // 2 - 1] + values[n // 2])


def pair_totals(cases):
    """Shares over cases with two effects."""

    def over(mark):
        return share(sum(bool(c[mark]) for c in cases), len(cases))

    return {
        "both_and_no_third": over("both_alone"),
        "both_in_stated_sets": over("both"),
        "both_by_name": over("both_by_name"),
        "both_covered": share(sum(len(c["covered"]) == 2 for c in cases), len(cases)),
        "none_found": share(sum(not c["covered"] for c in cases), len(cases)),
        "more_than_two_names": over("third"),
        "a_name_that_is_neither": over("needless"),
        "failed": over("failed"),
    }


def totals(cases):
    """Shares over all judged cases; a failed case counts as not right, never as absent."""
    known = [c for c in cases if c["known"]]
    clean = [c for c in cases if c["effect"] == "clean"]
    foreign = [c for c in cases if not c["known"] and c["effect"] != "clean"]

    def over(group, mark):
        return share(sum(bool(c[mark]) for c in group), len(group))

    return {
        "right_alone": over(known, "alone"),
        "right_first": over(known, "first"),
        "in_stated_set": over(known, "in_set"),
        "missed": over(known, "missed"),
        "wrong_name": over(known, "wrong_name"),
        "more_names_than_effects": share(sum(c["extra_names"] > 0 for c in known), len(known)),
        "false_alarms": over(clean, "false_alarm"),
        "wrong_explained": over(foreign, "wrong_explained"),
        "called_unexplained": over(foreign, "called_unexplained"),
        "failed": over(cases, "failed"),
        "median_held_out_rms_ratio_when_right": median(
            c["held_out_rms_ratio"] for c in known if c["first"]
        ),
    }


def matrix(cases):
    """Rows: truth; columns: first name, or the verdict where nothing is named."""
    rows = sorted({c["effect"] for c in cases}, key=lambda e: (e != "clean", e))
    counts = {row: Counter(c["column"] for c in cases if c["effect"] == row) for row in rows}
    said = {column for counter in counts.values() for column in counter}
    last = [c for c in ("partly_explained", "explained", "unexplained", "clean", "failed")]
    columns = [r for r in rows if r in said and r not in last]
    columns += sorted(said - set(columns) - set(last)) + [c for c in last if c in said]
    return {
        "rows": rows,
        "columns": columns,
        "counts": [[counts[r][c] for c in columns] for r in rows],
    }


def print_matrix(table, out):
    """The confusion matrix as text: one letter per column, legend below."""
    wide = max(len(r) for r in table["rows"])
    keys = [f"{j + 1:>3d}" for j in range(len(table["columns"]))]
    print(" " * wide + " " + " ".join(keys), file=out)
    for row, counts in zip(table["rows"], table["counts"], strict=True):
        cells = " ".join(f"{n:3d}" if n else "  ." for n in counts)
        print(f"{row:<{wide}} {cells}", file=out)
    for key, column in zip(keys, table["columns"], strict=True):
        print(f"{key} {column}", file=out)


def print_totals(sums, out):
    """The totals as text."""
    for name, value in sums.items():
        if not isinstance(value, dict):
            print(f"{name:<40} {'-' if value is None else format(value, '.4g')}", file=out)
        elif value["of"]:
            low, high = value["interval"]
            print(
                f"{name:<40} {value['count']:4d} of {value['of']:4d}  "
                f"{100 * value['share']:5.1f} %  [{100 * low:.0f}, {100 * high:.0f}]",
                file=out,
            )
