"""Times that came with the library, scaled by a calibration, against those of this machine now.

A share: python -m bench.shipped --every 5, or by names of scenes. Times are of a processor, so that a loaded machine
counts little.
"""

import argparse
import time
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

import solvers
from solvers.accuracy import calibration, store
from solvers.accuracy.cost_model import scaled_time
from solvers.accuracy.refinement import Ladder, label, ladders
from solvers.accuracy.tradeoff_table import Point, TradeOff

from .automatic import costs_foretold
from .size import of
from .timing import row
from .tradeoffs import impacts_of

LONGEST = 0.25  # s of a solve that is done again
REPEATS, SECONDS = 7, 0.1  # of one point: solves at most, and seconds of them
CALIBRATION_SECONDS = 0.3
ALLOWED = 2.5  # times too slow or too fast
SHOWN = 12  # of the worst


class Again(NamedTuple):
    """A point of a shipped table that was solved again."""

    scene: str
    point: str
    shipped: float  # as scaled to this machine [s]
    raw: float  # as it was measured [s]
    now: float  # [s]


def measure(names: Sequence[str] = (), every: int = 1) -> dict[str, object]:
    """The coarsest, the middle and the finest point of every ladder, of all scenes, of some, or of each n-th."""
    names = names or of(solvers.scene_names(), ["fixed-rod"])
    impacts = list(impacts_of(names).values())[::every]
    found: list[Again] = []
    with threadpool_limits(1, user_api="blas"):
        for scene, (name, *_) in impacts:
            table = store.shipped(scene)
            if table is not None:
                found += _again(name, scene, TradeOff.from_table(table))
    return _figures(found) | costs_foretold(every)


def _again(name: str, scene: solvers.Scene, table: TradeOff) -> Iterator[Again]:
    calibration.calibrate(of(CALIBRATION_SECONDS, 0.02))
    there = table.calibration or {}
    levels = {
        label(level.table(), always=ladder.resolution): (ladder, place)
        for ladder in ladders(scene)
        for place, level in enumerate(ladder.levels)
    }
    for point in _some(table):
        if point.label in levels:
            scaled = scaled_time(point.wall_time, point.method, scene.struck, there)
            yield Again(name, point.label, scaled, point.wall_time, _solved(*levels[point.label], scene))


def _some(table: TradeOff) -> Iterator[Point]:
    for name in dict.fromkeys(point.ladder for point in table.points):
        own = [point for point in table.points if point.ladder == name and point.wall_time <= LONGEST]
        if own:
            yield from {id(each): each for each in (own[0], own[len(own) // 2], own[-1])}.values()


def _solved(ladder: Ladder, level: int, scene: solvers.Scene) -> float:
    """The shortest of some warm solves [s]."""
    ladder.solve(level, scene.struck)
    times: list[float] = []
    while len(times) < of(REPEATS, 1) and (len(times) < 3 or sum(times) < SECONDS):
        begun = time.thread_time()
        ladder.solve(level, scene.struck)
        times.append(time.thread_time() - begun)
    return min(times)


def _figures(found: Sequence[Again]) -> dict[str, object]:
    ratios = np.array([one.now / one.shipped for one in found])
    off = np.maximum(ratios, 1.0 / ratios)
    worst = np.argsort(-off)[:SHOWN]
    for place in worst:
        one = found[place]
        print(f"    {one.scene}, {one.point}: {1e3 * one.now:.3g} ms now, {1e3 * one.shipped:.3g} ms shipped and scaled"
              f" ({1e3 * one.raw:.3g} ms as measured): {ratios[place]:.2f} x")  # fmt: skip
    scenes = np.array([one.scene for one in found])
    middles = {name: float(np.median(ratios[scenes == name])) for name in dict.fromkeys(scenes.tolist())}
    among = np.array([ratio / middles[name] for ratio, name in zip(ratios, scenes.tolist(), strict=True)])
    return dict(
        [
            row("scenes", len(middles), ""),
            row("points solved again", len(found), ""),
            row("now over shipped: median", float(np.median(ratios)), "x"),
            row("now over shipped: 1 %", float(np.quantile(ratios, 0.01)), "x"),
            row("now over shipped: 99 %", float(np.quantile(ratios, 0.99)), "x"),
            row(f"within a factor {ALLOWED:g}", 100.0 * float(np.mean(off <= ALLOWED)), "%"),
            row("worst", float(off.max()), "x", f"<= {ALLOWED:g}"),
            row("worst of a scene's points against each other", float(np.maximum(among, 1.0 / among).max()), "x",
                f"<= {ALLOWED:g}"),
        ]
    )  # fmt: skip


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="built-in scenes; default: all")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="each n-th of them")
    options = parser.parse_args()
    measure(options.names, options.every)
