"""Which parameters of the laboratory's laws mean what a parameter of the finder's law means.

One table, and the reasons for what is not in it; beside it which effects have a law in common. A
quantity is of the *same law* where both laws agree in form as well: then the finder's interval can
be held to its promise. Of *another law* it is the same quantity read off a curve of another form:
only the error is taken.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import hypot, sqrt


@dataclass(frozen=True)
class Quantity:
    """One comparable quantity of one cause."""

    cause: str
    name: str
    truth: Callable  # parameters of the truth -> value in SI, or None where it has no meaning
    same_law: bool = True
    found: Callable | None = None  # {name: (value, interval)} -> (value, interval)


def _read(key):
    return lambda truth: truth[key]


def _where(key, **needed):
    """The value of a key in cases of the given laws only."""
    return lambda t: t[key] if all(t[k] in v for k, v in needed.items()) else None


def _damper(cause, key):
    places = {"coefficient": "joint", "contact_coefficient": "contact"}
    return [Quantity(cause, name, _where(key, where=(place,))) for name, place in places.items()]


def _asymmetry(t):
    plus, minus = t["weak_factor"], t["strong_factor"]
    if t["weaker"] == "negative":
        plus, minus = minus, plus
    return (plus - minus) / (plus + minus)


def _heat(t):
    if t["law"] == "path":
        return None
    return t["scale_J_or_m"] / (t["exponent"] if t["law"] == "power" else 1.0)


def _gap(side):
    other = {"positive": "negative", "negative": "positive"}[side]

    def truth(t):
        return t[f"gap_{side}_m"] if t["law"] == "softplus" and t["sides"] != other else None

    def found(p):
        # Beyond the rounding the finder's contact is that of a gap half a rounding wider.
        return p[f"gap_{side}"][0] + 0.5 * p["rounding"][0], None

    return truth, found


def _hum(of):
    def found(p):
        (sine, among), (cosine, around) = p[of + "sine"], p[of + "cosine"]
        size = hypot(sine, cosine)
        if not among or not around or size == 0.0:
            return size, None
        # The two parts are orthogonal over whole cycles of the mains: their errors are independent.
        half = [0.5 * (high - low) for low, high in (among, around)]
        spread = sqrt((sine * half[0]) ** 2 + (cosine * half[1]) ** 2) / size
        return size, (size - spread, size + spread)

    return found


def _corner(channel):
    """Of a first-order high-pass in this channel."""
    return _where("corner_Hz", order=(1,), channel=(channel,))


def _mass(p):
    """Of the form that was found; the other is nothing."""
    return max(p["mass"], p["driven_mass"])


def _late(p):
    """Of the form that was found, by how much the displacement is later than the force."""
    none = 0.0, None
    value, interval = p.get("cell_lag", none)
    if value > 0.0:
        return -value, interval and (-interval[1], -interval[0])
    lag = p.get("lag", none)
    return lag if lag[0] > 0.0 else p["delay"]


QUANTITIES = [
    *_damper("viscous_damping", "coefficient_Ns_per_m"),
    *_damper("quadratic_damping", "coefficient_Ns2_per_m2"),
    Quantity("pinning", "gap_positive", _gap("positive")[0], False, _gap("positive")[1]),
    Quantity("pinning", "gap_negative", _gap("negative")[0], False, _gap("negative")[1]),
    Quantity("clearance", "gap", _where("gap_m", seating=("tanh",))),
    Quantity("joint_opening", "compliance", lambda t: t.get("compliance_added_m_per_N"), False),
    Quantity("asymmetric_friction", "asymmetry", _asymmetry),
    Quantity(
        "preload_loss",
        "loss",
        _where("final_loss_limit", law=("exponential", "hyperbolic", "power")),
    ),
    Quantity("preload_loss", "energy", _heat),
    Quantity("rate_dependent_friction", "gain", _read("per_e_fold"), False),
    Quantity(
        "static_friction_drop",
        "excess",
        lambda t: t["breakaway_over_kinetic"] - 1.0,
        False,
    ),
    Quantity("fixture_inertia", "mass", _read("mass_kg"), True, _mass),
    Quantity(
        "sensor_delay",
        "delay",
        lambda t: -t["delay_s"] if t["channel"] == "force" else t["delay_s"],
        True,
        _late,
    ),
    Quantity(
        "displacement_drift",
        "rate",
        lambda t: t["total_m"] / t["over_s"] if t["law"] == "linear" else None,
    ),
    Quantity("offset_step", "height", lambda t: t.get("step_m")),
    Quantity("offset_step", "cell_height", lambda t: t.get("step_N")),
    Quantity("mains_hum", "amplitude", lambda t: t.get("amplitude_m"), True, _hum("")),
    Quantity("mains_hum", "cell_amplitude", lambda t: t.get("amplitude_N"), True, _hum("cell_")),
    Quantity("ac_coupling", "corner_frequency", _corner("displacement")),
    Quantity("ac_coupling", "cell_corner", _corner("force")),
]

# Effects of which a form of the finder's law holds the laboratory's exactly, or some of its forms.
SAME_FORM = {
    "viscous_damping": "a dashpot across the joint or its contact",
    "quadratic_damping": "a drag across the joint or its contact",
    "clearance": "seated by a tanh; not by a root",
    "preload_loss": "exponential, hyperbolic and power of energy; exponential of the path",
    "asymmetric_friction": "both: what one side alone loses is a joint of less friction besides",
    "static_friction_drop": "each contact by itself",
    "creep": "three Kelvin elements a decade apart",
    "fixture_inertia": "a mass",
    "sensor_delay": "a time and a filter of first order",
    "displacement_drift": "straight, exponential and root",
    "offset_step": "the logistic function is a tanh",
    "mains_hum": "the mains and its third harmonic",
    "ac_coupling": "of first order, and of second with two equal corners",
}

NOT_COMPARABLE = {
    "slack_growth": "the laboratory's play grows with a power of the load, the finder's in line",
    "cubic_stiffness": "inverse or direct hyperbolic sine against a cube",
    "normal_load_variation": "exponential against linear and square",
    "running_in": "settles along the slip path, the finder's with dissipated energy",
    "velocity_weakening": "x/(1 + x) against 1 - exp(-x): the limit at high speed is another one",
    "creep": "three Kelvin elements of any shares against one to three",
    "sensor_saturation": "range of a rounded law against the level at which the reading bends off",
    "sensor_nonlinearity": "sine and cosine against square and cube",
}


def compare(mark):
    """Comparable quantities of a case whose effect was named: cause, name, truth, found, interval.

    `error` is relative to the truth; `covered` is None where no interval can be held to it.
    """
    out = []
    found = (mark.get("found") or {}).get(mark["effect"])
    if not found:
        return out
    for quantity in QUANTITIES:
        if quantity.cause != mark["effect"]:
            continue
        truth = quantity.truth(mark["parameters"])
        if truth is None:
            continue
        try:
            value, interval = quantity.found(found) if quantity.found else found[quantity.name]
        except (KeyError, TypeError):  # the finder states no such number
            value, interval = None, None
        covered = None
        if quantity.same_law and interval and None not in interval:
            covered = interval[0] <= truth <= interval[1]
        out.append(
            {
                "cause": quantity.cause,
                "name": quantity.name,
                "truth": truth,
                "found": value,
                "interval": interval,
                "same_law": quantity.same_law,
                "error": abs(value - truth) / abs(truth) if value is not None else None,
                "covered": covered,
            }
        )
    return out
