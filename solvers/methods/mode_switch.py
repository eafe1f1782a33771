"""Modes that change with the contact: of mass and rod together while they touch, of the rod alone while apart."""

import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from .. import checks
from ..method import AFTERGLOW, MAX_ROUND_TRIPS, Method
from ..numerics.mode_switch import MAX_PHASES, SwitchedModes
from ..numerics.rod_phases import LENGTH, SMOOTHINGS
from ..scene import Scene
from ..solution import ContactPeriod, Solution, summary


@dataclass(frozen=True)
class ModeSwitch(Method):
    """A rigid mass on a rod without local compliance, every stretch of time by its own natural modes.

    Displacements and velocities are projected at each change; the energy that this and the modes left out lose is
    `energy_error`. `smoothing` says which contact force ends a contact: "delay", from the velocity of the mass and the
    wave that arrives; "lanczos", the modal series averaged over its shortest period; "none", the series as it is, which
    parts the bodies falsely before the front returns (Gibbs).
    Error: for mass ratios 0.1 to 5 the rebound of a fixed rod is at most 0.7 / modes^2 of the impact speed off; that of
    a free rod 0.2 * mass ratio / modes, as the series rounds off the kink at which the bodies part.
    Cost: closed form, roots searched for.
    Source: thesis 5.3, 9.2. Differs: (9.19) and (5.28), see `solvers.numerics`.
    """

    modes: int = 50
    smoothing: str = "delay"
    estimate: bool = field(default=True, repr=False)

    NAME = "mode-switch"
    KNOBS = ("modes",)

    @classmethod
    def read(cls, given: Mapping[str, object]) -> "ModeSwitch":
        given = checks.table("method", given, ("modes", "smoothing"))
        return cls(
            checks.whole_number("method.modes", given.get("modes", 50), 2, 400),
            checks.choice("method.smoothing", given.get("smoothing", "delay"), SMOOTHINGS),
        )

    def why_not(self, scene: Scene) -> str | None:
        target = scene.target
        if scene.impactor.kind not in ("mass", "sphere") or target.kind != "rod":
            return f"a mass must strike a rod, got {scene.impactor.kind} and {target.kind}; use 'waves'"
        if target.support == "anechoic" or target.velocity or target.end_mass:
            return "the rod must be at rest, fixed or free, with no mass on its far end; use 'waves'"
        if scene.contact.NAME != "rigid":
            return f"the contact must be rigid, got {scene.contact.NAME}: modes of both bodies know no law; use 'modal'"
        if scene.mass_ratio > self.modes:
            return (
                f"{self.modes} modes do not tell so short a blow: at least the mass ratio of rod to mass are needed, "
                f"got {scene.mass_ratio:.4g}; use 'waves'"
            )
        return None

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = time.perf_counter()
        trip = scene.time_unit
        course = self._course(scene, MAX_ROUND_TRIPS if duration is None else duration / trip)
        wall_time = time.perf_counter() - begun
        last = float(course.contacts[-1].end * trip)
        if duration is None:
            duration = last + AFTERGLOW * trip if course.parted else last
        motion = SwitchedMotion(scene, course)
        contacts = [motion.period(contact) for contact in course.contacts]
        found = summary(scene, motion, contacts, duration, wall_time)
        unit = scene.initial_energy / 0.5
        found["diagnostics"] |= {
            "steps": len(course.phases),
            "estimated_error": self._estimated_error(scene, course) if self.estimate else None,
            "projection_losses": [unit * phase.lost for phase in course.phases],
            "left_out": course.left_out,
        }
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=duration,
            motion=motion,
            peak_force=max(contact.peak_force for contact in contacts),
            peak_indentation=None,
            residual_indentation=None,
            notes=self._notes(course, contacts, duration),
            **found,
        )

    def _course(self, scene: Scene, limit: float) -> SwitchedModes:
        course = SwitchedModes(scene.mass_ratio, scene.target.fixed, self.modes, self.smoothing)
        course.solve(limit)
        return course

    def _estimated_error(self, scene: Scene, course: SwitchedModes) -> float:
        """Of the final velocity, relative to the impact speed: against two smaller numbers of modes."""
        final = course.phases[-1].mass_velocity
        limit = course.phases[-1].start + 2.0
        others = {self.modes // 2, 2 * self.modes // 3} if self.modes > 4 else {2 * self.modes, 3 * self.modes}
        finals = [replace(self, modes=modes)._course(scene, limit).phases[-1].mass_velocity for modes in others]
        return float(max(abs(final - other) for other in finals))

    def _notes(self, course: SwitchedModes, contacts: list[ContactPeriod], duration: float) -> list[str]:
        notes = []
        if contacts[-1].end >= duration * (1.0 - 1e-12):
            notes.append("The bodies are still in contact at the end of the time solved.")
        if len(course.phases) >= MAX_PHASES:
            notes.append(f"Stopped after {MAX_PHASES} changes of modes: the truncated force chatters; use 'delay'.")
        elif self.smoothing == "none" and len(contacts) > 1:
            notes.append(
                "Contacts counted on the truncated series, whose undershoot (Gibbs) may end them falsely; "
                "the smoothing 'delay' has no undershoot."
            )
        return notes


class SwitchedMotion:
    """The course in SI units, evaluated by its modes at any time."""

    def __init__(self, scene: Scene, course: SwitchedModes):
        self.scene, self.course = scene, course
        self._trip, self._speed = scene.time_unit, scene.speed
        self._length = self._speed * self._trip  # of displacements
        self._impulse = scene.impactor.mass * self._speed
        self._force = self._impulse / self._trip
        self._slope = LENGTH / scene.target.length

    def period(self, contact) -> ContactPeriod:
        return ContactPeriod(
            float(contact.start * self._trip),
            float(contact.end * self._trip),
            float(contact.impulse * self._impulse),
            float(contact.peak * self._force),
        )

    def _time(self, time):
        return np.asarray(time, float) / self._trip

    def force(self, time, after=True):
        return np.maximum(self._force * self.course.force(self._time(time), after), 0.0)

    def force_history(self):
        """At the instants at which the search looked, zero at both ends of each contact."""
        times, forces = [], []
        for contact in self.course.contacts:
            times += [[contact.start], contact.times, [contact.end]]
            forces += [[0.0], np.maximum(contact.forces, 0.0), [0.0]]
        return self._trip * np.concatenate(times), self._force * np.concatenate(forces)

    def impulse(self, time):
        """Of the force of the series: what the mass loses of velocity while it touches."""
        time = self._time(time)
        total = np.zeros_like(time)
        for contact in self.course.contacts:
            inside = (time > contact.start) & (time < contact.end)
            total[time >= contact.end] += contact.impulse
            if inside.any():
                begin = self.course.mass_motion(np.array([contact.start]))[1]
                total[inside] += begin - self.course.mass_motion(time[inside])[1]
        return self._impulse * total

    def impactor_position(self, time):
        return self._length * self.course.mass_motion(self._time(time))[0]

    def impactor_velocity(self, time, after=True):
        return self._speed * self.course.mass_motion(self._time(time), after)[1]

    def end_position(self, time):
        return self._length * self.course.end_motion(self._time(time))[0]

    def end_velocity(self, time, after=True):
        return self._speed * self.course.end_velocity(self._time(time), after)

    def rigid_velocity(self, time, after=True):
        return self._speed * self.course.mean_motion(self._time(time), after)[1]

    def _field(self, time, x, of_modes):
        """Sum over the modes of each phase: `of_modes` gives amplitudes (time, modes), shapes (modes, x), rigid."""
        time, x = self._time(time), np.asarray(x, float) * self._slope
        found = np.empty((time.size, x.size))
        numbers = self.course.phase_numbers(time)
        for number in np.unique(numbers).tolist():
            phase, chosen = self.course.phases[number], numbers == number
            amplitudes, shapes, rigid = of_modes(phase, time[chosen] - phase.start, x)
            found[chosen] = rigid[:, None] + amplitudes @ shapes
        return found

    def displacement(self, time, x):
        def moved(phase, since, x):
            rigid = phase.rigid_position + phase.rigid_velocity * since
            return self.course.amplitudes(phase, since)[0], self.course.modes_of(phase).shapes(x), rigid

        return self._length * self._field(time, x, moved)

    def velocity(self, time, x):
        def moving(phase, since, x):
            rigid = np.full_like(since, phase.rigid_velocity)
            return self.course.amplitudes(phase, since)[1], self.course.modes_of(phase).shapes(x), rigid

        return self._speed * self._field(time, x, moving)

    def stress(self, time, x):
        def strained(phase, since, x):
            return self.course.amplitudes(phase, since)[0], self.course.modes_of(phase).slopes(x), np.zeros_like(since)

        return -self.scene.target.material.young * self._length * self._slope * self._field(time, x, strained)

    def energies(self, time):
        unit = self.scene.initial_energy / 0.5
        parts = {name: unit * value for name, value in self.course.energies(self._time(time)).items()}
        nothing = np.zeros_like(parts["impactor"])
        return parts | {"local": nothing, "dissipated": nothing}
