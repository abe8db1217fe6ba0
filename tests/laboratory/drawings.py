"""Drawings of the scorecard as SVG: confusion matrices, power, reliability."""

from pathlib import Path
from xml.sax.saxutils import escape

from .effects import FOREIGN

CELL, LEFT, TOP, GAP = 22, 170, 150, 40
RIGHT, WRONG = "35,110,60", "170,50,40"


def write(path, lines, width, height):
    """One drawing on white paper."""
    Path(path).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}">\n'
        "<style>text{font:11px sans-serif}.title{font-size:14px;font-weight:bold}</style>\n"
        '<rect width="100%" height="100%" fill="white"/>\n' + "\n".join(lines) + "\n</svg>\n",
        encoding="utf-8",
    )


def _text(x, y, words, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" {more}>{escape(str(words))}</text>'


def _cell(x, y, width, hue, strength, words):
    out = [
        f'<rect x="{x}" y="{y}" width="{width - 1}" height="{CELL - 1}" '
        f'fill="rgba({hue},{strength:.2f})" stroke="#ccc"/>'
    ]
    if words:
        out.append(_text(x + 0.5 * width - 1, y + 15, words, 'text-anchor="middle"'))
    return out


def matrices(tables, path):
    """Confusion matrices one below the other, rows shaded by their own number of cases."""
    lines, top, wide = [], 10, 0
    for title, table in tables:
        lines.append(_text(10, top + 14, title, 'class="title"'))
        for j, column in enumerate(table["columns"]):
            x, y = LEFT + j * CELL + 15, top + TOP - 6
            lines.append(
                f'<text transform="translate({x},{y}) rotate(-60)">{escape(column)}</text>'
            )
        for i, (row, counts) in enumerate(zip(table["rows"], table["counts"], strict=True)):
            y, total = top + TOP + i * CELL, max(sum(counts), 1)
            lines.append(_text(LEFT - 6, y + 15, row, 'text-anchor="end"'))
            for j, n in enumerate(counts):
                right = "unexplained" if row in FOREIGN else row
                hue = RIGHT if table["columns"][j] == right else WRONG
                lines += _cell(LEFT + j * CELL, y, CELL, hue, 0.7 * n / total, n or "")
        top += TOP + len(table["rows"]) * CELL + GAP
        wide = max(wide, LEFT + (len(table["columns"]) + 3) * CELL + 60)
    write(path, lines, wide, top)


PANELS = [
    ("in_set", "in the stated set"),
    ("alone", "right alone"),
    ("top_1", "likeliest of all"),
    ("top_3", "among the first three"),
]


def power(table, path):
    """Share of right answers by cause and strength, one panel for each way of being right."""
    strengths = sorted({s for row in table.values() for s in row}, key=float)
    step = 40
    panel = len(strengths) * step + 24
    lines = [_text(10, 24, "Power by strength (misfit after refit over noise)", 'class="title"')]
    for k, (_, title) in enumerate(PANELS):
        left = LEFT + k * panel
        lines.append(_text(left, 50, title))
        for j, strength in enumerate(strengths):
            lines.append(_text(left + (j + 0.5) * step, 68, strength, 'text-anchor="middle"'))
    for i, (cause, row) in enumerate(table.items()):
        y = 76 + i * CELL
        lines.append(_text(LEFT - 6, y + 15, cause, 'text-anchor="end"'))
        for k, (mark, _) in enumerate(PANELS):
            for j, strength in enumerate(strengths):
                one = row.get(strength, {}).get(mark)
                if one and one["of"]:
                    x, words = LEFT + k * panel + j * step, f"{one['count']}/{one['of']}"
                    # Half right is white; the text stays readable on the fullest shade.
                    hue, shade = (RIGHT if one["share"] > 0.5 else WRONG), abs(one["share"] - 0.5)
                    lines += _cell(x, y, step, hue, 1.2 * shade, words)
    write(path, lines, LEFT + len(PANELS) * panel, 90 + len(table) * CELL)


def reliability(diagrams, path):
    """Stated probability across, share that came true up, with 95 % intervals and counts."""
    size, top, lines = 240, 60, []
    for k, (title, diagram) in enumerate(diagrams):
        left = 50 + k * (size + 70)
        error = diagram["expected_error"]
        lines.append(_text(left, 22, title, 'class="title"'))
        told = "no case" if error is None else f"expected error {error:.3f}, {diagram['of']} stated"
        lines.append(_text(left, 42, told))
        lines.append(
            f'<rect x="{left}" y="{top}" width="{size}" height="{size}" fill="none" stroke="#888"/>'
            f'<line x1="{left}" y1="{top + size}" x2="{left + size}" y2="{top}" stroke="#bbb"/>'
        )
        for tick in (0.0, 0.5, 1.0):
            lines.append(
                _text(left + tick * size, top + size + 16, f"{tick:g}", 'text-anchor="middle"')
            )
            lines.append(
                _text(left - 5, top + (1 - tick) * size + 4, f"{tick:g}", 'text-anchor="end"')
            )
        for one in diagram["bins"]:
            x = left + one["mean_probability"] * size
            low, high = (top + (1 - v) * size for v in one["true"]["interval"])
            y = top + (1 - one["true"]["share"]) * size
            lines.append(
                f'<line x1="{x:.1f}" y1="{low:.1f}" x2="{x:.1f}" y2="{high:.1f}" '
                f'stroke="rgb({RIGHT})"/><circle cx="{x:.1f}" cy="{y:.1f}" r="4" '
                f'fill="rgb({RIGHT})"/>'
            )
            lines.append(_text(x, top + size + 32, one["true"]["of"], 'text-anchor="middle"'))
    lines.append(
        _text(50, top + size + 52, "across: stated probability, below it the number of cases; ")
    )
    lines.append(_text(50, top + size + 68, "up: share that came true, with its 95 % interval"))
    write(path, lines, 50 + len(diagrams) * (size + 70), top + size + 80)
