"""The march over a mesh until the bodies part: how far and how finely, and how it ends."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ... import validation
from ...contact.duration import contact_time
from ...scene import Scene
from ..base import AFTERGLOW, MAX_ROUND_TRIPS
from ..parting import End, moves_alike, patience
from ..weight import GOES_ON, LOOKS, PARTS, SWINGS_ON, moved, stays

# Of the shortest contact there can be. With fewer the peak force is off by more than the mesh is; orders:
# `tests/solvers/methods/test_orders.py`.
STEPS_PER_CONTACT = 100
# Of the largest stable step of central differences. Nearer to it a contact that opens and closes feeds the mesh.
EXPLICIT_LIMIT_SHARE = 0.8
# Unless more are asked for. Fewer, and long impacts are solved more coarsely, at which the energy is kept all the same.
MAX_USUAL_STEPS = 60_000
MAX_STEPS = 4_000_000  # of any solve; it is ended there, which is said
SNAPSHOTS = 1000  # of all nodes, over the time expected
MOST_NUMBERS = 10_000_000  # doubles kept of nodes


@dataclass(frozen=True)
class Plan:
    """How far and how finely to march."""

    step: float
    count: int | None  # None: until the bodies part
    most: int
    chunk: int
    stride: int

    @classmethod
    def of(cls, scene: Scene, law: Any, fine: float, limit: float, given: int | None, duration: float | None, nodes):
        """`fine` [s]: the step wished for; `limit` [s]: the largest that is stable. Raises SceneError beyond it."""
        ringing = [body for body in (scene.target, scene.impactor) if body.time_unit is not None]
        trips = [body.time_unit or 0.0 for body in ringing]
        touch = contact_time(law, scene.reduced_mass, scene.speed)
        reduced = scene.reduced_mass
        expected = 3.0 * (sum(trips) + touch + math.pi * math.sqrt(reduced * sum(body.softness for body in ringing)))
        fine = min(max(min(fine, touch / STEPS_PER_CONTACT), expected / MAX_USUAL_STEPS), EXPLICIT_LIMIT_SHARE * limit)
        count = given
        if duration is not None:
            count = min(max(10, math.ceil(duration / fine)), MAX_STEPS) if given is None else given
            fine = duration / count
            if fine > limit * (1.0 + 1e-9):
                least = math.ceil(duration / limit)
                raise validation.SceneError("method.steps", count, validation.allowed("explicit-steps", least=least))
        expected_steps, nodes = count or math.ceil(expected / fine), max(nodes, 1)
        stride = max(1, expected_steps // min(SNAPSHOTS, max(10, MOST_NUMBERS // nodes)))
        if count is not None:  # so that the last instant has its snapshot
            stride, count, fine = _in_strides(count, stride, fine)
        period = 2.0 * max(trips)
        most = int(min(MAX_STEPS, MAX_ROUND_TRIPS * scene.time_unit / fine, stride * MOST_NUMBERS // nodes))
        most = count or stride * max(1, most // stride)
        looked = period / PARTS if scene.weight_acceleration else period
        chunk = count or stride * math.ceil(looked / fine / stride)
        return cls(fine, count, most, chunk, stride)


def _in_strides(count: int, stride: int, step: float) -> tuple[int, int, float]:
    """Stride, steps and step [s] of a march whose last instant has its snapshot, over the same time.

    The number of steps is kept where it has a divisor near the stride; else it is rounded up, by less than a stride, as
    a prime number of them would store every one.
    """
    divisor = next((part for part in range(stride, (stride - 1) // 2, -1) if count % part == 0), None)
    if divisor is not None:
        return divisor, count, step
    whole = stride * math.ceil(count / stride)
    return stride, whole, step * count / whole


class March(NamedTuple):
    """What marches: in both methods the same, but for coordinates.

    masses [kg]: what an impact feels of impactor and target as wholes, infinite of what is held; law: of the contact;
    make(steps): an empty record; advance(begin, end, record): the instant reached; impulse(record, instant) [N s];
    room(record, instant): by how much further the bodies as wholes are apart than their faces reach [m];
    pushes(record, instant): impulses of all steps before (steps,) [N s]; rings(record, instant): what both bodies hold
    beside their motion as wholes [J].
    """

    masses: tuple[float, float]
    law: Any
    make: Callable[[int], Any]
    advance: Callable[[int, int, Any], int]
    impulse: Callable[[Any, int], float]
    room: Callable[[Any, int], float]
    pushes: Callable[[Any, int], np.ndarray]
    rings: Callable[[Any, int], float]


def follow(scene: Scene, plan: Plan, march: March) -> tuple[Any, int, End]:
    """March by chunks until the bodies have parted for good, see `methods.parting`: record, steps to keep, and how it
    ended."""
    record, done, touched = march.make(plan.chunk), 0, 0
    alike, longest = moves_alike(scene), patience(scene)
    while done < plan.most:
        until = min(done + max(plan.chunk, plan.stride * (done // LOOKS // plan.stride)), plan.most)
        if until > record.contact_force.size - 1:
            record = _grown(record, march.make(max(until, min(2 * until, plan.most))))
        before, reached = march.impulse(record, done), march.advance(done, until, record)
        if reached < until:
            return record, reached, End.FOLLOWED
        begun, done, gained = done, until, march.impulse(record, until)
        if plan.count is None and scene.weight_acceleration:
            how, seen = _under_weight(scene, plan, march, record, (begun, done))
            if how is not None:
                return record, seen, how
        elif gained != before:
            touched = done
        elif plan.count is None and _apart(scene, march.masses, gained):
            apart = alike or march.room(record, done) > 0.0
            if apart or (done - touched) * plan.step >= longest:
                seen = _shown(plan, scene, march.pushes(record, done), done)
                return record, seen, End.PARTED if apart else End.MAY_TOUCH
    return record, done, End.FOLLOWED


def _under_weight(scene: Scene, plan: Plan, march: March, record: Any, span: tuple[int, int]) -> tuple[End | None, int]:
    """How a march of what weight brings back has ended by the end of a span of instants, and the steps to keep; None:
    it has not. It flies where it is higher than anything that still rings can reach: what follows is another impact."""
    done = span[1]
    pushes = march.pushes(record, done)
    velocity, place = moved(scene, plan.step, pushes, march.masses[0])
    for instant in _highest(plan, pushes, place, span):
        if march.room(record, instant) > 0.0:
            return End.PARTED, _shown(plan, scene, pushes, instant)
    depth, deepest = float(record.indentation[done]), max(float(record.indentation[: done + 1].max()), 0.0)
    fallen = scene.weight_acceleration * (float(place[-1]) - float(march.law.dent(deepest)))
    kept = march.masses[0] * (0.5 * float(velocity[-1]) ** 2 - fallen)
    kept += march.rings(record, done) + float(march.law.stored(depth, deepest))
    how = stays(scene, velocity, float(pushes[-1]) / plan.step, kept)
    return {GOES_ON: None, SWINGS_ON: End.NEVER}.get(how, End.FOLLOWED), done


def _highest(plan: Plan, pushes: np.ndarray, place: np.ndarray, span: tuple[int, int]) -> list[int]:
    """The snapshots in a span of instants at which the impactor is highest of each flight."""
    shots = np.arange(span[0] + plan.stride, span[1] + 1, plan.stride)
    shots = shots[np.append(pushes, 0.0)[shots] + pushes[shots - 1] == 0.0]
    flight = np.cumsum(pushes > 0.0)[shots - 1]
    breaks = np.flatnonzero(np.diff(flight)) + 1
    return [int(each[np.argmin(place[each])]) for each in np.split(shots, breaks) if each.size]


def _apart(scene: Scene, masses: tuple[float, float], pushed: float) -> bool:
    """Whether the bodies move apart as wholes."""
    return scene.target.velocity + pushed / masses[1] > scene.impactor.velocity - pushed / masses[0]


def _grown(record: Any, larger: Any) -> Any:
    for old, new in zip(record, larger, strict=True):
        new[: old.shape[0]] = old
    return larger


def _shown(plan: Plan, scene: Scene, pushes: np.ndarray, seen: int) -> int:
    """Steps to keep of a march of bodies that were seen to have parted at an instant: a little beyond the last touch
    before, up to a snapshot; pushes (steps,): zero where they do not touch. Of one under weight a part of the flight.
    """
    touching = np.flatnonzero(pushes > 0.0)
    before = touching[touching < seen]
    last = int(before[-1]) + 1 if before.size else 1  # in a step too long for a law they part as they touch
    glow, done = math.ceil(AFTERGLOW * scene.time_unit / plan.step), pushes.size
    if scene.weight_acceleration:
        later = touching[before.size :]
        done = int(later[0]) if later.size else done
        glow = min(glow, max(1, (done - last) // 2))
    return min(done, plan.stride * math.ceil((last + glow) / plan.stride))
