"""Load histories: blocks of amplitude, rate and shape on a fine grid, peak normalised to one."""

from dataclasses import dataclass, field, replace

import numpy as np


@dataclass
class History:
    """One test: a fine grid of which every `fine`-th point is sampled."""

    time: np.ndarray
    command: np.ndarray  # peak magnitude one
    fine: int
    kind: str
    rates: list = field(default_factory=list)
    mean: float = 0.0
    is_straight: bool = False  # from sample to sample, as a program that computes a record goes

    @property
    def samples(self) -> int:
        """Sampled points."""
        return (len(self.time) - 1) // self.fine + 1

    def halved(self):
        """The same command, straight between its points, on a grid of twice as many steps."""
        half = np.arange(2 * len(self.time) - 1) / 2
        whole = np.arange(len(self.time))
        time = np.interp(half, whole, self.time)
        command = np.interp(half, whole, self.command)
        return replace(self, time=time, command=command, fine=2 * self.fine)

    def straight(self):
        """The same test with a command that goes straight from sample to sample."""
        sampled = slice(None, None, self.fine)
        command = np.interp(self.time, self.time[sampled], self.command[sampled])
        peak = np.max(np.abs(command))
        return replace(self, command=command / peak, is_straight=True)

    def describe(self) -> dict:
        """Plain values for the truth."""
        return {
            "kind": self.kind,
            "rates_Hz": self.rates,
            "mean_of_peak": self.mean,
            "straight_between_samples": self.is_straight,
            "samples": self.samples,
            "duration_s": float(self.time[-1]),
        }


class Tape:
    """Amplitude, rate and mean written segment by segment; played as amplitude sin(phase)."""

    def __init__(self, step, grain=1):
        self.step, self.grain = step, grain  # [s], and the steps between two samples
        self.amplitude, self.rate, self.mean = [], [], []
        self.level, self.bias = 0.0, 0.0

    def _write(self, seconds, rate, level, bias):
        n = max(2, self.grain * int(round(seconds / self.step / self.grain)))
        ease = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, n + 1) / n)
        self.amplitude.append(self.level + (level - self.level) * ease)
        self.mean.append(self.bias + (bias - self.bias) * ease)
        self.rate.append(np.full(n, rate))
        self.level, self.bias = level, bias

    def cycles(self, count, rate):
        """Steady cycles."""
        self._write(count / rate, rate, self.level, self.bias)

    def ramp(self, count, rate, level, bias=None):
        """Ease to another amplitude (and mean) over `count` cycles."""
        self._write(count / rate, rate, level, self.bias if bias is None else bias)

    def hold(self, seconds):
        """Stand still."""
        self._write(seconds, 0.0, self.level, self.bias)

    def play(self, shape="sine"):
        """The command on the grid, beginning with the rest at zero."""
        rate = np.concatenate(self.rate)
        phase = np.concatenate([[0.0], np.cumsum(rate) * self.step])
        amplitude = np.concatenate([[0.0], *self.amplitude])
        mean = np.concatenate([[0.0], *self.mean])
        if shape == "sine":
            wave = np.sin(2 * np.pi * phase)
        else:  # triangle
            wave = 2 / np.pi * np.arcsin(np.sin(2 * np.pi * phase))
        return amplitude * wave + mean


def _finish(step, command, fine, kind, rates, mean):
    keep = (len(command) - 1) // fine * fine + 1
    command = command[:keep]
    peak = np.max(np.abs(command))
    return History(
        step * np.arange(keep), command / peak, fine, kind, [float(r) for r in rates], mean / peak
    )


def _amplitudes(rng, count):
    steps = np.sort(10 ** rng.uniform(np.log10(0.2), 0.0, count))
    steps = np.linspace(rng.uniform(0.2, 0.4), 1.0, count) * 0.7 + 0.3 * steps
    steps[-1] = 1.0
    return steps[::-1] if rng.random() < 0.25 else steps


def stepped(rng, rates, spc, shape, holds, mean, step_back=True):
    """Steps of amplitude at each rate; `spc` samples per cycle of the fastest rate."""
    fastest = max(rates)
    fine = int(np.clip(np.ceil(320 / spc), 2, 5))
    tape = Tape(1.0 / (fastest * spc * fine), fine)
    count = int(rng.integers(3, 6))
    steps = _amplitudes(rng, count)
    if mean:
        tape.ramp(1.0, rates[0], 0.0, mean)
    for rate in rates:
        few = rate < 0.7 * fastest
        repeats = int(rng.integers(3, 5)) if few else int(rng.integers(4, 8))
        for level in steps:
            tape.ramp(1.0, rate, level)
            tape.cycles(repeats, rate)
            if holds:
                tape.hold(rng.uniform(0.4, 1.5) / min(rates))
    if step_back and rng.random() < 0.5:
        tape.ramp(1.0, fastest, 0.5 * steps.max())
        tape.cycles(3, fastest)
    tape.ramp(1.0, fastest, 0.0)
    name = "stepped_sine" if shape == "sine" else "ramps"
    return _finish(tape.step, tape.play(shape), fine, name, rates, mean)


def monotone(rng, rates, spc, mean):
    """Loads up and down without reversal in between, ever further, fast and slow, then cycles."""
    fine = 3
    fastest = max(rates)
    step = 1.0 / (fastest * spc * fine)
    corners, legs = [0.0], []

    def leg(turn, rate):
        """Seconds to the next corner, a whole number of samples."""
        return np.ceil(max(abs(turn - corners[-1]), 0.2) * spc * fastest / (4 * rate)) / (
            spc * fastest
        )

    for rate in rates:
        for level in _amplitudes(rng, 3):
            for turn in (level, -level * rng.choice([0.0, 1.0]), level, 0.0):
                legs.append(leg(turn, rate))
                corners.append(turn)
        for turn in (1.0, -1.0) * 3 + (0.0,):
            legs.append(leg(turn, rate))
            corners.append(turn)
    knots = np.concatenate([[0.0], np.cumsum(legs)])
    command = np.interp(step * np.arange(int(knots[-1] / step)), knots, corners)
    return _finish(step, command, fine, "monotone_ramps", rates, 0.0)


def multi_sine(rng, rate, spc, mean):
    """A few harmonics of one rate, at two or three levels, periods repeated."""
    fine = 4
    orders = np.sort(rng.choice(np.arange(1, 7), size=int(rng.integers(3, 5)), replace=False))
    step = 1.0 / (rate * orders.max() * spc * fine)
    phases = rng.uniform(0, 2 * np.pi, len(orders))
    sizes = rng.uniform(0.4, 1.0, len(orders)) / orders**0.5
    tape = Tape(step)
    tape.ramp(1.0, rate, 0.0, mean)
    for level in np.linspace(rng.uniform(0.4, 0.6), 1.0, int(rng.integers(2, 4))):
        tape.ramp(1.0, rate, level)
        tape.cycles(3, rate)
    tape.ramp(1.0, rate, 0.0)
    envelope = np.concatenate([[0.0], *tape.amplitude])
    bias = np.concatenate([[0.0], *tape.mean])
    time = step * np.arange(len(envelope))
    angle = 2 * np.pi * rate * np.outer(orders, time) + phases[:, None]
    wave = sizes @ np.sin(angle)
    wave /= np.max(np.abs(wave))
    return _finish(step, envelope * wave + bias, fine, "multi_sine", rate * orders, mean)


def draw_history(rng, slow, kind, budget, holds=False):
    """One history of the given kind within a budget (least, most) of samples."""
    for _ in range(400):
        mean = float(rng.uniform(-0.35, 0.35)) if rng.random() < 0.3 else 0.0
        spc = float(rng.uniform(60, 160))
        apart = rng.uniform(2.5, 8.0)
        rates = [slow, slow * apart]
        if kind == "ramps":
            # A corner between two samples would be lost; the rig's clock is also the sampler's.
            spc = 4.0 * round(spc / 4.0)
            apart = 4.0 * round(spc * apart / 4.0) / spc
            rates = [slow, slow * apart]
        elif rng.random() < 0.2 and apart < 4:
            rates.insert(1, slow * apart**0.5)
        if rng.random() < 0.2:
            rates.reverse()
        if spc * max(rates) / min(rates) > 400:
            continue
        if kind == "multi_sine":
            history = multi_sine(rng, slow, spc, mean)
        elif kind == "monotone_ramps":
            history = monotone(rng, rates, spc, mean)
        else:
            shape = "sine" if kind == "stepped_sine" else "triangle"
            history = stepped(rng, rates, spc, shape, holds, mean)
        if budget[0] <= history.samples <= budget[1]:
            return history
    raise RuntimeError(f"no history of kind {kind} within {budget}")


def one_rate(rng, rate, budget, holds=False):
    """Stepped sine at one rate, sampled for itself: one of several files."""
    for _ in range(400):
        mean = float(rng.uniform(-0.3, 0.3)) if rng.random() < 0.3 else 0.0
        spc = float(rng.uniform(80, 300))
        history = stepped(rng, [rate], spc, "sine", holds, mean)
        if budget[0] <= history.samples <= budget[1]:
            return history
    raise RuntimeError(f"no stepped sine within {budget}")


KINDS = ["stepped_sine", "multi_sine", "ramps", "monotone_ramps"]


def draw_campaign(rng, holds=False):
    """The tests of one case: usually one file, sometimes two or three of the same virgin joint."""
    slow = 10 ** rng.uniform(-1.0, 1.2)
    files = int(rng.choice([1, 2, 3], p=[0.65, 0.25, 0.10]))
    if files == 1:
        kind = str(rng.choice(KINDS, p=[0.65, 0.13, 0.14, 0.08]))
        return [draw_history(rng, slow, kind, (3000, 8000), holds)]
    budget = (int(3000 / files), int(8000 / files))
    rates = slow * np.array([1.0, rng.uniform(3, 10), rng.uniform(10, 30)])[:files]
    return [one_rate(rng, float(rate), budget, holds) for rate in rates]
