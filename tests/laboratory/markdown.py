"""The card as text: tables for the README."""

WORST = 6  # causes told of by name


def _of(one):
    """Count and total, with the share from ten cases on."""
    if not one or not one["of"]:
        return "–"
    part = f" ({100 * one['share']:.0f} %)" if one["of"] >= 10 else ""
    return f"{one['count']} of {one['of']}{part}"


def _number(value, form=".3f"):
    return "–" if value is None else format(value, form)


def _table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return ["| " + " | ".join(map(str, line)) + " |" for line in lines] + [""]


def _strengths(summary):
    rows = []
    for strength, one in summary["by_strength"].items():
        if not one["right_alone"]["of"]:  # effects outside the catalogue alone
            continue
        marks = ("right_alone", "right_first", "in_stated_set", "top_1", "top_3")
        more = ("missed", "wrong_name")
        rows.append([strength, *(_of(one[m]) for m in (*marks, *more))])
    head = ["strength", "right alone", "right first", "in the stated set"]
    return _table([*head, "likeliest", "first three", "called clean", "wrong name"], rows)


def _clean(summary):
    rows = []
    for kind in [k for k in summary["noise_kinds"] if k in summary["false_alarms"]]:
        one = summary["false_alarms"][kind]
        parts = ("joint of power-law form", "joint of another form")
        drives = ("driven in force", "driven in displacement")
        rows.append([kind, *(_of(one.get(p)) for p in ("all", *parts, *drives))])
    head = ["noise of clean records", "false alarms", "power-law joints", "other joints"]
    return _table([*head, "driven in force", "in displacement"], rows)


def _foreign(summary):
    strengths = summary["unknown"]["by_strength"]
    rows = [
        [k, _of(one["wrong_explained"]), _of(one["abstained"]), _of(one["called_clean"])]
        for k, one in strengths.items()
    ]
    head = ["effects outside the catalogue, strength", "a wrong cause “explains” it"]
    return _table([*head, "(partly) unexplained", "called clean"], rows)


def _pairs(summary):
    kinds = {"all": summary["pairs"]["all"], **summary["pairs"]["by_kinds"]}
    marks = ("both_and_no_third", "both_by_name", "both_covered", "a_name_that_is_neither")
    rows = [[kind, *(_of(one[m]) for m in marks)] for kind, one in kinds.items()]
    head = ["two causes at once, each at twice the noise", "both and no third"]
    return _table([*head, "both by name", "both in some set", "a name that is neither"], rows)


BEGINNINGS = {
    "cut": "cut from a longer test",
    "zero": "zero of the drive off",
    "goes_on": "one joint through all files",
}


def _begun(summary):
    marks = ("false_alarms", "right_alone", "in_stated_set", "wrong_name")
    rows = [[BEGINNINGS[k], *(_of(v[m]) for m in marks)] for k, v in summary["begun"].items()]
    head = ["records that begin otherwise", "false alarms of clean ones", "one effect: right alone"]
    return _table([*head, "in the stated set", "wrong name"], rows)


def _single_figures(summary):
    sure, apart = summary["separability"], summary["separability"]["where_separable"]
    seen = sure["where_separable_at_the_size_found"]
    cal, same = summary["calibration"], summary["parameters"]["same_law"]
    held, after = summary["held_out"], summary["follow_up"]
    rows = [
        ["separable by 25 or more: right alone", _of(apart["alone"])],
        ["… in the stated set", _of(apart["in_set"])],
        ["… where the effect was seen, at its own size: right alone", _of(seen["alone"])],
        ["… … in the stated set", _of(seen["in_set"])],
        ["one cause named, nothing ambiguous: right", _of(sure["single_name_right"])],
        [
            "… clean records and foreign effects counted",
            _of(sure["single_name_right_of_all_cases"]),
        ],
        [
            "expected error of the first name's probability",
            _calibration(cal["first_name"]),
        ],
        [
            "… clean records and foreign effects counted",
            _calibration(cal["first_name_of_all_cases"]),
        ],
        ["median error of comparable parameters", _number(same["median_error"])],
        ["their 95 % intervals hold the truth", _of(same["covered"])],
        [
            f"held-out error within {held['limit']:g} of the noise, where right first",
            _of(held["right_first"]["within"]),
        ],
        ["its median over the noise, before and after", _before_after(held["right_first"])],
        ["ambiguous, right first after the next experiment", _of(after["first_after"])],
        ["… right alone", _of(after["alone_after"])],
        [
            "… right first where the program said that this would settle it",
            _of(after["first_where_settlement_was_promised"]),
        ],
    ]
    rows = [row for row in rows if "–" not in row[1]]
    return _table(["over all", ""], rows) if rows else []


def _calibration(one):
    right, most = _number(one["of_right_ones"]), _number(one["most_of_right_ones"])
    return f"{_number(one['expected_error'])} (right ones of {one['of']}: {right}, up to {most})"


def _before_after(one):
    return f"{_number(one['median_before'], '.2f')}, {_number(one['median'], '.2f')}"


def _worst(summary):
    """Causes found least often where the effect is as strong as the noise or stronger."""
    rows = []
    for cause, strengths in summary["power"].items():
        seen = [one["in_set"] for s, one in strengths.items() if float(s) >= 1.0]
        found, of = sum(s["count"] for s in seen), sum(s["of"] for s in seen)
        if of and found < of:
            rows.append((found / of, cause, found, of))
    told = [f"`{cause}` ({found} of {of})" for _, cause, found, of in sorted(rows)[:WORST]]
    if not told:
        return []
    return [f"Least often in the stated set at strengths 1 and 5: {', '.join(told)}.", ""]


def _drawings(folder):
    names = {"power": "Power", "matrix": "Confusion", "reliability": "Reliability"}
    links = [f"[{title}]({folder}/scorecard-{name}.svg)" for name, title in names.items()]
    return [f"Drawn: {', '.join(links)}.", ""]


def block(summary, figures=None):
    """The README's block: tables, seed and finder; `figures` is the folder of the drawings."""
    cases = ", ".join(f"{n} {name.replace('_', ' ')}" for name, n in summary["cases"].items())
    lines = [""]
    if summary["by_strength"]:
        lines += _strengths(summary) + _worst(summary)
    if summary["false_alarms"]:
        lines += _clean(summary)
    if summary["unknown"]["by_strength"]:
        lines += _foreign(summary)
    if summary["pairs"]["by_kinds"]:
        lines += _pairs(summary)
    if summary["begun"]:
        lines += _begun(summary)
    lines += _single_figures(summary)
    if figures and summary["by_strength"]:
        lines += _drawings(figures)
    missing = sum(len(v) for v in summary["not_drawn"].values())
    commit = f", commit {summary['commit']}" if summary["commit"] else ""
    lines.append(
        f"Seed {summary['seed']}{commit}, program {summary['finder']}. Cases: {cases}; "
        f"could not be drawn: {missing}; failed: {len(summary['failed'])}."
    )
    return "\n".join(lines) + "\n"
