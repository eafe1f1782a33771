"""Modes that change with the contact: of mass and rod or beam together while they touch, of it alone while apart."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from .. import checks
from ..doubts import STILL_TOUCHING, bodies_that_bend
from ..machine import clock
from ..method import AFTERGLOW, MAX_ROUND_TRIPS, Method
from ..numerics import beam_switch
from ..numerics.beam_modes import attached_beam_modes
from ..numerics.beam_switch import SwitchedBeam
from ..numerics.mode_switch import MAX_PHASES, SwitchedModes
from ..numerics.rod_phases import LENGTH, SMOOTHINGS
from ..scene import Scene
from ..solution import ContactPeriod, Solution, summary

NEGLIGIBLE = 0.01  # share of the energy
MOST_MODES = 400


@dataclass(frozen=True)
class ModeSwitch(Method):
    """A rigid mass on a rod or beam without local compliance, every stretch of time by its own natural modes.

    Displacements and velocities are projected at each change; the energy that this and the modes left out lose counts
    as dissipated, and what the mass gives off at once as it touches is part of the impulse. `smoothing` says which
    contact force ends a contact with a rod: "delay", from the velocity of the mass and the wave that arrives;
    "lanczos", the modal series averaged over its shortest period; "none", the series as it is, which parts the bodies
    falsely before the front returns (Gibbs). Bending waves disperse, so that on a beam it is always the series, by the
    rule of thesis 5.5: no contact ends before it has pressed more than it has pulled.
    Error: for mass ratios 0.1 to 5 the rebound of a fixed rod is at most 0.7 / modes^2 of the impact speed off; that of
    a free rod 0.2 * mass ratio / modes, as the series rounds off the kink at which the bodies part. The force on a beam
    does not converge: each contact lasts as long as the highest mode has it, and the projections lose about a fifth of
    the energy at any number of modes.
    Cost: closed form, roots searched for; 10 modes of a beam and 50 contacts take some milliseconds.
    Source: thesis 5.3, 5.5, 9.2. Differs: (9.19), (5.28), (5.38), (5.42) and (5.43), see `solvers.numerics`.
    """

    modes: int = 50
    smoothing: str = "delay"
    estimate: bool = field(default=True, repr=False)

    NAME = "mode-switch"
    KNOBS = ("modes",)
    BEAMS = True

    @classmethod
    def read(cls, given: Mapping[str, object]) -> "ModeSwitch":
        given = checks.table("method", given, ("modes", "smoothing"))
        return cls(
            checks.whole_number("method.modes", given.get("modes", 50), 2, MOST_MODES),
            checks.choice("method.smoothing", given.get("smoothing", "delay"), SMOOTHINGS),
        )

    def why_not(self, scene: Scene) -> str | None:
        target = scene.target
        if scene.impactor.kind not in ("mass", "sphere") or target.kind not in ("rod", "beam"):
            kinds = f"{scene.impactor.kind} and {target.kind}"
            return f"a mass must strike a rod or a beam, got {kinds}; use 'waves' or 'modal'"
        if target.kind == "rod" and (target.support == "anechoic" or target.velocity or target.end_mass):
            return "the rod must be at rest, fixed or free, with no mass on its far end; use 'waves'"
        if target.velocity:
            return f"the beam must be at rest, got {target.velocity:g} m/s; use 'modal'"
        if scene.contact.NAME != "rigid":
            return f"the contact must be rigid, got {scene.contact.NAME}: modes of both bodies know no law; use 'modal'"
        if scene.mass_ratio > self.modes:
            return (
                f"{self.modes} modes do not tell so short a blow: at least the mass ratio of target to mass are "
                f"needed, got {scene.mass_ratio:.4g}; use {'waves' if target.kind == 'rod' else 'modal'!r}"
            )
        return None

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = clock()
        units = _units(scene)
        longest = MAX_ROUND_TRIPS * scene.time_unit if duration is None else duration
        course = self._course(scene, longest / units.time)
        wall_time = clock() - begun
        last = float(course.contacts[-1].end * units.time)
        if duration is None:
            duration = last + AFTERGLOW * scene.time_unit if course.parted else last
        elif course.stopped:
            duration = min(duration, last)
        motion = (SwitchedMotion if scene.target.kind == "rod" else SwitchedBeamMotion)(scene, course, units)
        contacts = [motion.period(contact) for contact in course.contacts]
        found = summary(scene, motion, contacts, duration, wall_time)
        found["diagnostics"] |= {
            "steps": len(course.phases),
            "estimated_error": self._estimated_error(scene, course, duration) if self.estimate else None,
            "projection_losses": [units.energy * phase.lost for phase in course.phases],
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
            notes=self._notes(scene, course, contacts, duration),
            **found,
        )

    def _knob(self, scene: Scene) -> str | None:
        return None if bodies_that_bend(scene) else super()._knob(scene)

    def _recount(self) -> str:
        if self.smoothing != "delay":
            return (
                "The truncated series undershoots before the front returns (Gibbs) and ends contacts: use the "
                "smoothing 'delay', which has no undershoot, or 'waves'."
            )
        return "So few modes do not tell slight gaps and contacts: keep more, or use 'waves'."

    def _course(self, scene: Scene, limit: float) -> SwitchedModes | SwitchedBeam:
        """`limit` in the units of the course."""
        target, mass = scene.target, scene.impactor.mass
        if target.kind == "rod":
            course = SwitchedModes(scene.mass_ratio, target.fixed, self.modes, self.smoothing)
        else:
            place = target.line, target.support, target.place, self.modes
            together = attached_beam_modes(*place, mass, end_mass=target.end_mass)
            course = SwitchedBeam(together, target.modes(self.modes), mass, scene.speed, target.length)
        course.solve(limit)
        return course

    def _estimated_error(self, scene: Scene, course: SwitchedModes | SwitchedBeam, duration: float) -> float:
        """Of the final velocity, relative to the impact speed: against two smaller numbers of modes.

        After the blow, though it may last longer with these; of a blow that is cut off, at that very instant.
        """
        units = _units(scene)
        limit = duration / units.time
        if course.parted:
            limit = course.phases[-1].start + 2.0 * scene.time_unit / units.time
        others = {self.modes // 2, 2 * self.modes // 3} if self.modes > 4 else {2 * self.modes, 3 * self.modes}
        at_limit = np.array([limit])
        final = course.mass_motion(at_limit)[1][0]
        finals = [replace(self, modes=modes)._course(scene, limit).mass_motion(at_limit)[1][0] for modes in others]
        estimated = float(max(abs(final - other) for other in finals)) * units.speed / scene.speed
        if scene.target.kind == "rod" and self.smoothing == "delay" and course.contacts[0].end < 1.0 <= limit:
            # parted at rest before the front is back, as any number of modes may, while the mass has v exp(-2 m2 / m1)
            estimated = max(estimated, math.exp(-2.0 * scene.mass_ratio))
        return estimated

    def _notes(self, scene: Scene, course, contacts: list[ContactPeriod], duration: float) -> list[str]:
        notes = []
        if contacts[-1].end >= duration * (1.0 - 1e-12):
            notes.append(STILL_TOUCHING)
        elif not (course.parted or course.stopped):
            notes.append(
                "The time solved ends before the bodies have parted for good: the velocities, and their estimated "
                "error, are those of that instant."
            )
        if scene.target.kind == "beam":
            return notes + scene.target.doubts_of_modes(self.modes) + _notes_on_a_beam(scene, course)
        if len(course.phases) >= MAX_PHASES:
            notes.append(f"Stopped after {MAX_PHASES} changes of modes: the truncated force chatters; use 'delay'.")
        lost = course.phases[-1].lost * _units(scene).energy / scene.initial_energy
        if lost > NEGLIGIBLE:
            needed = math.ceil(self.modes * lost / NEGLIGIBLE)
            remedy = f"keep {needed} modes to lose 1 %, or use 'waves'" if needed <= MOST_MODES else "use 'waves'"
            notes.append(
                f"{self.modes} modes do not hold how suddenly the end of the rod starts, {scene.mass_ratio:.3g} times "
                f"as heavy as the mass: {lost:.1%} of the energy counts as dissipated and is in waves; {remedy}."
            )
        return notes


def _notes_on_a_beam(scene: Scene, course: SwitchedBeam) -> list[str]:
    notes, count, pull = [], len(course.contacts), min(float(contact.forces.min()) for contact in course.contacts)
    if course.stopped:
        many = len(course.phases) >= beam_switch.MAX_PHASES
        reason, remedy = (
            (f"{len(course.phases)} changes of modes: the more modes, the shorter each contact", "a law and 'modal'")
            if many
            else ("more than the fastest modes can be followed, as so heavy a mass swings slowly", "'quasi-static'")
        )
        notes.append(
            f"Stopped at {course.contacts[-1].end:.3g} s before the bodies had parted for good, after {reason}; take "
            f"fewer modes, or {remedy}."
        )
    lost = course.phases[-1].lost / scene.initial_energy
    if count == 1 and lost > NEGLIGIBLE:
        notes.append(
            f"The changes of modes lose {lost:.0%} of the energy, and what the mass gives off in them is a blow before "
            "any force: the velocities go with the number of modes. Give the contact a law and use 'modal'."
        )
    if count > 1:
        notes.append(
            f"The {count} contacts and the velocity they end with are ill-conditioned: each contact ends with the echo "
            "of the highest mode, so that one mode more, or 0.01 % of mass, makes another sequence; the changes of "
            f"modes lose {lost:.0%} of the energy. Only the first contact and the apparent contact time are sure; for "
            "the rest give the contact a law and use 'modal', or compare many runs."
        )
    if pull < -1e-9 * max(contact.peak for contact in course.contacts):
        notes.append(
            f"The force pulls at the start of some contacts, up to {-pull:.3g} N: the shear force is the third "
            "derivative of displacements that the two sets of modes share only nearly (thesis 5.5)."
        )
    return notes


class _Units(NamedTuple):
    """Those of a course in SI, and what one metre of the target is in it."""

    time: float
    speed: float
    mass: float
    place: float

    @property
    def energy(self) -> float:
        return self.mass * self.speed**2


def _units(scene: Scene) -> _Units:
    if scene.target.kind == "rod":
        return _Units(scene.time_unit, scene.speed, scene.impactor.mass, LENGTH / scene.target.length)
    return _Units(1.0, 1.0, 1.0, 1.0)


class SwitchedMotion:
    """The course in SI units, evaluated by its modes at any time."""

    def __init__(self, scene: Scene, course: SwitchedModes | SwitchedBeam, units: _Units):
        self.scene, self.course = scene, course
        self._unit, self._speed, self._energy = units.time, units.speed, units.energy
        self._length = self._speed * self._unit  # of displacements
        self._impulse = units.mass * self._speed
        self._force = self._impulse / self._unit
        self._place = units.place

    def period(self, contact) -> ContactPeriod:
        return ContactPeriod(
            float(contact.start * self._unit),
            float(contact.end * self._unit),
            float(contact.impulse * self._impulse),
            float(contact.peak * self._force),
        )

    def _time(self, time):
        return np.asarray(time, float) / self._unit

    def force(self, time, after=True):
        return np.maximum(self._force * self.course.force(self._time(time), after), 0.0)

    def force_history(self):
        """At the instants at which the search looked, zero at both ends of each contact."""
        times, forces = [], []
        for contact in self.course.contacts:
            times += [[contact.start], contact.times, [contact.end]]
            forces += [[0.0], np.maximum(contact.forces, 0.0), [0.0]]
        return self._unit * np.concatenate(times), self._force * np.concatenate(forces)

    def impulse(self, time):
        """What the mass loses of momentum: at once by the change of modes as it touches, then by the series' force."""
        time = self._time(time)
        total = np.zeros_like(time)
        for contact, phase in zip(self.course.contacts, self.course.phases[::2], strict=True):
            inside = (time > contact.start) & (time < contact.end)
            total[time >= contact.end] += contact.impulse
            if inside.any():
                lost = phase.mass_velocity - self.course.mass_motion(time[inside])[1]
                total[inside] += self.course.mass * lost
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
        """Sum over the modes of each phase: `of_modes` gives amplitudes (time, modes), shapes (modes, x), and those of
        the motion as a whole, (time,) and (x,).
        """
        time, x = self._time(time), np.asarray(x, float) * self._place
        found = np.empty((time.size, x.size))
        numbers = self.course.phase_numbers(time)
        for number in np.unique(numbers).tolist():
            phase, chosen = self.course.phases[number], numbers == number
            amplitudes, shapes, *whole = of_modes(phase, time[chosen] - phase.start, x)
            found[chosen] = amplitudes @ shapes + (np.multiply.outer(*whole) if whole else 0.0)
        return found

    def displacement(self, time, x):
        def moved(phase, since, x):
            modes, whole = self.course.modes_of(phase), phase.rigid_position + phase.rigid_velocity * since
            return self.course.amplitudes(phase, since)[0], modes.shapes(x), whole, modes.rigid_shape(x)

        return self._length * self._field(time, x, moved)

    def velocity(self, time, x):
        def moving(phase, since, x):
            modes, whole = self.course.modes_of(phase), np.full_like(since, phase.rigid_velocity)
            return self.course.amplitudes(phase, since)[1], modes.shapes(x), whole, modes.rigid_shape(x)

        return self._speed * self._field(time, x, moving)

    def stress(self, time, x):
        def strained(phase, since, x):
            return self.course.amplitudes(phase, since)[0], self.course.modes_of(phase).slopes(x)

        return -self.scene.target.material.young * self._length * self._place * self._field(time, x, strained)

    def energies(self, time):
        time = self._time(time)
        parts = {name: self._energy * value for name, value in self.course.energies(time).items()}
        lost = np.array([phase.lost for phase in self.course.phases])[self.course.phase_numbers(time)]
        return parts | {"local": np.zeros_like(lost), "dissipated": self._energy * lost}


class SwitchedBeamMotion(SwitchedMotion):
    """The force is that of the series, pulls and all, as a contact that begins with one still counts them."""

    def force(self, time, after=True):
        return self.course.force(time, after)

    def force_history(self):
        """At the instants at which the search looked, from zero to zero: a projection leaves a force at once."""
        times, forces = [], []
        for contact in self.course.contacts:
            times += [[contact.start], contact.times, [contact.end]]
            forces += [[0.0], contact.forces, [0.0]]
        return np.concatenate(times), np.concatenate(forces)

    def stress(self, time, x):
        """On the side that is struck."""
        beam = self.scene.target
        return -beam.half_depth / beam.second_moment * self.moment(time, x)

    def moment(self, time, x):
        return self._resultant(time, x, "moments")

    def shear(self, time, x):
        return self._resultant(time, x, "shears")

    def _resultant(self, time, x, name):
        def bent(phase, since, x):
            return self.course.amplitudes(phase, since)[0], getattr(self.course.modes_of(phase), name)(x)

        return self._field(time, x, bent)
