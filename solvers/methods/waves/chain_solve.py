"""A chain of rods: exactly while that is affordable, then to a coarser tolerance, then on a grid."""

import math

import numpy as np

from ...bodies import Pulse, Waveguide
from ...numerics.waves.parts import BONDED
from ...numerics.waves.record import IMPULSE
from ...scene import Scene
from ..base import AFTERGLOW, MAX_ROUND_TRIPS
from .chain import ExactHistory
from .chain_grid import COARSER, GridHistory
from .chain_scene import ChainHistory, ChainScene

COARSE_TOLERANCES = (1e-7, 1e-5)  # with each the echoes that count are some times fewer
FEW_CONTACTS = 5  # up to which errors of steps add up and no more: of 400 random impacts, what each magnified
LOOSER = 10.0  # what is found with a tolerance this many times larger gives its error
POOR = 1e-4  # error of a velocity [v]: with a larger one a chain is so sensitive that a grid may be better
SURE = 2.0  # times what one differs by from a coarser one: measured on random chains, see the tests
FINE_LENGTHS = 1e-3  # share of the length of a rod by which it may be changed, and nothing be seen of it
CLOSER = 1.25  # times the first contact: how far it is looked at anew
FIRST_LOOK = 20.0  # round trips of the longest rod: how far a grid looks at first for when the bodies part


def follow(scene: Scene, until: float, tolerance: float) -> ChainHistory:
    """Solve up to `until` [T], or until the impactor has parted for good if that is infinite.

    A prescribed force parts from nothing: then to two round trips after its end, and after its push could close gaps.
    """
    given = ChainScene(scene)
    if isinstance(scene.impactor, Pulse) and not math.isfinite(until):
        until = min((scene.impactor.end + _closing_time(scene.impactor, given)) / given.trip + 2.0, MAX_ROUND_TRIPS)
    history = ExactHistory(given, until, tolerance)
    if not history.gave_up:
        if _touches(history) > FEW_CONTACTS:
            magnified = SURE * _difference(history, ExactHistory(given, until, LOOSER * tolerance))
            history.error = max(history.error, magnified)
        return history
    reach, coarse, sprung = history.reach, None, given.chain.spring > 0.0  # of which the grid knows nothing
    whole = history if sprung else None
    del history  # a hundred megabytes
    for looser in COARSE_TOLERANCES:
        if looser > tolerance:
            coarse = ExactHistory(given, until, looser, instead_of=tolerance)
            if not coarse.gave_up:
                coarse.error = max(coarse.error, _difference(coarse, ExactHistory(given, until, LOOSER * looser)))
                break
            reach, coarse = coarse.reach, None
    if coarse is not None and (sprung or coarse.error <= POOR):
        return coarse
    if whole is not None:
        return whole
    horizon = max(2.0 * reach, FIRST_LOOK * max(rod.round_trip_time for rod in given.rods) / given.trip)
    grid = GridHistory(given, until, horizon)
    shown = grid.contacts[-1].end / given.trip + AFTERGLOW
    if grid.parted and shown < grid.reach:  # known by now to be all that is of interest: finer
        doubtful, grid = grid.doubtful, GridHistory(given, shown, shown)
        grid.doubtful = doubtful
    rough = GridHistory(given, grid.reach, grid.reach, COARSER, trials=1)
    grid.error = max(grid.error, SURE * _difference(grid, rough))
    _look_closer(grid)
    return grid if coarse is None or (grid.error < coarse.error and not grid.cut) else coarse


def _touches(history: ExactHistory) -> int:
    """The most of any faces that open and close."""
    joints = range(history.contact + 1, len(history.rods))
    opening = [node for node in joints if history.chain.kind[node] != BONDED]
    return max(len(history.contacts), *(len(history.periods(node)) for node in opening), 0)


def _look_closer(grid: GridHistory) -> None:
    """The first contact on a grid of its own, where that of all the time solved is too coarse for it: what it was off
    by is more than the last velocity, which may have died away by then, can show.
    """
    first = grid.contacts[0] if grid.contacts else None
    if first is None or first.end == first.start or grid.change() <= FINE_LENGTHS:
        return
    until = min(CLOSER * first.end / grid.trip, grid.reach)
    closer = GridHistory(grid.given, until, until).contacts if until < grid.reach else []
    known = [each for each in closer if each.start < first.end]  # several, where their gaps are finer than a step
    if known and known[-1].end < until * grid.trip:
        was, now = ((each.peak_force, each.end - each.start) for each in (first, known[0]))
        grid.first_off = max(abs(a / b - 1.0) for a, b in zip(was, now, strict=True))
        grid.contacts[:1], grid.error = known, max(grid.error, grid.first_off)


def _closing_time(pulse: Pulse, given: ChainScene) -> float:
    """Of all gaps [s], where all before each goes on with the momentum that the force gives; none if that pulls."""
    target = given.scene.target.known_as(Waveguide)
    moved = np.cumsum([rod.mass for rod in target.rods])[:-1]
    gaps = np.array([joint.gap for joint in target.joints])
    return float(moved @ gaps) / pulse.impulse if pulse.impulse > 0.0 else 0.0


def _difference(history: ChainHistory, coarse: ChainHistory) -> float:
    """Between two solves, in the final velocity of the impactor [v]; under a prescribed force, in what goes through the
    joints over the mass of the chain.
    """
    given = history.given
    pushed = [np.array([_pushed(each, node) for node in range(len(given.laws))]) for each in (history, coarse)]
    difference = np.abs(pushed[0] - pushed[1])
    if given.scene.prescribed_force:
        return float(difference.max() * given.force_unit * given.trip / (given.scene.target.mass * given.speed))
    return float(difference[given.contact] / given.striker)


def _pushed(history: ChainHistory, node: int) -> float:
    return float(history.sampled(node, IMPULSE, np.array([history.reach]))[0])
