"""When an impact under weight is over: what has left comes back, and what never leaves comes to rest."""

import math
from typing import Any

import numpy as np

from ...numerics.oscillators import Bank, Record, Residual, carried
from ...scene import Scene
from ...text.notes import Note
from ..weight import FLIES, RESTS, SWINGS_ON, comes_to_rest, never_leaves, stays

PARTS = 4  # of the slowest period, after each of which it is looked whether all is over


def state(
    scene: Scene,
    law: Any,
    spring: Residual,
    bank: Bank,
    record: Record,
    span: tuple[int, int, int],
    q: Any,
    p: Any,
    step: float,
) -> tuple[int, int]:
    """Of a march up to an instant, with its oscillators there, (modes,) as in `Bank`; and the instant that shows it.

    span: the instant at which was looked last, that up to which it has come, and the stride of its checkpoints.
    It flies where it is higher than anything that still rings can reach: what follows is another impact. Where kinetic
    energy, what bends, and the height do not suffice to come back to where it touched first, it never leaves.
    """
    mass, fall, (_, done, _) = scene.impactor.mass, scene.weight_acceleration, span
    flies = _flies(law, spring, bank, record, span)
    if flies:
        return FLIES, flies
    force, depth = float(record.contact_force[done - 1]), float(record.indentation[done])
    deepest = max(float(record.indentation[: done + 1].max()), 0.0)
    dent, velocity = float(law.dent(deepest)), record.velocity[: done + 1]
    rings = float((bank.energy * (q * q + p * p)).sum())
    rings += 0.5 * spring.compliance * float(record.spring_force[done]) ** 2
    kept = 0.5 * mass * float(velocity[-1]) ** 2 + rings + float(law.stored(depth, deepest))
    kept -= mass * fall * float(record.position[done] - dent)
    return stays(scene, velocity, force, kept, 0.5 * mass * (fall * step) ** 2), done  # or leaves for less than a step


def _flies(law: Any, spring: Residual, bank: Bank, record: Record, span: tuple[int, int, int]) -> int:
    """The first instant since was looked last at which the body is beyond the reach of what rings; 0: there is none."""
    begin, done, stride = span
    free = np.append(record.contact_force[begin:done] == 0.0, False)
    ends = np.flatnonzero(free & ~np.append(free[1:], False)) + 1
    starts = np.flatnonzero(free & ~np.append(False, free[:-1]))
    deepest = np.maximum.accumulate(np.maximum(record.indentation[: done + 1], 0.0))
    cells = []
    for start, end in zip((begin + starts).tolist(), (begin + ends).tolist(), strict=True):
        gap = record.rigid_position[start : end + 1] - record.position[start : end + 1]
        highest = int(np.argmax(gap))
        if gap[highest] + float(law.dent(float(deepest[start]))) > 0.0:
            cells.append(min(start + highest, done - 1))
    if not cells:
        return 0
    instants, modes = np.array(cells), bank.cosine.size
    q, p = np.empty((2, instants.size, modes))
    saved = record.checkpoint_displacement, record.checkpoint_velocity
    carried(bank, *saved, stride, record.contact_force, instants, q, p)
    bulge = np.hypot(q, p).sum(axis=1) + spring.compliance * np.abs(record.spring_force[instants])
    gap = record.rigid_position[instants] - record.position[instants]
    gap = gap + np.array([float(law.dent(float(depth))) for depth in deepest[instants]])
    beyond = np.flatnonzero(gap > bulge)
    return int(instants[beyond[0]]) if beyond.size else 0


def most_after(scene: Scene, record: Record, last: int, step: float) -> int:
    """Steps of a flight that begins after `last` steps, up to half of it."""
    return math.ceil(max(-float(record.velocity[last]), 0.0) / scene.weight_acceleration / step)


def notes(scene: Scene, how: int, duration: float, depth: float) -> list[Note]:
    """Of a body that never leaves."""
    if how == RESTS:
        return [comes_to_rest(scene, duration, depth)]
    if how == SWINGS_ON:
        return [never_leaves(scene, duration)]
    return []
