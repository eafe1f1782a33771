"""A chain of rods: exactly while that is affordable, then to a coarser tolerance, then on a grid."""

import math

from ..scene import Scene
from .chain_scene import ChainHistory, ChainScene
from .wave_chain import ExactHistory


def follow(scene: Scene, until: float, tolerance: float) -> ChainHistory:
    """Solve up to `until` [T], or until the impactor has parted for good if that is infinite."""
    given = ChainScene(scene)
    if scene.impactor.kind == "pulse" and not math.isfinite(until):
        until = scene.impactor.end / given.trip + 2.0
    return ExactHistory(given, until, tolerance)
