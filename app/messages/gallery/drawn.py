"""What a small moving picture is made of, and how it is stored: whole numbers, of each but the first their change."""

from dataclasses import dataclass
from typing import Any

import numpy as np

FRAMES = 61  # instants of a picture, which the browser shows in some seconds
WIDTH, HEIGHT = 640, 264  # of a picture, in its own units
SHADES = 24  # of either sign, of what a colour stands for


@dataclass(frozen=True)
class Part:
    """A line, a disc or an outline that is filled; what stands still has one frame.

    `x`, `y`: (frames, points), in units of the picture, y downwards; `size`: how thick, or the radius; `values`:
    (frames, points - 1) from -1 to 1, what the colours of a line stand for.
    """

    shape: str
    x: np.ndarray
    y: np.ndarray
    size: float = 0.0
    values: np.ndarray | None = None
    ink: str = "body"

    def table(self) -> dict[str, Any]:
        """As it is stored."""
        found = {"shape": self.shape, "ink": self.ink, "size": round(self.size), "points": self.x.shape[-1]}
        found |= {"x": _stored(self.x), "y": _stored(self.y)}
        return found | ({} if self.values is None else {"values": _stored(SHADES * self.values)})


def _stored(values: np.ndarray) -> list[int]:
    """The first frame, and how each differs from that before it; only the first if none does."""
    whole = np.rint(np.atleast_2d(values)).astype(int)
    still = not np.any(np.diff(whole, axis=0))
    return (whole[0] if still else np.concatenate((whole[:1], np.diff(whole, axis=0))).ravel()).tolist()


def line(x: Any, y: Any, size: float, values: np.ndarray | None = None, ink: str = "body") -> Part:
    """Through points (frames, points), or (points,) of a line that stands still."""
    x, y = np.broadcast_arrays(np.atleast_2d(np.asarray(x, float)), np.atleast_2d(np.asarray(y, float)))
    return Part("line", x, y, size, values, ink)


def disc(x: Any, y: Any, size: float, ink: str = "striker") -> Part:
    """At places (frames,)."""
    x, y = np.broadcast_arrays(np.atleast_1d(np.asarray(x, float)), np.atleast_1d(np.asarray(y, float)))
    return Part("disc", x[:, None], y[:, None], size, None, ink)


def block(x: Any, y: Any, half: float, size: float, ink: str = "striker") -> Part:
    """A box about places (frames,), so wide to either side, so high."""
    x, y = np.atleast_1d(np.asarray(x, float)), np.atleast_1d(np.asarray(y, float))
    return line(x[:, None] + [-half, half], np.broadcast_to(y[:, None], (x.size, 2)), size, None, ink)


def outline(x: np.ndarray, y: np.ndarray, ink: str = "body") -> Part:
    """Filled, through corners (frames, corners)."""
    return Part("area", np.atleast_2d(x), np.atleast_2d(y), 0.0, None, ink)


def fitted(parts: list[Part], aside: float = np.inf, margin: float = 16.0) -> list[Part]:
    """Parts in metres, x to the right and y upwards, moved and scaled so that the picture holds them all; sizes are of
    the picture already. `aside`: how far from the others what strikes is held, in their size; then it flies out."""
    room = max((each.size if each.shape == "disc" else 0.5 * each.size) for each in parts)

    def bounds(some: list[Part]) -> np.ndarray:
        low, high = (np.array([[f(p.x), f(p.y)] for p in some]) for f in (np.min, np.max))
        return np.stack((low.min(axis=0), high.max(axis=0)))

    whole, others = bounds(parts), bounds([each for each in parts if each.ink != "striker"] or parts)
    if np.isfinite(aside):
        more = aside * float(np.ptp(others, axis=0).max())
        whole = np.stack((np.maximum(whole[0], others[0] - more), np.minimum(whole[1], others[1] + more)))
    reach = np.maximum(np.ptp(whole, axis=0), 1e-12)
    scale = float(((np.array([WIDTH, HEIGHT]) - 2.0 * (margin + room)) / reach).min())
    middle = whole.mean(axis=0)
    return [
        Part(
            each.shape,
            WIDTH / 2 + scale * (each.x - middle[0]),
            HEIGHT / 2 - scale * (each.y - middle[1]),
            each.size,
            each.values,
            each.ink,
        )
        for each in parts
    ]
