"""The Bouc-Wen model, fitted to records under displacement control: the rival of an Iwan joint.

F = k U + c dU/dt + z + F0,  dz/dU = A (1 - |z/Z|^n (b sgn(z dU) + 1 - b)).
Parameters A, Z, n, b, k, c are common to all records; F0 is one offset per record.
"""

import numpy as np
from scipy.optimize import least_squares

# Steps between two samples: the loops turn within a few samples of a reversal.
SUBSTEPS = 4


def hysteretic(parameters, displacement):
    """z of every record; `displacement` is (samples, records), short records padded."""
    slope, limit, power, share = parameters
    z = np.zeros(displacement.shape[1])
    history = np.empty_like(displacement)
    history[0] = z
    steps = np.diff(displacement, axis=0) / SUBSTEPS
    for row, step in enumerate(steps):
        for _ in range(SUBSTEPS):
            way = np.abs(z / limit) ** power * (share * np.sign(z * step) + 1.0 - share)
            z = np.clip(z + slope * step * (1.0 - way), -limit, limit)
        history[row + 1] = z
    return history


def together(records):
    """Displacements side by side, the last value held where a record is shorter."""
    longest = max(len(record["displacement"]) for record in records)
    columns = [
        np.pad(record["displacement"], (0, longest - len(record["displacement"])), "edge")
        for record in records
    ]
    return np.stack(columns, axis=1)


def natural(unknowns, scale):
    """Parameters A, Z, n, b from unknowns of order one."""
    slope, limit, power, share = unknowns
    return (
        scale["slope"] * np.exp(slope),
        scale["force"] * np.exp(limit),
        np.exp(power),
        1.0 / (1.0 + np.exp(-share)),
    )


def columns(record, z):
    """What enters linearly: displacement, its rate, z, one."""
    rate = np.gradient(record["displacement"], record["time"])
    return np.stack([record["displacement"], rate, z, np.ones_like(rate)], axis=1)


def linear(records, histories):
    """Stiffness beside, damping and the share of z by least squares; an offset per record."""
    centred = [
        (block - block.mean(axis=0))[:, :3]
        for block in (columns(r, z) for r, z in zip(records, histories, strict=True))
    ]
    force = [record["force"] - record["force"].mean() for record in records]
    weights = [1.0 / np.sqrt(len(f)) for f in force]
    matrix = np.concatenate([w * block for w, block in zip(weights, centred, strict=True)])
    target = np.concatenate([w * f for w, f in zip(weights, force, strict=True)])
    size = np.linalg.norm(matrix, axis=0)
    solution = np.linalg.lstsq(matrix / size, target, rcond=None)[0] / size
    return solution, target - matrix @ solution


def histories(unknowns, scale, records):
    """z of every record at its own length."""
    z = hysteretic(natural(unknowns, scale), together(records))
    return [z[: len(record["displacement"]), i] for i, record in enumerate(records)]


def fit(records):
    """The model fitted to all records at once, as a function that predicts the force of another."""
    scale = {
        "force": max(np.percentile(np.abs(r["force"]), 95) for r in records),
        "slope": max(np.percentile(np.abs(r["force"]), 95) for r in records)
        / (0.1 * max(np.abs(r["displacement"]).max() for r in records)),
    }

    def residual(unknowns):
        return linear(records, histories(unknowns, scale, records))[1]

    best = None
    for power, share in [(0.0, 0.0), (0.7, 1.0)]:
        start = np.array([0.0, 0.0, power, share])
        bounds = ([-4.0, -3.0, -2.0, -4.0], [4.0, 3.0, 3.0, 4.0])
        found = least_squares(residual, start, bounds=bounds, diff_step=1e-3, max_nfev=25)
        if best is None or found.cost < best.cost:
            best = found
    coefficients, _ = linear(records, histories(best.x, scale, records))

    def predict(record):
        [z] = histories(best.x, scale, [record])
        return columns(record, z)[:, :3] @ coefficients

    slope, limit, power, share = natural(best.x, scale)
    values = {
        "A": slope * coefficients[2],
        "Z": limit * coefficients[2],
        "n": power,
        "b": share,
        "k": coefficients[0],
        "c": coefficients[1],
    }
    return predict, values
