"""What many slightly different blows have in common: bands of histories, and which figures can be trusted."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .contact import Rigid
from .scene import Scene

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
    """What becomes of one figure of the blow. Changes are relative to what `FIGURES` says: itself, the speed, ..."""

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
    """Whether some figure cannot be trusted at all, or what the blow is solved for is not firm."""
    verdicts = {row.quantity: row.verdict for row in table}
    return "not to be trusted" in verdicts.values() or verdicts["final_velocity"] != "firm"


def told(scene: Scene, key: str, spread: float, table: list[Spread], ill: bool) -> str:
    """What the spread means, in words: cause and remedy where the blow is ill-conditioned."""
    named = {
        verdict: ", ".join(row.quantity.replace("_", " ") for row in table if row.verdict == verdict) or "nothing"
        for verdict in ("firm", "loose", "not to be trusted")
    }
    rows = {row.quantity: row for row in table}
    velocity, count = rows["final_velocity"], rows["contacts"]
    moves = f"the final velocity moves by {100.0 * velocity.half_range:.2g} % of the speed of approach"
    changed = f"with {key} changed by up to {100.0 * spread:.3g} %"
    if not ill:
        loose = "" if named["loose"] == "nothing" else f"; only loosely known: {named['loose']}"
        return f"Well conditioned: {changed} {moves} at most, in proportion to the change{loose}."
    number = f"{count.lowest:.0f} to {count.highest:.0f}" if count.highest > count.lowest else f"{count.highest:.0f}"
    verdicts = f"Firm: {named['firm']}; loose: {named['loose']}; not to be trusted: {named['not to be trusted']}."
    if velocity.verdict == "firm":
        return (
            f"A contact hangs by a hair: {changed} the blow has {number} contacts, as one of them only just happens or"
            f" only just does not, while {moves}, in proportion. {verdicts}"
        )
    cause = (
        "A rigid contact gives way by the highest modes alone, which decide when it breaks off and where it resumes"
        if isinstance(scene.contact, Rigid)
        else "The contact is stiff against the body, so that each parting hangs on the ringing left by the one before"
    )
    return (
        f"Ill-conditioned: {changed} the blow has {number} contacts and {moves}. {cause}: a hair's breadth turns the"
        f" sequence. Trust the band, not the curve. {verdicts} A contact law with the local compliance of the bodies"
        " ('hertz', 'plastic-power') makes the blow well conditioned."
    )


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
