"""What can be said of a figure from its values at several resolutions: its order, how far it is from its limit."""

import math

import numpy as np

from ..scene import Scene
from ..text.notes import Note, Severity

CLOSE = 1e-6  # relative differences below this count as none
REGULAR = 0.7  # of natural logarithms about a fitted power: a factor of two
SETTLED = 1e-2  # differences among the last three that call for no order
SLOWEST = 0.4  # order that still counts as one
UNBOUNDED = 0.5  # smallest power of a figure that tends to zero, or to infinity
FEWEST_RATED = 4  # levels that show an order: to three a power and a limit can be fitted whatever they are
SURE = 2.0  # times what differences leave by an order that is not above the assumed one
MARGIN = 1.25  # of orders found by few levels over those of the methods, see `tests/solvers/methods/test_orders.py`
REBOUND = (  # figures that hang on the last contact
    "final_velocity",
    "impulse",
    "last_parting",
    "peak_deflection",
    "energy_lost",
    "energy_lost_share",
)
AT_THE_FACE = "peak_stress"  # of a rod where it is struck: sums of modes meet no force there, nor do meshes beside it
WHOLES = {  # what a figure is a part of, where that is not the largest of its own values
    "final_velocity": "speed",
    "first_velocity": "speed",
    "mean_jump": "speed",
    "energy_lost": "energy",
    "energy_lost_share": "energy",
    "joint_impulse": "impulse",
}


def orders_of(scene: Scene, kind: str) -> tuple[float, float]:
    """The highest order that a figure can have in the number of modes, elements or steps, by how smooth the contact
    force is, and the one that the least smooth figures may have, which is assumed where it is to hold.

    Of rods the frequencies go as the number of the mode, of slender beams as its square.
    Source: measured, see `docs/how-exact.md`.
    """
    smooth = not (scene.rigid_contact or scene.contact.JUMPS)
    least = 2.0 if smooth else 1.0
    slender = scene.bends and all(
        getattr(body, "theory", "") != "timoshenko" for body in (scene.impactor, scene.target)
    )
    if kind == "modes":
        return (7.0 if slender else 3.0) if smooth else 2.5 if slender else 2.0, least
    return 4.0 if kind == "elements" and slender else 2.0, least


def rate(
    name: str,
    counts: np.ndarray,
    values: np.ndarray,
    scale: float,
    kind: str,
    known: tuple[float, float],
    chaotic: bool = False,
) -> tuple[np.ndarray, float | None, Note]:
    """Relative differences to the finest, the order, and the note.

    `known`: orders as `orders_of` gives them; above the highest what is fitted is chance. `chaotic`: nothing is fitted.
    Error: a limit is as near as is said in 95 of 100 random impacts, `tests/solvers/studies/test_orders_told.py`.
    """
    differences = np.abs(values - values[-1]) / scale
    if kind == "restitution":
        return differences, None, _varies(values, scale)
    own = {"resolution": f"{kind}s" if kind == "step" else kind}
    if name == "contacts":
        return differences, None, _settles(counts, values, own["resolution"], chaotic)
    if differences.max() <= CLOSE:
        return differences, None, Note("same-for-all", Severity.REMARK, **own, error=differences.max())
    few = counts.size < FEWEST_RATED
    if not few and not (chaotic and name in REBOUND):
        power, irregular, last = _power(counts, np.abs(values))
        if abs(power) >= UNBOUNDED and irregular <= 0.5 * REGULAR and last >= 0.5:
            left = float(abs(values[-1])) / scale
            return differences, None, _without_bound(name, power, left, round(counts[-1]), own)
    last = differences[-3:].max()
    left_open = own | {"error": 100.0 * last, "count": round(counts[-3])}
    if chaotic:
        return differences, None, Note("no-limit", Severity.WARNING, **left_open)
    if few:
        return differences, None, Note("too-few", Severity.REMARK, **left_open, fewest=FEWEST_RATED)
    order, irregular = _order(counts, differences)
    if order is None or irregular > REGULAR or name == AT_THE_FACE or not SLOWEST <= order <= MARGIN * known[0]:
        settled = last <= SETTLED
        found = Note("settled", Severity.REMARK, **left_open) if settled else None
        return differences, None, found or Note("no-order", Severity.WARNING, **left_open)
    left = _left(counts, differences, min(order, known[1]))
    count = round(counts[-1])
    return differences, order, Note("converges", Severity.REMARK, **own, order=order, error=left, count=count)


def _without_bound(name: str, power: float, share: float, count: int, own: dict[str, str]) -> Note:
    """Of what follows a power of the resolution: to infinity, or to zero, which is a limit like others."""
    if power > 0.0:
        return Note("diverges", Severity.WARNING, **own, power=power)
    whole = WHOLES.get(name, "largest")
    return Note("vanishes", Severity.REMARK, **own, power=power, share=100.0 * share, whole=whole, count=count)


def _varies(values: np.ndarray, scale: float) -> Note:
    """With something that is no resolution, from its largest value to its least."""
    spread, changes = float(np.ptp(values)) / scale, np.diff(values)
    if spread <= CLOSE:
        return Note("same-for-each", Severity.REMARK, error=spread)
    way = "rises" if (changes < 0.0).all() else "falls" if (changes > 0.0).all() else "neither"
    return Note("varies", Severity.REMARK, error=100.0 * spread, way=way)


def _settles(counts: np.ndarray, values: np.ndarray, kind: str, chaotic: bool) -> Note:
    same = values == values[-1]
    first = int(np.flatnonzero(~same)[-1]) + 1 if not same.all() else 0
    if first < values.size - 1 and not (first and chaotic):  # where two are alike by chance
        counted = {"contacts": round(values[-1]), "count": round(counts[first]), "finest": round(counts[-1])}
        return Note("contacts-settle", Severity.REMARK, **counted, resolution=kind)
    return Note("contacts-scatter", Severity.WARNING, lowest=round(values.min()), highest=round(values.max()))


def _power(counts: np.ndarray, values: np.ndarray) -> tuple[float, float, float]:
    """Exponent of the power of the counts that the values follow, the scatter of their logarithms about it, and the
    exponent of the last two alone as a part of it.
    """
    if values.min() <= 0.0:
        return 0.0, math.inf, 0.0
    x, y = np.log(counts), np.log(values)
    slope, start = np.polyfit(x, y, 1)
    last = (y[-1] - y[-2]) / (x[-1] - x[-2]) / slope if slope else 0.0
    return float(slope), float(np.sqrt(np.mean((y - slope * x - start) ** 2))), float(last)


def _order(counts: np.ndarray, differences: np.ndarray) -> tuple[float | None, float]:
    """p of differences = C (counts^-p - finest^-p), which counts that the finest is not exact, and the scatter."""
    differing = differences[:-1] > CLOSE
    if differing.sum() < 2:
        return None, math.inf
    x, y = counts[:-1][differing] / counts[-1], np.log(differences[:-1][differing])
    orders = np.arange(0.1, 6.001, 0.02)
    misses = y - np.log(x[None, :] ** -orders[:, None] - 1.0)
    scatter = np.sqrt(np.mean((misses - misses.mean(axis=1, keepdims=True)) ** 2, axis=1))
    best = int(np.argmin(scatter))
    if best in (0, orders.size - 1):
        return None, math.inf
    return float(orders[best]), float(scatter[best])


def _left(counts: np.ndarray, differences: np.ndarray, order: float) -> float:
    """How far the finest is from the limit at most: the more of what the last two differences leave by an order."""
    return SURE * max(differences[i] / ((counts[-1] / counts[i]) ** order - 1.0) for i in (-2, -3))
