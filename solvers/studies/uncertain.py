"""Inputs that are known within tolerances: how far figures spread, and which input each owes that to."""

import math
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..methods.base import Method
from ..scenes.library import SceneOrName, scene_of
from ..text.notes import Note, Severity, coded
from ..validation import SceneError, allowed
from .figures import FIGURES, asked_for
from .sensitivity import plain
from .study.design import Design, paired_design
from .study.plot import pictured
from .study.study import Progress, crew_size, points_of
from .study.work import Work

USUAL = ("peak_force", "contact_time", "impulse", "impactor_velocity")
USUAL_SAMPLES = 512
QUANTILES: tuple[int, ...] = (5, 25, 50, 75, 95)  # %
LEVEL, RESAMPLES, BATCH = 0.95, 999, 100  # of the intervals, by bootstrap
LEAST_VARIED = 1e-12  # of its size: a figure that varies by less is the same at all points


@dataclass(frozen=True)
class Share:
    """What one input has to do with how a figure varies."""

    first: float  # part of the variance that this input gives by itself
    first_within: tuple[float, float]  # 95 % interval, by bootstrap
    total: float  # with all that it does together with others
    total_within: tuple[float, float]
    elasticity: float  # relative change of the figure for one of the input, by regression; NaN of words


@dataclass(frozen=True)
class Outcome:
    """How one figure spreads, over those base samples that have it."""

    unit: str
    samples: int  # base samples with an answer at all their points
    mean: float
    deviation: float
    quantiles: dict[int, float]  # by per cent: 5, 25, 50, 75 and 95
    lowest: float
    highest: float
    shares: dict[str, Share] | None  # by input; None where the figure does not vary, or too few points have it

    @property
    def ranking(self) -> list[str]:
        """The inputs, that with the largest total index first; empty where there are no indices."""
        shares = self.shares or {}
        return sorted(shares, key=lambda name: -shares[name].total)


@dataclass(frozen=True, repr=False)
class Uncertain:
    """Figures of a scene whose inputs are uncertain; printed as a table. SI units."""

    title: str  # of the scene
    inputs: dict[str, str]  # by key, or keys with commas between: its distribution
    asked: int  # base samples
    samples: int  # drawn: the next power of two
    kept: int  # of them, those of which every point is solved
    seed: int
    solves: int
    refused: int  # points of them without an answer that can be trusted
    why: str  # the first reason for that; empty where there is none
    figures: dict[str, Outcome]
    dataset: Any  # xarray.Dataset of all points: A, B, and for each input A with its values of B
    notes: list[Note]
    wall_time: float

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers, without the points."""
        rest = {name: value for name, value in vars(self).items() if name not in ("figures", "dataset", "notes")}
        figures = {name: _table(outcome) for name, outcome in self.figures.items()}
        return plain(rest | {"figures": figures}) | coded(self.notes)

    def plot(self, figure: str | None = None, out: str | Path | None = None) -> Any:
        """A HoloViews object: the total indices of Sobol of one figure, the first by default, with 95 % intervals.

        Inputs stand one below another, that with the largest index first. `out`: a file to write, too, .png or .svg.
        Raises SceneError for a figure that is not there or has no indices, and for other files; ImportError for a file
        without the extra `plot`.
        """
        from ..notebook import uncertain_plots  # loads HoloViews, which nothing else here needs

        return pictured(lambda: uncertain_plots.uncertain(self, figure), out)

    def __str__(self) -> str:
        from ..notebook import uncertain_tables

        return uncertain_tables.lines(self)

    def __repr__(self) -> str:
        return f"<Uncertain: {', '.join(self.figures)} by {', '.join(self.inputs)}: {self.title[:60]!r}>"

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.uncertain_card(self)


def _table(outcome: Outcome) -> dict[str, Any]:
    shares = outcome.shares and {name: vars(share) for name, share in outcome.shares.items()}
    quantiles = {str(part): value for part, value in outcome.quantiles.items()}
    return vars(outcome) | {"quantiles": quantiles, "shares": shares, "ranking": outcome.ranking}


def uncertain(
    scene: SceneOrName,
    tolerances: Mapping[Any, Any],
    figures: Sequence[str] | None = None,
    points: int = USUAL_SAMPLES,
    seed: int = 0,
    method: str | Method | None = None,
    workers: int | None = None,
    progress: Callable[[Progress], Any] | None = None,
) -> Uncertain:
    """How far figures of an impact spread when inputs are uncertain, and how much of that each input makes.

    `tolerances`: by key, or keys with commas between them, "5%", "normal(2, 0.05)", "LOW..HIGH" or another distribution
    of `study`, or values that are equally likely; all independent. `figures`: names as in `Figures`; peak force,
    contact time, impulse and the velocity of the impactor where there are none.
    For each figure mean, standard deviation, quantiles, and for each input its first-order and total index of Sobol
    with a 95 % interval by bootstrap, and its elasticity by linear regression of the sample, which needs no solve.
    Two samples of `points` each are drawn from one Sobol sequence, from `seed` on; a number that is no power of two is
    rounded up, as the sequence is even then, and a note says so. Same numbers whatever the `workers`.
    Where a point is refused, or has a note that its figures are not to be trusted, the whole base sample (its points of
    A, of B and between) is left out, so that the indices are those of what is left; notes say how many and why.
    Error: that of sampling, as the intervals say; the elasticity where the figure is curved within the tolerance.
    Cost: n (d + 2) solves for n samples and d inputs, by `workers` processes (one on each processor).
    Raises SceneError for keys, distributions and figures that are none, bodies in space, or if more than half of the
    base samples are left out; ImportError without the extra `notebook`.
    """
    begun, scene, names = time.perf_counter(), scene_of(scene), asked_for(USUAL if figures is None else figures)
    if scene.normal is not None:
        raise SceneError("scene", scene.title, allowed("scenes-on-axis"))
    workers = crew_size(workers)
    design = paired_design(scene, tolerances, points, seed)
    inputs = {",".join(axis.keys): axis.words for axis in design.axes}
    found = points_of(Work(scene, design.keys, names, method, True, trusted=True), design, workers, progress)
    pages = (len(inputs) + 2, -1)
    missing = found.refused.values != ""
    answered = ~missing.reshape(pages).any(0)
    samples, kept = answered.size, int(answered.sum())
    why = str(found.reason.values[missing.argmax()]) if missing.any() else ""
    if 2 * kept < samples:
        raise SceneError("tolerances", inputs, allowed("mostly-solved", left=samples - kept, samples=samples, why=why))
    columns = _columns(design)
    outcomes = {
        name: _outcome(FIGURES[name][0], found[name].values.reshape(pages), answered, columns, inputs, seed)
        for name in names
    }
    partly = {name: outcome.samples for name, outcome in outcomes.items() if outcome.samples < kept}
    return Uncertain(
        scene.title, inputs, points, samples, kept, seed, missing.size, int(missing.sum()), why, outcomes, found,
        _notes(points, samples, kept, int(missing.sum()), why, partly), time.perf_counter() - begun,
    )  # fmt: skip


def _columns(design: Design) -> list[np.ndarray | None]:
    """The values of each input in A and B (2, samples); None of those that are words."""
    pages = len(design.axes) + 2
    rows = design.rows(0, 2 * design.size // pages)
    found, at = [], 0
    for axis in design.axes:
        values = [row[at] for row in rows]
        number = all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values)
        found.append(np.array(values, float).reshape(2, -1) if number else None)
        at += len(axis.keys)
    return found


def _outcome(
    unit: str,
    values: np.ndarray,
    answered: np.ndarray,
    columns: Sequence[np.ndarray | None],
    inputs: Mapping[str, str],
    seed: int,
) -> Outcome:
    """Of one figure's `values` (A, B and between, samples)."""
    there = answered & np.isfinite(values).all(0)
    values = values[:, there]
    both, samples = values[:2].ravel(), values.shape[1]
    if not samples:
        nothing = dict.fromkeys(QUANTILES, math.nan)
        return Outcome(unit, 0, math.nan, math.nan, nothing, math.nan, math.nan, None)
    mean, deviation = float(both.mean()), float(both.std())
    same = deviation <= LEAST_VARIED * float(np.abs(both).max())
    whole = "nearest" if (both == np.rint(both)).all() else "linear"  # of contacts there are no 4.7
    quantiles = dict(zip(QUANTILES, np.percentile(both, QUANTILES, method=whole).tolist(), strict=True))
    shares = None
    if not same and 2 * samples >= answered.size:
        kept = [None if column is None else column[:, there].ravel() for column in columns]
        shares = dict(zip(inputs, _shares(values, _elasticities(kept, both), seed), strict=True))
    deviation = 0.0 if same else deviation
    return Outcome(unit, samples, mean, deviation, quantiles, float(both.min()), float(both.max()), shares)


def indices(values: np.ndarray) -> np.ndarray:
    """First-order and total indices (2, inputs, ...) of a figure at A, B and between, (2 + inputs, ..., samples).

    Those of `scipy.stats.sobol_indices`, which takes neither a number of samples that is no power of two, as where some
    are left out, nor a single input, and whose bootstrap takes no seed. NaN where the figure does not vary.
    """
    middle = values[:2].mean((0, -1), keepdims=True)
    first, second, between = values[0] - middle[0], values[1] - middle[0], values[2:] - middle
    variance = values[:2].var((0, -1))
    variance = np.where(variance > 0.0, variance, np.nan)
    alone = (second * (between - first)).mean(-1)
    return np.stack([alone, 0.5 * np.square(first - between).mean(-1)]) / variance


def _shares(values: np.ndarray, elasticities: Sequence[float], seed: int) -> list[Share]:
    from scipy import stats  # half a second, which few need

    def of(samples: np.ndarray, axis: int) -> np.ndarray:
        return indices(values[:, samples])

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", stats.DegenerateDataWarning)  # of an input that does not matter at all
        drawn = stats.bootstrap(
            (np.arange(values.shape[1]),), of, n_resamples=RESAMPLES, batch=BATCH, vectorized=True,
            confidence_level=LEVEL, method="percentile", rng=seed,
        )  # fmt: skip
    lower, upper = drawn.confidence_interval
    (first, total), (low, low_total), (high, high_total) = indices(values).tolist(), lower.tolist(), upper.tolist()
    alone, whole = zip(low, high, strict=True), zip(low_total, high_total, strict=True)
    return [Share(*each) for each in zip(first, alone, total, whole, elasticities, strict=True)]


def _elasticities(columns: Sequence[np.ndarray | None], figure: np.ndarray) -> list[float]:
    """Of the plane nearest to the sample, at its middle; of an input (samples,) that does not vary there is none."""
    known = [number for number, column in enumerate(columns) if column is not None and np.ptp(column) > 0.0]
    found, middle = [math.nan] * len(columns), float(figure.mean())
    if not known or not middle:
        return found
    inputs = np.stack([column for column in columns if column is not None and np.ptp(column) > 0.0], 1)
    slopes = np.linalg.lstsq((inputs - inputs.mean(0)) / inputs.std(0), figure - middle)[0] / inputs.std(0)
    for number, value in zip(known, (slopes * inputs.mean(0) / middle).tolist(), strict=True):
        found[number] = value
    return found


def _notes(asked: int, samples: int, kept: int, refused: int, why: str, partly: Mapping[str, int]) -> list[Note]:
    notes = []
    if samples != asked:
        notes.append(Note("samples-rounded-up", Severity.REMARK, asked=asked, samples=samples))
    if kept < samples:
        said = {"points": refused, "left": samples - kept, "samples": samples, "why": why}
        notes.append(Note("samples-left-out", Severity.WARNING, **said))
    for name, count in partly.items():
        notes.append(Note("figure-at-some", Severity.WARNING, figure=name, count=count, samples=kept))
    return notes
