"""Two bodies that move as a whole, with the contact law alone between them, with their weight or without."""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...contact import Hertz, Linear, Power
from ...contact.duration import contact_time, exponent_of
from ...numerics.collisions import (
    MOST_INSTANTS,
    Collision,
    damped_collision,
    path_collision,
    power_collision,
    sine_collision,
    weighted_collision,
)
from ...numerics.single_degree import SAMPLES
from ...numerics.weighted_path import GOES_ON, LEFT, RESTS
from ...scene import Scene
from ...solution.sampled_motion import SampledMotion, field_as_a_whole
from ...solution.solution import ContactPeriod
from ...text.notes import Note, Severity
from ..base import AFTERGLOW
from ..validity import cut_short
from ..weight import comes_to_rest

FLIGHT_INSTANTS = 100  # kept of each flight between contacts, a parabola
MOST_CONTACTS = 10_000  # within a duration that is asked for
LEAST_SPEED = 1e-9  # of the first, at which contacts that follow may begin


@dataclass(frozen=True)
class Estimate:
    """What a quasi-static model says of an impact: one contact, unless weight brings the body back within the time."""

    motion: SampledMotion
    duration: float  # [s]
    contacts: list[ContactPeriod]
    peak_indentation: float | None = None  # [m]
    residual_indentation: float | None = None  # [m]
    diagnostics: dict[str, float] = field(default_factory=dict)  # of this model alone
    notes: list[Note] = field(default_factory=list)  # of bodies that never part


def local(scene: Scene, model: str, duration: float | None) -> Estimate:
    """Two bodies that move as a whole, with the contact law between them. (3.28)-(3.34)"""
    if scene.weight_acceleration and model != "hertz-sine":
        return _under_weight(scene, duration)
    law = scene.contact
    masses = [body.modes(1).rigid_mass for body in (scene.impactor, scene.target)]
    found = _collision(law, model, 1.0 / sum(1.0 / mass for mass in masses), scene.speed)
    parting = float(found.time[-1])
    duration = parting + AFTERGLOW * scene.time_unit if duration is None else duration
    end = min(parting, duration)
    within = found.time <= end
    peak, depth = float(found.force[within].max()), float(found.indentation[within].max())
    contact = ContactPeriod(0.0, end, float(np.interp(end, found.time, found.impulse)), peak)
    motion = _as_a_whole(scene, _with_flight(found, max(duration, parting * (1.0 + 1e-9))))
    extra = {"delivered_restitution": float(-found.rate[-1] / scene.speed)}
    return Estimate(motion, duration, [contact], depth, float(law.dent(depth)), extra)


def _with_flight(found: Collision, last: float) -> Collision:
    """The contact, and free flight to the `last` instant."""
    longer = Collision(*(np.append(values, values[-1]) for values in found))
    longer.time[-1] = last
    longer.indentation[-1] += found.rate[-1] * (last - found.time[-1])
    longer.force[-2:] = 0.0
    return longer


def _as_a_whole(scene: Scene, found: Collision) -> SampledMotion:
    """Both bodies about their common centre of mass, which the weight of the impactor speeds up."""
    target, impactor = scene.target, scene.impactor
    first, second = impactor.modes(1), target.modes(1)
    time, fall = found.time, scene.weight_acceleration
    share = 1.0 / (1.0 + second.rigid_mass / first.rigid_mass)  # of the target in the approach
    drift = share * impactor.velocity + (1.0 - share) * target.velocity
    faster, farther = fall * time, 0.5 * fall * time**2
    freely = impactor.velocity + faster
    face, end = freely - found.impulse / first.rigid_mass, target.velocity + found.impulse / second.rigid_mass
    struck = drift * time + share * (farther - found.indentation)
    moved = first.mean_velocity(impactor.velocity * time + farther, struck + found.indentation)
    energies = {
        "impactor": first.moving_energy(impactor.mass, freely, face),
        "target_rigid": second.moving_energy(target.mass, target.velocity, end),
        "target_vibration": np.zeros_like(end),
        "local": found.stored,
        "dissipated": found.lost,
    }
    return SampledMotion(
        time=time,
        force=found.force,
        impulse=found.impulse,
        impactor_position=moved,
        impactor_velocity=first.mean_velocity(freely, face),
        end_position=struck,
        end_velocity=end,
        rigid_velocity=second.mean_velocity(target.velocity, end),
        energies=energies | ({"weight": -impactor.mass * fall * moved} if fall else {}),
        field=field_as_a_whole(target, time, struck, end) if target.bends else None,
        face_velocity=face,
    )


# --- under weight


def _under_weight(scene: Scene, duration: float | None) -> Estimate:
    """The same under the weight of the impactor: one contact; within a `duration` that is given, all that follow.

    A body that has left flies up and comes back, onto its dent where it has left one; one that cannot leave is followed
    until it rests.
    """
    first = _Weighted.of(scene)
    time, speed, deepest, pieces, contacts = 0.0, scene.speed, 0.0, [], []
    while True:
        found, ended, bound = first.contact(speed, deepest, duration is not None)
        deepest = max(deepest, float(found.indentation.max()))
        pieces.append(found)
        touched, time = time, time + float(found.time[-1])
        contacts.append((touched, time))
        if ended != LEFT:
            break
        flight, speed = first.flight(found, deepest)
        lasts = float(flight.time[-1])
        if duration is None:
            duration = time + min(AFTERGLOW * (time - touched), 0.5 * lasts)
        pieces.append(flight)
        time += lasts
        if time >= duration or len(contacts) == MOST_CONTACTS:
            break
    course = _joined(pieces)
    notes, wanted = [], duration
    if ended == RESTS:
        rests = contacts[-1][1]
        duration = rests if duration is None else duration
        course = _held(course, max(duration, rests * (1.0 + 1e-9)), first)
        contacts[-1] = contacts[-1][0], math.inf
        if duration >= rests:
            depth = float(course.indentation[-1])
            notes = [comes_to_rest(scene, rests, depth)]
    elif duration is None or time < duration:
        duration = time * (1.0 - 1e-12)
        notes = [Note("never-leaves", Severity.REMARK, time=time, damped=bool(scene.contact.LOSSY))]
        if wanted is not None or not (ended == GOES_ON or bound):
            notes = [cut_short(MOST_INSTANTS, "steps", time, wanted)]
    return _estimate(scene, course, contacts, duration, notes)


@dataclass(frozen=True)
class _Weighted:
    """What is the same in all contacts of a scene."""

    law: Any
    mass: float  # reduced [kg]
    fall: float  # [m/s2]
    least: float  # speed of a touch [m/s]

    @classmethod
    def of(cls, scene: Scene) -> "_Weighted":
        masses = [body.modes(1).rigid_mass for body in (scene.impactor, scene.target)]
        reduced = 1.0 / sum(1.0 / mass for mass in masses)
        return cls(scene.contact, reduced, scene.weight_acceleration, LEAST_SPEED * scene.speed)

    def contact(self, speed: float, deepest: float, on: bool) -> tuple[Collision, int, bool]:
        """From a touch at this speed; on: even where it swings for ever."""
        unit = contact_time(self.law, self.mass, speed) / math.pi
        unit = contact_time(self.law, self.mass, math.hypot(speed, self.fall * unit)) / math.pi
        return weighted_collision(self.law, self.mass, speed, self.fall, unit, deepest, on)

    def flight(self, found: Collision, deepest: float) -> tuple[Collision, float]:
        """From the parting until it is back where the contact opens, and with what speed [m/s]."""
        start, speed = float(found.indentation[-1]), -float(found.rate[-1])
        above = float(self.law.dent(deepest)) - start
        back = max(math.sqrt(max(speed**2 + 2.0 * self.fall * above, 0.0)), self.least)
        time = np.linspace(0.0, (speed + back) / self.fall, FLIGHT_INSTANTS + 1)
        nothing = np.zeros_like(time)
        rate = self.fall * time - speed
        depth = start + time * (0.5 * self.fall * time - speed)
        return Collision(time, depth, rate, nothing, nothing, nothing, nothing), back


def _joined(pieces: list[Collision]) -> Collision:
    """One after the other: time, impulse and loss add up."""
    found, ends = [], {"time": 0.0, "impulse": 0.0, "lost": 0.0}
    for piece in pieces:
        moved = {name: getattr(piece, name) + end for name, end in ends.items()}
        found.append(piece._replace(**moved))
        ends = {name: float(values[-1]) for name, values in moved.items()}
    return Collision(*(np.concatenate(values) for values in zip(*found, strict=True)))


def _held(course: Collision, last: float, of: _Weighted) -> Collision:
    """And at rest to the `last` instant, pressed by its weight."""
    longer = Collision(*(np.append(values, values[-1]) for values in course))
    longer.time[-1], longer.force[-1], longer.rate[-1] = last, of.mass * of.fall, 0.0
    longer.impulse[-1] += of.mass * of.fall * (last - course.time[-1])
    return longer


def _estimate(
    scene: Scene, course: Collision, spans: list[tuple[float, float]], duration: float, notes: list[Note]
) -> Estimate:
    """With what there is of the contacts up to `duration`."""
    contacts = []
    for start, end in spans:
        end = min(end, duration)
        if start >= end:
            break
        within = (course.time >= start) & (course.time <= end)
        before, after = np.interp((start, end), course.time, course.impulse)
        peak = max(float(course.force[within].max(initial=0.0)), float(np.interp(end, course.time, course.force)))
        contacts.append(ContactPeriod(start, end, float(after - before), peak))
    deepest = float(course.indentation[course.time <= duration].max())
    parted = np.flatnonzero(course.time <= spans[0][1])[-1]
    extra = {"delivered_restitution": max(float(-course.rate[parted] / scene.speed), 0.0)}
    motion = _as_a_whole(scene, course)
    return Estimate(motion, duration, contacts, deepest, float(scene.contact.dent(deepest)), extra, notes)


def _collision(law: Any, model: str, mass: float, speed: float) -> Collision:
    if model == "hertz-sine":
        return sine_collision(law.stiffness, mass, speed, SAMPLES)
    if isinstance(law, (Linear, Hertz, Power)):
        return power_collision(law.stiffness, exponent_of(law), mass, speed, SAMPLES)
    if law.LOSSY:
        return damped_collision(law, mass, speed, contact_time(law, mass, speed))
    return path_collision(law, mass, speed)
