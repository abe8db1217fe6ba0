"""Several blind tests on one card: totals by strength as text, confusion matrices as SVG."""

import json
from pathlib import Path
from xml.sax.saxutils import escape

from .score import matrix, print_matrix, print_totals, totals

CELL, LEFT, TOP, GAP = 22, 170, 150, 40


def _heat(table, title, top):
    """One confusion matrix as SVG, rows normalised to their own number of cases."""
    out = [f'<text x="10" y="{top + 14}" class="title">{escape(title)}</text>']
    for j, column in enumerate(table["columns"]):
        x, y = LEFT + j * CELL + 15, top + TOP - 6
        out.append(f'<text transform="translate({x},{y}) rotate(-60)">{escape(column)}</text>')
    for i, (row, counts) in enumerate(zip(table["rows"], table["counts"], strict=True)):
        y, total = top + TOP + i * CELL, max(sum(counts), 1)
        out.append(f'<text x="{LEFT - 6}" y="{y + 15}" text-anchor="end">{escape(row)}</text>')
        for j, n in enumerate(counts):
            x = LEFT + j * CELL
            right = table["columns"][j] == row
            hue = "35,110,60" if right else "170,50,40"
            out.append(
                f'<rect x="{x}" y="{y}" width="{CELL - 1}" height="{CELL - 1}" '
                f'fill="rgba({hue},{n / total:.2f})" stroke="#ccc"/>'
            )
            if n:
                out.append(f'<text x="{x + 10}" y="{y + 15}" text-anchor="middle">{n}</text>')
    return out, top + TOP + len(table["rows"]) * CELL + GAP


def card(paths, directory):
    """Print the card and write scorecard.json and scorecard.svg; returns the summary."""
    summary, drawing, top, wide = [], [], 10, 0
    for path in paths:
        one = json.loads(Path(path).read_text(encoding="utf-8"))
        table, sums = matrix(one["cases"]), totals(one["cases"])
        title = (
            f"misfit {one['ratio'][0]:g} to {one['ratio'][1]:g} of the noise, seed {one['seed']}"
        )
        print(f"\n== {title}, {len(one['cases'])} cases")
        print_matrix(table, None)
        print()
        print_totals(sums, None)
        for key in ("drive", "coloured"):
            for value in sorted({c[key] for c in one["cases"] if key in c}, key=str):
                part = totals([c for c in one["cases"] if c.get(key) == value])
                right, alarm = part["right_first"], part["false_alarms"]
                print(
                    f"   {key} {value}: right first {right['count']}/{right['of']}, "
                    f"false alarms {alarm['count']}/{alarm['of']}"
                )
        summary.append(
            {"ratio": one["ratio"], "seed": one["seed"], "totals": sums, "matrix": table}
        )
        lines, top = _heat(table, title, top)
        drawing += lines
        wide = max(wide, LEFT + (len(table["columns"]) + 3) * CELL + 60)
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "scorecard.json").write_text(
        json.dumps({"schema": "laboratory-scorecard/1", "tests": summary}, indent=1) + "\n",
        encoding="utf-8",
    )
    (directory / "scorecard.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{top}">\n'
        "<style>text{font:11px sans-serif}.title{font-size:14px;font-weight:bold}</style>\n"
        '<rect width="100%" height="100%" fill="white"/>\n' + "\n".join(drawing) + "\n</svg>\n",
        encoding="utf-8",
    )
    return summary
