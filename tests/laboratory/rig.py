"""The test rig: drives a joint through a load history, one equilibrium per step of a fine grid.

Every step solves one monotone scalar equation for the slip displacement u. The elements are
followed by brute force (elastic predictor, clipping), so memory is what the elements remember.
"""

from dataclasses import dataclass

import numpy as np


class Infeasible(Exception):
    """The joint cannot carry the load asked for."""


@dataclass
class Rest:
    """What a specimen is like between two tests."""

    held: np.ndarray  # [N] forces of the elements
    slip: float  # [m]
    displacement: float  # [m]


@dataclass
class Trace:
    """What truly happened, on the fine grid: no sensor has looked yet."""

    time: np.ndarray
    force: np.ndarray  # [N] through the whole specimen
    displacement: np.ndarray  # [m] across the whole specimen
    slip: np.ndarray  # [m] across the elements
    dissipated: np.ndarray  # [J] by the elements since the start
    rest: Rest  # as the test ended


class Effect:
    """A specimen or a sensor that is not the ideal joint; the base class changes nothing.

    `acts` names the hooks a subclass overrides, so that the rig asks only for those:
    limits, contact, film, series, across, damper, after, read_force, read_displacement.
    """

    name = "clean"
    acts: frozenset = frozenset()
    dt = 0.0  # [s] of the grid; set when a test begins

    def reset(self):
        """Return to the virgin specimen."""

    def limits(self, base):
        """Break-free forces (negative side, positive side) now."""
        return -base, base

    def contact(self, u):
        """Force beside the elements and its slope at slip u."""
        return 0.0, 0.0

    def film(self, velocity):
        """Force beside the elements and its slope at this rate of the slip."""
        return 0.0, 0.0

    def series(self, force):
        """Further displacement in the load path and its slope at this force."""
        return 0.0, 0.0

    def across(self, displacement):
        """Force across the whole specimen and its slope at this displacement."""
        return 0.0, 0.0

    def damper(self, velocity):
        """Force across the whole specimen and its slope at this velocity."""
        return 0.0, 0.0

    def after(self, now):
        """Update what the effect remembers after a step; `now` is a `Step`."""

    def read_force(self, trace):
        """Force channel on the fine grid."""
        return trace.force

    def read_displacement(self, trace):
        """Displacement channel on the fine grid."""
        return trace.displacement

    def describe(self):
        """Parameters as plain values."""
        return {}


class Step:
    """What a finished step tells an effect."""

    __slots__ = ("dt", "slip", "moved", "force", "network", "displacement", "heat", "stuck")


def drive(joint, time, command, by_force, effect=None, rest=None):
    """Response of a joint to `command` [N or m] at `time` [s].

    The joint is virgin, or as another test left it at `rest`, and the effect with it; the command
    begins where that test ended. Raises Infeasible where the joint slips away under the force.
    """
    effect = effect or Effect()
    effect.dt = float(time[1] - time[0])
    if rest is None:
        effect.reset()
    acts = effect.acts
    moving_limits, has_contact = "limits" in acts, "contact" in acts
    has_series, has_damper, has_after = "series" in acts, "damper" in acts, "after" in acts
    has_across, has_film = "across" in acts, "film" in acts

    base, each, residual = joint.limits, joint.stiffness_each, joint.residual
    soft = 1.0 / joint.series
    low, high = -base, base
    held = np.zeros_like(base)  # forces of the elements at the end of the last step
    trial, now_held = np.empty_like(base), np.empty_like(base)
    stuck = np.empty(len(base), dtype=bool)
    u = moved = total = 0.0
    if rest is not None:
        held[:], u, total = rest.held, rest.slip, rest.displacement
    scale = np.max(np.abs(command))
    tolerance = 1e-10 * scale
    stiff_all = joint.network_stiffness
    first_reach = 0.1 * (scale / stiff_all if by_force else scale)
    flat = 1e-9 * (stiff_all if by_force else 1.0)
    farthest = 1e4 * (joint.full_slip / stiff_all + (0.0 if by_force else scale))

    n = len(time)
    forces, totals, slips = np.zeros(n), np.full(n, total), np.full(n, u)
    heat, heat_now = np.zeros(n), 0.0
    step = Step()
    for i in range(1, n):
        goal, dt = command[i], time[i] - time[i - 1]
        if moving_limits:
            low, high = effect.limits(base)
        start = u
        left, right, reach = -np.inf, np.inf, first_reach
        u = start + moved
        for _ in range(200):
            np.add(held, each * (u - start), out=trial)
            np.minimum(trial, high, out=now_held)
            np.maximum(now_held, low, out=now_held)
            np.equal(trial, now_held, out=stuck)
            network = now_held.sum() + residual * u
            slope = each * np.count_nonzero(stuck) + residual
            if has_contact:
                extra, more = effect.contact(u)
                network += extra
                slope += more
            if has_film:
                extra, more = effect.film((u - start) / dt)
                network += extra
                slope += more / dt
            displacement, stretch = u + network * soft, 1.0 + slope * soft
            if has_series:
                extra, more = effect.series(network)
                displacement += extra
                stretch += more * slope
            if has_damper:
                extra, more = effect.damper((displacement - total) / dt)
                force, rise = network + extra, slope + more * stretch / dt
            else:
                force, rise = network, slope
            if has_across:
                extra, more = effect.across(displacement)
                force, rise = force + extra, rise + more * stretch
            if by_force:
                miss, gradient = force - goal, rise
            else:
                miss, gradient = displacement - goal, stretch
            if abs(miss) <= tolerance:
                break
            if miss > 0.0:
                right = u
            else:
                left = u
            guess = u - miss / gradient if gradient > flat else np.nan
            if not left < guess < right:
                if right - left == np.inf:
                    guess = u - np.copysign(reach, miss)
                    reach *= 2.0
                elif right - left < 1e-14 * (abs(left) + abs(right)):
                    break
                else:
                    guess = 0.5 * (left + right)
            if abs(guess) > farthest:
                raise Infeasible(f"slips away at {goal:.4g} of {joint.full_slip:.4g} N")
            u = guess
        else:
            raise Infeasible("no equilibrium")
        moved = u - start
        work = float(np.dot(now_held, trial - now_held)) / each
        heat_now += work
        held, now_held = now_held, held
        total = displacement
        forces[i], totals[i], slips[i], heat[i] = force, displacement, u, heat_now
        if has_after:
            step.dt, step.slip, step.moved, step.heat = dt, u, moved, work
            step.force, step.network, step.displacement = force, network, displacement
            step.stuck = stuck
            effect.after(step)
    return Trace(time, forces, totals, slips, heat, Rest(held, u, total))
