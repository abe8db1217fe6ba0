"""examples/modelica/IwanJoint.mo through pymoca, a Modelica compiler in Python.

    python modelica.py JOINT.fmu

Parses the file by the grammar, flattens its resonator with stand-ins for the standard library
(Modelica.mo beside this file), holds the interface of the unit against the archive, counts
equations and unknowns, and solves them once: the strain of the joint must be pulled back by
stiffness over reduced mass. Prints one line. What a Modelica tool makes of the imported unit is not
tested by this.
"""

import sys
from pathlib import Path

import fmpy
import numpy as np
import pymoca.ast as ast
import pymoca.parser
import pymoca.tree

HERE = Path(__file__).resolve().parent
WRAPPER = HERE.parents[1] / "examples/modelica/IwanJoint.mo"
STATES = {"left.s": 0.0, "right.s": 3e-5, "left.v": 0.1, "right.v": -0.2}


def parsed() -> ast.Tree:
    """Library and wrapper."""
    tree = pymoca.parser.parse((HERE / "Modelica.mo").read_text())
    tree.extend(pymoca.parser.parse(WRAPPER.read_text()))
    return tree


def check_interface(tree: ast.Tree, archive: str) -> None:
    """Every variable of the wrapper's interface is one of the unit, with its unit and causality."""
    interface = tree.classes["IwanJoint"].classes["Interface"]
    variables = {v.name: v for v in fmpy.read_model_description(archive).modelVariables}
    for name, symbol in interface.symbols.items():
        kind = {"RealInput": "input", "RealOutput": "output"}[str(symbol.type).split(".")[-1]]
        (modification,) = symbol.class_modification.arguments
        unit = modification.value.modifications[0].value
        found = variables[name]
        if (found.causality, found.unit) != (kind, unit):
            raise ValueError(f"{name}: {found.causality} in {found.unit} instead of {kind}, {unit}")


def value(node, values: dict[str, float]) -> float:
    """Of an expression of the flat model."""
    if isinstance(node, ast.Primary):
        return float(node.value)
    if isinstance(node, ast.ComponentRef | ast.Symbol):
        return values[str(node) if isinstance(node, ast.ComponentRef) else node.name]
    if str(node.operator) == "der":
        return values[f"der({node.operands[0]})"]
    operands = [value(operand, values) for operand in node.operands]
    match str(node.operator), operands:
        case "-", [one]:
            return -one
        case "+", [one, two]:
            return one + two
        case "-", [one, two]:
            return one - two
        case "*", [one, two]:
            return one * two
        case "/", [one, two]:
            return one / two
    raise ValueError(f"operator {node.operator} of {len(operands)}")


def solved(model: ast.Class, unknowns: list[str], known: dict[str, float]) -> dict[str, float]:
    """All unknowns, by Newton's method with differences: all is linear but for one product."""

    def residual(point: np.ndarray) -> np.ndarray:
        values = known | dict(zip(unknowns, point, strict=True))
        sides = [(value(e.left, values), value(e.right, values)) for e in model.equations]
        return np.array([left - right for left, right in sides])

    point = np.zeros(len(unknowns))
    for _ in range(5):
        slopes = [residual(point + step) - residual(point) for step in np.eye(len(unknowns))]
        point = point - np.linalg.solve(np.array(slopes).T, residual(point))
    return dict(zip(unknowns, point, strict=True))


def main() -> int:
    """Command line."""
    tree = parsed()
    check_interface(tree, sys.argv[1])
    name = ast.ComponentRef(name="IwanJoint", child=[ast.ComponentRef(name="Resonator")])
    model = pymoca.tree.flatten(tree, name).classes["IwanJoint.Resonator"]
    symbols = model.symbols.items()
    parameters = {n: value(s.value, {}) for n, s in symbols if "parameter" in s.prefixes}
    free = [symbol for symbol in model.symbols if symbol not in STATES | parameters]
    unknowns = free + [f"der({state})" for state in STATES]
    if len(unknowns) != len(model.equations):
        raise ValueError(f"{len(model.equations)} equations for {len(unknowns)} unknowns")
    found = solved(model, unknowns, STATES | parameters)
    pulled = found["der(right.v)"] - found["der(left.v)"]
    one, two = parameters["left.m"], parameters["right.m"]
    strain = STATES["right.s"] - STATES["left.s"]
    expected = -parameters["joint.unit.stiffness"] * (one + two) / (one * two) * strain
    if not abs(pulled / expected - 1.0) < 1e-9:
        raise ValueError(f"the strain is pulled by {pulled} instead of {expected} m/s^2")
    print(f"parsed, {len(unknowns)} equations for as many unknowns, solved")
    return 0


if __name__ == "__main__":
    sys.exit(main())
