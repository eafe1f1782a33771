"""Measured histories of strain, stress or force: set beside a solution, compared with it.

SI units. Stress and force are positive in compression, as everywhere here; strain is what a gauge says, positive in
tension. A record is straight between its samples.
"""

import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from .. import validation
from ..validation import SceneError, allowed
from .refused import RecordError

KINDS = ("strain", "stress", "force")
LAGS = 1 << 17  # most grid points of the search for the shift


class Alignment(NamedTuple):
    """How a record is moved to lie on a solution, `record.shifted(shift).scaled(scale)`, and what remains."""

    shift: float  # [s], added to the times of the record
    scale: float  # factor on its values
    residual: "Residual"


class Residual(NamedTuple):
    """The difference of a record from a solution: relative to the solution's own size in the same norm."""

    relative: float  # L2 over the samples
    greatest: float  # maximum
    samples: int  # compared


@dataclass(frozen=True)
class Record:
    """A measured history; immutable."""

    time: np.ndarray  # (n,) [s], increasing
    values: np.ndarray  # (n,) in SI units
    kind: str  # strain | stress | force
    place: float | None = None  # of the gauge [m], where the file says it
    start: float = 0.0  # what the clock of the file shows at zero of `time` [s]

    @property
    def step(self) -> float:
        """Median time between samples [s]."""
        return float(np.median(np.diff(self.time)))

    def shifted(self, by: float) -> "Record":
        """Later by so much [s]."""
        return replace(self, time=self.time + validation.number("shift", by, -1e4, 1e4, "s"))

    def scaled(self, by: float) -> "Record":
        """Times a factor: a calibration, or a sign."""
        return replace(self, values=self.values * validation.number("scale", by, -1e12, 1e12))

    def resampled(self, times: np.ndarray) -> "Record":
        """At other times, which must lie within the record."""
        times = np.asarray(times, float)
        if times.ndim != 1 or times.size < 2 or not (np.diff(times) > 0.0).all():
            raise SceneError("times", "these", allowed("record.times"))
        slack = 1e-9 * (self.time[-1] - self.time[0])
        for outside in (times[0], times[-1]):
            validation.number("times", float(outside), self.time[0] - slack, self.time[-1] + slack, "s", "record")
        return replace(self, time=times, values=np.interp(times, self.time, self.values))

    def at(self, times: np.ndarray) -> np.ndarray:
        """Values at any times; zero before the record, where nothing has happened yet, and NaN after it."""
        return np.interp(times, self.time, self.values, left=0.0, right=math.nan)

    def residual(self, times: np.ndarray, values: np.ndarray) -> Residual:
        """Against a solution given at increasing times: zero before them, not compared after them."""
        model = np.interp(self.time, times, values, left=0.0, right=math.nan)
        known = ~np.isnan(model)
        model, difference = model[known], (self.values - model)[known]
        norm, peak = float(np.linalg.norm(model)), float(np.abs(model).max(initial=0.0))
        if norm == 0.0:
            raise RecordError("no-overlap", model.size, samples=model.size)
        return Residual(float(np.linalg.norm(difference)) / norm, float(np.abs(difference).max()) / peak, model.size)

    def aligned(self, times: np.ndarray, values: np.ndarray, shift: float | None = None) -> Alignment:
        """The shift and the positive scale with which the record lies best on a solution, in least squares.

        First by cross-correlation on a grid as fine as the record, then between its points; a `shift` that is given
        leaves only the scale to find.
        Error: of the shift about a hundredth of a step for smooth histories; where the solution jumps, one step.
        """
        if not np.ptp(self.values) > 0.0:
            raise RecordError("constant", float(self.values[0]), value=self.values[0])
        if not np.any(values):
            raise RecordError("nothing-to-lie-on", None)
        if shift is None:
            coarse, step = self._coarse_shift(np.asarray(times, float), np.asarray(values, float))
            shift = _lowest(lambda by: self._fit(by, times, values)[0], coarse - 1.5 * step, coarse + 1.5 * step)
        scale = self._fit(shift, times, values)[1]
        moved = self.shifted(shift).scaled(scale)
        return Alignment(shift, scale, moved.residual(times, values))

    def _coarse_shift(self, times: np.ndarray, values: np.ndarray) -> tuple[float, float]:
        """Where the solution explains most of the record by the best scale, and the step of the grid [s].

        Not where their product is largest: of a ringing rod that is much the same some round trips later.
        """
        from scipy.signal import correlate

        span = max(self.time[-1] - self.time[0], times[-1] - times[0])
        step = max(self.step, span / LAGS)
        own = np.interp(np.arange(self.time[0], self.time[-1], step), self.time, self.values)
        model = np.interp(np.arange(times[0], times[-1], step), times, values)
        if model.size < 2:
            raise RecordError("long-steps", self.step, step=self.step)
        products = correlate(model, own, method="fft")
        known = np.concatenate(([0.0], np.cumsum(model**2)))  # of it, the part that lies under the record
        starts = np.arange(products.size) - (own.size - 1)
        under = known[np.clip(starts + own.size, 0, model.size)] - known[np.clip(starts, 0, model.size)]
        best = int(np.argmax(np.maximum(products, 0.0) ** 2 / np.maximum(under, 1e-9 * known[-1])))
        if products[best] <= 1e-9 * np.linalg.norm(model) * np.linalg.norm(own):
            raise RecordError("other-sign", None)
        return times[0] - self.time[0] + (best - (own.size - 1)) * step, step

    def _fit(self, shift: float, times: np.ndarray, values: np.ndarray) -> tuple[float, float]:
        """Mean square left over, as a share, by the best positive scale; and that scale.

        The record is fitted by the solution, not the solution by the record: so noise does not make the scale small.
        """
        model = np.interp(self.time + shift, times, values, left=0.0, right=math.nan)
        known = ~np.isnan(model)
        model, own = model[known], self.values[known]
        squares, product = float(model @ model), float(model @ own)
        if product <= 0.0:
            return 1.0, 1.0
        return 1.0 - product**2 / (squares * float(own @ own)), squares / product


def _lowest(function: Any, low: float, high: float) -> float:
    """Where a function of one number is least: on a fine grid first, as it may have corners, then between."""
    from scipy.optimize import minimize_scalar

    tried = np.linspace(low, high, 61)
    best = int(np.argmin([function(by) for by in tried]))
    between = (tried[max(best - 1, 0)], tried[min(best + 1, 60)])
    found = minimize_scalar(function, bounds=between, method="bounded", options={"xatol": 1e-6 * (high - low)})
    return float(found.x if found.fun < function(tried[best]) else tried[best])


def expected(solution: Any, kind: str, times: np.ndarray, x: float | None = None) -> np.ndarray:
    """What a solution says that a gauge at `x` [m] from the struck end would have measured.

    Without `x`, or at 0: the contact force, also as stress or strain of the struck end. Zero before the impact, NaN
    where the solution ends.
    """
    validation.choice("kind", kind, KINDS)
    times = np.asarray(times, float)
    known = (times >= 0.0) & (times <= solution.duration)
    values = np.where(times < 0.0, 0.0, math.nan)
    parts = solution.scene.target.rods
    if solution.motion is None or (not parts and (kind != "force" or x)):
        raise RecordError("not-rods", kind, kind=kind)
    if not x:
        values[known] = solution.motion.force(times[known])
        return values if kind == "force" else _from_stress(kind, values / parts[0].area, parts[0])
    place = validation.number("at", x, 0.0, sum(rod.length for rod in parts), "m", "rod")
    values[known] = solution.motion.stress(times[known], np.array([place]))[:, 0]
    return _from_stress(kind, values, rod_at(parts, place))


def align(record: Record, solution: Any, x: float | None = None, shift: float | None = None) -> Alignment:
    """The shift and scale with which the record lies best on what `solution` says of `x` [m], see `expected`."""
    count = int(np.clip(2.0 * solution.duration / record.step, 2_000, LAGS))
    times = np.linspace(0.0, solution.duration, count)
    return record.aligned(times, expected(solution, record.kind, times, x), shift)


def rod_at(parts: Any, x: float) -> Any:
    """The rod of a chain in which x [m] lies."""
    for rod in parts[:-1]:
        if x <= rod.length:
            return rod
        x -= rod.length
    return parts[-1]


def _from_stress(kind: str, stress: np.ndarray, rod: Any) -> np.ndarray:
    return {"strain": -stress / rod.material.young, "stress": stress, "force": stress * rod.area}[kind]


def as_stress(record: Record, rod: Any) -> np.ndarray:
    """The record's values as stress [Pa], compression positive, of a section of the rod."""
    factor = {"strain": -rod.material.young, "stress": 1.0, "force": 1.0 / rod.area}[record.kind]
    return factor * record.values
