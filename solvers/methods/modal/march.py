"""Marching the modes of two bodies: how finely, for how long, and into which record."""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from ...numerics.flights import flights_of
from ...numerics.modal_steps import usual_step
from ...numerics.modes import Modes
from ...numerics.oscillators import Record, Residual, march, march_for_figures, residual_spring
from ...scene import Scene
from ..base import AFTERGLOW, MAX_ROUND_TRIPS
from ..parting import End, moves_alike, patience, swinging
from ..weight import FLIES, GOES_ON, LOOKS
from . import weight
from .motion import ModalMotion, last_touch
from .pair import Pair

MAX_STEPS = 4_000_000  # of any solve; it is ended there, which is said
REPEATED_STRIDE = 1_000  # steps between checkpoints of impacts that are repeated for their figures, not their fields
CHECKPOINT_NUMBERS = 100_000  # doubles kept of each kind, from which fields at any time are rebuilt


def _mobility(modes: Modes, truncated: bool) -> float:
    """Rate that the struck face gains at once by a unit impulse [1/kg], as far as it moves with the whole body."""
    return 1.0 / modes.rigid_mass + (0.0 if truncated else float(np.sum(modes.at_contact**2)))


def default_step(scene: Scene, pair: Pair) -> float:
    """Fine enough for the highest mode and for the shortest contact; never a longer run than is worth it."""
    law, residual = pair.law(scene)
    parts, bodies = (pair.impactor, pair.target), (scene.impactor, scene.target)
    reduced = 1.0 / sum(_mobility(*each) for each in zip(parts, pair.truncated, strict=True))
    trips = sum(body.time_unit for body in bodies if body.time_unit is not None)
    give = sum(body.softness for body in bodies if not body.bends)
    give += sum(
        float(np.sum((modes.at_contact / modes.frequencies) ** 2))
        for modes, body in zip(parts, bodies, strict=True)
        if body.bends
    )
    highest, bends = float(pair.frequencies.max(initial=0.0)), any(body.bends for body in bodies)
    masses = reduced, scene.speed, scene.time_unit, trips, scene.reduced_mass
    return usual_step(law, residual, *masses, give, highest, bends)


def follow(scene: Scene, pair: Pair, step: float, count: int | None, flights: bool = False) -> ModalMotion:
    """March `count` steps, or whole periods until the bodies have parted for good: see `methods.parting`; `flights`:
    those are taken at once, see `oscillators.march_for_figures`."""
    law, spring = _contact(scene, pair, step)
    slowest = [2.0 * math.pi / modes.frequencies[0] for modes in (pair.impactor, pair.target) if modes.frequencies.size]
    period, size = max(slowest, default=scene.time_unit), pair.frequencies.size
    bank, fall, surge = pair.bank(step), scene.fall, -scene.target.jerk
    stride = max(1, (count or 3 * math.ceil(period / step)) * size // CHECKPOINT_NUMBERS)
    most = count or int(min(MAX_STEPS, math.ceil(MAX_ROUND_TRIPS * scene.time_unit / step)))
    weighs = count is None and scene.weight_acceleration != 0.0
    chunk = count or min(most, math.ceil(period / step / (weight.PARTS if weighs else 1)))
    record = _record(count or min(3 * chunk, most), stride, size)  # as long as most take: there is nothing to copy
    record.velocity[0], record.rigid_velocity[0] = scene.impactor.velocity, scene.target.velocity
    displacement, velocity = np.zeros(size), np.zeros(size)
    done, touched, how, resting = 0, 0, End.FOLLOWED, GOES_ON
    flights = flights and fall == surge == 0.0 and not pair.damping.any()
    masses = pair.impactor.rigid_mass, pair.target.rigid_mass
    alike, longest = moves_alike(scene) or not swinging(scene), patience(scene)
    while done < most:
        until = min(done + (max(chunk, done // LOOKS) if weighs else chunk), most)
        if until > record.contact_force.size:
            record = _grown(record, min(2 * until, most), stride)
        if flights:
            known = flights_of(pair.frequencies, step, stride)
            march_for_figures(
                law, spring, *masses, step, bank, displacement, velocity, stride, done, until, record, known
            )
        else:
            march(law, spring, *masses, fall, surge, step, bank, displacement, velocity, stride, done, until, record)
        apart = not record.contact_force[done:until].any()
        begun, done = done, until
        if weighs:
            span = begun, done, stride
            resting, done = weight.state(scene, law, spring, bank, record, span, displacement, velocity, step)
            if resting == GOES_ON:
                continue
            if resting == FLIES:
                how = End.PARTED
                last = last_touch(scene, law, record, step, done)
                glow = math.ceil(AFTERGLOW * scene.time_unit / step)
                done = min(done, last + min(glow, weight.most_after(scene, record, last, step)))
            break
        if not apart:
            touched = done
        elif count is None and record.rigid_velocity[done] > record.velocity[done]:
            seen = last_touch(scene, law, record, step, done) + math.ceil(AFTERGLOW * scene.time_unit / step)
            if seen > done:
                continue
            swings = np.hypot(displacement, velocity).sum() + spring.compliance * abs(record.spring_force[done])
            if alike or record.rigid_position[done] - record.position[done] > swings:
                how = End.PARTED
            elif (done - touched) * step >= longest:
                how = End.MAY_TOUCH
            else:
                continue
            done = seen
            break
    return ModalMotion(scene, pair, step, stride, _cut(record, done, stride), how, resting)


def _contact(scene: Scene, pair: Pair, step: float) -> tuple[Any, Residual]:
    law, residual = pair.law(scene)
    return law, residual_spring(residual, step, pair.resolved_time, law.JUMPS, law.PLASTIC)


def again(motion: ModalMotion, scene: Scene, record: Record | None = None) -> tuple[ModalMotion, Record]:
    """Another impact of a rigid impactor on the same target over the same steps, and the record it was written into.

    For many impacts in a row that differ by the impactor or the contact law alone: nothing is worked out twice, and a
    record that is handed back is written over, with the motion that belonged to it.
    """
    pair = replace(motion.pair, impactor=scene.impactor.modes(0))
    step, stride = motion.duration / motion.steps, min(motion.steps, REPEATED_STRIDE)
    law, spring = _contact(scene, pair, step)
    if record is None:
        record = _record(motion.steps, stride, pair.frequencies.size)
    for history in record[:8]:
        history[0] = 0.0
    record.velocity[0], record.rigid_velocity[0] = scene.impactor.velocity, scene.target.velocity
    displacement, velocity = np.zeros((2, pair.frequencies.size))
    march(
        law, spring, pair.impactor.rigid_mass, pair.target.rigid_mass, scene.fall,
        -scene.target.jerk, step, pair.bank(step), displacement, velocity, stride, 0, motion.steps, record,
    )  # fmt: skip
    return ModalMotion(scene, pair, step, stride, record, End.FOLLOWED), record


def _record(steps: int, stride: int, modes: int) -> Record:
    """At rest; only what is written is ever memory that costs time."""
    instants = [np.empty(steps + 1) for _ in range(7)]
    record = Record(np.empty(steps), *instants, *(np.empty((steps // stride + 1, modes)) for _ in range(2)))
    for history in record:
        history[0] = 0.0
    return record


def _grown(record: Record, steps: int, stride: int) -> Record:
    larger = _record(steps, stride, record.checkpoint_displacement.shape[1])
    for old, new in zip(record, larger, strict=True):
        new[: old.shape[0]] = old
    return larger


def _cut(record: Record, steps: int, stride: int) -> Record:
    force, *instants = record[:8]
    return Record(
        force[:steps], *(values[: steps + 1] for values in instants), *(c[: steps // stride + 1] for c in record[8:])
    )
