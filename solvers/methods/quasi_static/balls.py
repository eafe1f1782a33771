"""A row of balls struck by a mass: every contact gives way by its law, every ball moves as a whole."""

from typing import Any

import numpy as np

from ...bodies import Balls
from ...contact.duration import contact_time
from ...contact.protocol import Law
from ...numerics.ball_chain import Course, follow
from ...provenance import clock
from ...scene import Scene
from ...solution.sampled_motion import SampledMotion
from ...solution.solution import ContactPeriod, Solution
from ...solution.summary import summary
from ...text.notes import Note, Severity
from ..base import AFTERGLOW, MAX_ROUND_TRIPS
from ..validity import STILL_TOUCHING

SLIGHT = 1e-9  # of the impulse of the impact: contacts of less are the wake of the wave, and are not listed


class RowMotion(SampledMotion):
    """The motion of an impact on a row of balls, with that of every ball and the force of every contact."""

    def __init__(self, positions: np.ndarray, velocities: np.ndarray, forces: np.ndarray, **histories: Any):
        super().__init__(**histories)
        self._positions, self._velocities, self._forces = positions, velocities, forces

    def ball_positions(self, time: np.ndarray) -> np.ndarray:
        """(time, balls), from where each was at first [m]."""
        return np.column_stack([self._at(time, each) for each in self._positions.T])

    def ball_velocities(self, time: np.ndarray) -> np.ndarray:
        """(time, balls) [m/s]."""
        return np.column_stack([self._at(time, each) for each in self._velocities.T])

    def contact_forces(self, time: np.ndarray) -> np.ndarray:
        """(time, contacts), from that with the impactor on [N]."""
        return np.column_stack([self._at(time, each) for each in self._forces.T])


def why_not(scene: Scene) -> Note | None:
    """Laws without memory and without damping only: what a contact of another kind leaves behind is not followed."""
    law = scene.contact
    if not scene.impactor.free_mass:
        return Note("refusals.mass-on-balls", Severity.REFUSAL, impactor=scene.impactor.kind)
    if scene.rigid_contact or law.LOSSY or law.PLASTIC:
        return Note("refusals.law-of-balls", Severity.REFUSAL, law=law.NAME)
    return None


def solve_balls(scene: Scene, method: dict[str, Any], duration: float | None) -> Solution:
    """Momentum is kept exactly, as the velocities follow from the impulses; energy as far as they are integrated."""
    begun = clock()
    row = scene.target.known_as(Balls)
    mass = np.array([scene.impactor.mass, *(ball.mass for ball in row.balls)])
    velocity = np.array([scene.impactor.velocity, *(0.0 for _ in row.balls)])
    laws: list[Law] = [scene.contact, *(law for law in scene.joint_laws if law is not None)]
    first = mass[0] * mass[1] / (mass[0] + mass[1])
    unit, limit = contact_time(laws[0], first, scene.speed), MAX_ROUND_TRIPS * scene.time_unit
    course = follow(mass, velocity, np.array([0.0, *row.gaps]), laws, unit, limit, duration)
    if duration is None and course.parted:
        course = _flown_on(course, AFTERGLOW * scene.time_unit)
    total = float(course.impulse[-1].max())
    periods = [
        [_period(course, contact, start, end) for start, end in found] for contact, found in enumerate(course.contacts)
    ]
    periods = [[period for period in each if period.impulse > SLIGHT * total] for each in periods]
    motion, last = _motion(scene, mass, laws, course), float(course.time[-1])
    found = summary(scene, motion, periods[0], last, clock() - begun)
    stored = sum(
        law.stored(max(a, 0.0), max(a, 0.0)) for law, a in zip(laws, course.indentation[-1].tolist(), strict=True)
    )
    energy = 0.5 * float(mass @ course.velocity[-1] ** 2) + stored
    found["diagnostics"] |= {
        "steps": course.steps,
        "energy_error": energy / scene.initial_energy - 1.0,
        "model": "local",
    }
    touching = course.force[-1].any()
    notes = [STILL_TOUCHING] if touching else []
    if not course.parted and not touching:
        notes.append(Note("not-parted", Severity.WARNING))
    return Solution(
        scene=scene,
        method=method,
        contacts=periods[0],
        duration=last,
        motion=motion,
        peak_force=max(period.peak_force for period in periods[0]),
        peak_indentation=float(course.indentation[:, 0].max()),
        residual_indentation=0.0,
        notes=notes,
        joints=periods[1:],
        ball_velocities=course.velocity[-1, 1:].tolist(),
        **found,
    )


def _flown_on(course: Course, time: float) -> Course:
    """With a free flight of this time [s] after the last parting."""
    later = course.time[-1] + time
    position = course.position[-1] + course.velocity[-1] * time
    apart = course.indentation[-1] - np.diff(course.velocity[-1]) * time

    def on(values: np.ndarray, last: np.ndarray) -> np.ndarray:
        return np.vstack((values, last))

    return course._replace(
        time=np.append(course.time, later),
        position=on(course.position, position),
        velocity=on(course.velocity, course.velocity[-1]),
        indentation=on(course.indentation, apart),
        force=on(course.force, np.zeros(apart.size)),
        impulse=on(course.impulse, course.impulse[-1]),
    )


def _period(course: Course, contact: int, start: float, end: float) -> ContactPeriod:
    within = (course.time >= start) & (course.time <= end)
    impulse = np.interp([start, end], course.time, course.impulse[:, contact])
    peak = float(course.force[within, contact].max()) if within.any() else 0.0
    return ContactPeriod(float(start), float(end), float(impulse[1] - impulse[0]), peak)


def _motion(scene: Scene, mass: np.ndarray, laws: list[Law], course: Course) -> RowMotion:
    """The first contact is the local one; what the balls hold among themselves counts as vibration of the row."""
    rows = course.indentation.clip(min=0.0).tolist()
    stored = np.array([[law.stored(a, a) for law, a in zip(laws, row, strict=True)] for row in rows])
    balls, moving = mass[1:], course.velocity[:, 1:]
    mean = moving @ balls / balls.sum()
    apart = 0.5 * (moving - mean[:, None]) ** 2 @ balls
    energies = {
        "impactor": 0.5 * mass[0] * course.velocity[:, 0] ** 2,
        "target_rigid": 0.5 * balls.sum() * mean**2,
        "target_vibration": apart + stored[:, 1:].sum(axis=1),
        "local": stored[:, 0],
        "dissipated": np.zeros_like(mean),
    }
    return RowMotion(
        course.position[:, 1:],
        course.velocity[:, 1:],
        course.force,
        time=course.time,
        force=course.force[:, 0],
        impulse=course.impulse[:, 0],
        impactor_position=course.position[:, 0],
        impactor_velocity=course.velocity[:, 0],
        end_position=course.position[:, 1],
        end_velocity=moving[:, 0],
        rigid_velocity=mean,
        energies=energies,
    )
