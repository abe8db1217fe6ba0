"""Joints of the laboratory: equal Jenkins elements at quantiles of a break-free law."""

from dataclasses import dataclass, field

import numpy as np
from scipy import stats


@dataclass
class Joint:
    """Equal Jenkins elements in parallel, a residual spring beside them, a spring in series."""

    law: str
    stiffness_each: float  # [N/m] of one Jenkins element
    limits: np.ndarray  # [N] break-free force of each element
    residual: float  # [N/m] never slips
    series: float  # [N/m]
    parameters: dict = field(default_factory=dict)

    @property
    def full_slip(self) -> float:
        """Sum of the break-free forces [N]."""
        return float(self.limits.sum())

    @property
    def network_stiffness(self) -> float:
        """Stiffness with every element stuck [N/m]."""
        return self.stiffness_each * len(self.limits) + self.residual

    def describe(self) -> dict:
        """The truth about this joint as plain values."""
        return {
            "law": self.law,
            "elements": len(self.limits),
            "full_slip_N": self.full_slip,
            "network_stiffness_N_per_m": self.network_stiffness,
            "residual_stiffness_N_per_m": self.residual,
            "series_stiffness_N_per_m": self.series,
            **self.parameters,
        }


def levels(rng, n):
    """Quantile levels in (0, 1): midpoints, or one random level in each of n cells."""
    offset = 0.5 if rng.random() < 0.6 else rng.random(n)
    return (np.arange(n) + offset) / n


def power_law(rng, n):
    """Break-free displacements of density d^chi up to 1, part of the elements together at 1."""
    chi, tip = rng.uniform(-0.7, 0.2), rng.uniform(0.0, 0.5)
    at_tip = int(round(tip * n))
    body = levels(rng, n - at_tip) ** (1.0 / (1.0 + chi))
    return np.append(body, np.ones(at_tip)), {"chi": chi, "fraction_at_limit": at_tip / n}


def lognormal(rng, n):
    """Lognormal break-free displacements."""
    spread = rng.uniform(0.4, 1.1)
    return stats.lognorm.ppf(levels(rng, n), spread), {"log_spread": spread}


def weibull(rng, n):
    """Weibull break-free displacements."""
    shape = rng.uniform(0.8, 3.0)
    return stats.weibull_min.ppf(levels(rng, n), shape), {"shape": shape}


def two_populations(rng, n):
    """Two lognormal families of contacts, the second several times later to slip."""
    share, apart = rng.uniform(0.3, 0.7), 10 ** rng.uniform(0.4, 1.2)
    first = int(share * n)
    near = stats.lognorm.ppf(levels(rng, first), rng.uniform(0.25, 0.7))
    far = apart * stats.lognorm.ppf(levels(rng, n - first), rng.uniform(0.25, 0.7))
    return np.append(near, far), {"share_of_first": first / n, "apart": apart}


def uniform_with_tip(rng, n):
    """Uniform from zero to 1, the rest together at 1."""
    at_tip = int(rng.uniform(0.1, 0.6) * n)
    body = levels(rng, n - at_tip)
    return np.append(body, np.ones(at_tip)), {"fraction_at_limit": at_tip / n}


LAWS = {
    "power_law": power_law,
    "lognormal": lognormal,
    "weibull": weibull,
    "two_populations": two_populations,
    "uniform_with_tip": uniform_with_tip,
}
WEIGHTS = [0.35, 0.15, 0.15, 0.15, 0.20]


def draw_joint(rng) -> Joint:
    """One joint: law, force and stiffness drawn over decades."""
    law = str(rng.choice(list(LAWS), p=WEIGHTS))
    n = int(rng.integers(300, 401))
    reach, parameters = LAWS[law](rng, n)
    full_slip = 10 ** rng.uniform(1.0, np.log10(5e4))
    # Macroslip displacements of joints lie between a micrometre and a millimetre.
    mean_reach = 10 ** rng.uniform(-6.0, -3.6)
    stiffness = np.clip(full_slip / mean_reach, 1e5, 1e9)
    each = stiffness / n
    limits = reach * full_slip / reach.sum()
    residual = stiffness * rng.uniform(0.01, 0.08) if rng.random() < 0.15 else 0.0
    series = stiffness * 10 ** rng.uniform(-0.3, 1.3)
    return Joint(law, each, limits, residual, series, parameters)
