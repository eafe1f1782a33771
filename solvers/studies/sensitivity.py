"""What many slightly different impacts have in common: bands of histories, and which figures can be trusted."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..scene import Scene
from ..text.notes import Note, Severity

FIRM, LOOSE = 10.0, 0.05  # largest amplification; largest change of what is only loosely known
ROUGHNESS = 1e-5  # changes below this may be those of the method's own steps
OUTER = 0.1  # of the largest perturbation: what jumps only beyond it is loosely known
FIGURES = {  # name in the result: unit, and what its changes are measured by
    "first_parting": ("s", "itself"),
    "final_velocity": ("m/s", "the speed of approach"),
    "impulse": ("N s", "itself"),
    "contacts": ("", "itself"),
    "last_parting": ("s", "itself"),
    "contact_time": ("s", "itself"),
    "peak_force": ("N", "itself"),
    "peak_indentation": ("m", "itself"),
    "residual_indentation": ("m", "the peak indentation"),
    "dissipated": ("J", "the initial energy"),
}


@dataclass(frozen=True)
class Band:
    """Where the histories of all runs lie, arrays (time,)."""

    lowest: np.ndarray
    low: np.ndarray  # a twentieth of the runs is below
    median: np.ndarray
    high: np.ndarray  # a twentieth is above
    highest: np.ndarray


@dataclass(frozen=True)
class Spread:
    """What becomes of one figure of the impact. Changes are relative to what `FIGURES` says: itself, the speed, ..."""

    quantity: str
    unit: str
    unperturbed: float
    median: float
    lowest: float
    highest: float
    half_range: float  # half of the widest difference among the runs, relative
    sensitivity: float  # d ln(quantity) / d ln(what is perturbed), median over the runs
    amplification: float  # largest change of it over the change that caused it
    verdict: str  # "firm", "loose" or "not to be trusted"


def spread_table(
    unperturbed: Mapping[str, float],
    figures: Mapping[str, np.ndarray],
    changes: np.ndarray,
    scales: Mapping[str, float],
) -> list[Spread]:
    """Spread and verdict of every figure that exists and is not always zero."""
    rows = []
    for name, values in figures.items():
        own = unperturbed[name]
        scale = scales.get(name, abs(own))
        if not (np.isfinite(values).all() and scale > 0.0) or not (own or values.any()):
            continue
        responses = (values - own) / scale
        whole = np.append(values, own)
        half_range = float(np.ptp(whole)) / (2.0 * scale)
        amplifications = np.maximum(np.abs(responses) - ROUGHNESS, 0.0) / np.abs(changes)
        jumping = np.abs(changes[amplifications > FIRM])
        rows.append(
            Spread(
                name,
                FIGURES[name][0],
                float(own),
                float(np.median(values)),
                float(whole.min()),
                float(whole.max()),
                half_range,
                float(np.median(responses / changes)),
                float(amplifications.max()),
                _verdict(jumping, half_range, OUTER * np.abs(changes).max()),
            )
        )
    return rows


def _verdict(jumping: np.ndarray, half_range: float, outer: float) -> str:
    """From the sizes of the changes that the figure does not follow in proportion."""
    if not jumping.size:
        return "firm"
    return "loose" if half_range <= LOOSE or jumping.min() > outer else "not to be trusted"


def ill_conditioned(table: list[Spread]) -> bool:
    """Whether some figure cannot be trusted at all, or what the impact is solved for is not firm."""
    verdicts = {row.quantity: row.verdict for row in table}
    return "not to be trusted" in verdicts.values() or verdicts["final_velocity"] != "firm"


def summary(scene: Scene, key: str, spread: float, table: list[Spread], ill: bool) -> Note:
    """What the spread means: cause and remedy where the impact is ill-conditioned."""
    firm, loose, untrusted = (
        [row.quantity for row in table if row.verdict == verdict] for verdict in ("firm", "loose", "not to be trusted")
    )
    rows = {row.quantity: row for row in table}
    velocity, count = rows["final_velocity"], rows["contacts"]
    changed = {"key": key, "spread": 100.0 * spread, "moved": 100.0 * velocity.half_range}
    if not ill:
        return Note("well-conditioned", Severity.REMARK, **changed, some=bool(loose), loose=loose)
    lowest, highest = round(count.lowest), round(count.highest)
    verdicts = {"lowest": lowest, "highest": highest, "varies": highest > lowest} | changed
    verdicts |= {"firm": firm, "loose": loose, "untrusted": untrusted}
    if velocity.verdict == "firm":
        return Note("marginal-contact", Severity.WARNING, **verdicts, several=highest > lowest + 1)
    return Note("ill-conditioned", Severity.WARNING, **verdicts, rigid=scene.rigid_contact)


def band_of(histories: list[np.ndarray]) -> Band:
    """Bounds, twentieths and median at each instant."""
    ordered = np.sort(np.array(histories).T, axis=1)  # (time, runs), each instant in one stretch of memory
    last = ordered.shape[1] - 1

    def quantile(share: float) -> np.ndarray:
        low = math.floor(share * last)
        part = share * last - low
        return (1.0 - part) * ordered[:, low] + part * ordered[:, min(low + 1, last)]

    return Band(ordered[:, 0].copy(), quantile(0.05), quantile(0.5), quantile(0.95), ordered[:, -1].copy())


def plain(value: Any) -> Any:
    """Arrays as lists, and None for what is no number, all the way down."""
    if isinstance(value, Mapping):
        return {name: plain(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(inner) for inner in value]
    if isinstance(value, np.ndarray):
        return [plain(inner) for inner in value.tolist()]
    return None if isinstance(value, float) and not math.isfinite(value) else value
