"""Errors of cheap models as they were measured, read from the library's data (bench/measure_regimes.py makes it)."""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

STORED = Path(__file__).parent / "regimes.npz"
LEAST, MOST, CODES = 1e-5, 10.0, 254  # errors are kept as bytes, by their logarithm; 255: the model predicts nothing
NOTHING = 255


def encoded(errors: np.ndarray) -> np.ndarray:
    """Errors as bytes; rounding changes them by 3 % at most."""
    scaled = np.log(np.clip(errors, LEAST, MOST) / LEAST) / np.log(MOST / LEAST) * CODES
    return np.where(np.isfinite(errors), np.rint(scaled), NOTHING).astype(np.uint8)


def decoded(codes: np.ndarray) -> np.ndarray:
    """The way back; infinity where the model predicts nothing."""
    values = LEAST * (MOST / LEAST) ** (codes.astype(float) / CODES)
    return np.where(codes == NOTHING, np.inf, values)


@dataclass(frozen=True)
class Table:
    """Errors over two groups: ratio (n,), time (m,), errors (n, m, ...)."""

    ratio: np.ndarray
    time: np.ndarray
    errors: np.ndarray

    def around(self, ratio: float, time: float) -> np.ndarray:
        """The largest error at the measured points around this one; beyond the ends, at the nearest ones."""
        rows, columns = _beside(self.ratio, ratio), _beside(self.time, time)
        return self.errors[np.ix_(rows, columns)].max(axis=(0, 1))

    def covers(self, ratio: float, time: float) -> bool:
        """Whether the point lies within what was measured."""
        low, high = self.ratio[0] * (1 - 1e-9), self.ratio[-1] * (1 + 1e-9)
        return bool(low <= ratio <= high and self.time[0] * (1 - 1e-9) <= time <= self.time[-1] * (1 + 1e-9))


def _beside(values: np.ndarray, value: float) -> list[int]:
    after = int(np.searchsorted(values, value))
    return sorted({max(after - 1, 0), min(after, values.size - 1)})


@cache
def _stored() -> dict[str, np.ndarray]:
    with np.load(STORED) as found:
        return {name: found[name] for name in found.files}


@cache
def models_table(family: str, law: str) -> Table:
    """Of the models of `models.MODELS`: errors (ratio, time, models, questions); law of rods only."""
    rod = family.endswith("-rod")
    return _table("rod" if rod else "beam", f"{family}/{law}" if rod else family)


@cache
def lossy_table(family: str, law: str, loss: float) -> Table:
    """The same under a law that loses energy, `models.LOSSES`: errors (ratio, time, models, questions)."""
    return _table("rod_lossy" if family.endswith("-rod") else "beam_lossy", f"{family}/{law}/{loss:g}")


@cache
def modes_table(family: str) -> tuple[np.ndarray, Table]:
    """Numbers of modes, and errors (ratio, time, counts, questions)."""
    kind = "rod" if family.endswith("-rod") else "beam"
    return _stored()[f"{kind}_counts"], _table(f"{kind}_modes", f"{family}/modes")


@cache
def theory_table(family: str) -> Table:
    """Of Euler's and Bernoulli's theory against Timoshenko's, by slenderness: errors (slenderness, time, questions)."""
    return _table("slender", f"{family}/theory")


def plastic_curve(law: str) -> tuple[np.ndarray, np.ndarray]:
    """Speeds over that of first yield, and what an elastic law misses there, (ratios, 3): restitution, force, time."""
    return _stored()["yield_ratios"], _stored()[f"plastic/{law}"].astype(float)


def how_measured() -> str:
    """Script, machine, seconds and numbers of scenes, as JSON."""
    return str(_stored()["made"])


def _table(axes: str, name: str) -> Table:
    stored = _stored()
    return Table(stored[f"{axes}_axes_ratio"], stored[f"{axes}_axes_time"], decoded(stored[name]))
