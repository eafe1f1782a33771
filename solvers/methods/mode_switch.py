"""Modes that change with the contact: of mass and rod or beam together while they touch, of it alone while apart."""

import math
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from ..bodies import Bending, Rod
from ..numerics.switching import beam as beam_switch
from ..numerics.switching.beam import SwitchedBeam
from ..numerics.switching.rod import MAX_PHASES, SwitchedModes
from ..numerics.switching.rod_phases import LENGTH, SMOOTHINGS
from ..provenance import clock
from ..scene import Scene
from ..solution.solution import ContactPeriod, Solution
from ..solution.summary import summary
from ..text.notes import Note, Severity
from .base import AFTERGLOW, MAX_ROUND_TRIPS, Method
from .estimates import error_left, with_error
from .options import option, whole, word
from .validity import STILL_TOUCHING, bodies_that_bend

NEGLIGIBLE = 0.01  # share of the energy
MOST_MODES = 400
ROUNDING = 1e-9
# Of an estimate: other numbers of modes, as shares, and a factor on what they leave.
SHARES, FINER_SHARES, FEW_MODES, FACTOR = (1 / 2, 2 / 3), (2.0, 3.0), 4, 1.25


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

    modes: int = option(50, whole(2, MOST_MODES))
    smoothing: str = option("delay", word(SMOOTHINGS))
    estimate: bool = field(default=True, repr=False)

    NAME = "mode-switch"
    RESOLUTIONS = ("modes",)
    BEAMS = True

    def why_not(self, scene: Scene) -> Note | None:
        target = scene.target
        if not scene.impactor.free_mass or not isinstance(target, (Rod, Bending)):
            kinds = {"impactor": scene.impactor.kind, "target": target.kind}
            return Note("refusals.not-rod-or-beam", Severity.REFUSAL, **kinds)
        if isinstance(target, Rod) and (target.support == "anechoic" or target.velocity or target.end_mass):
            return Note("refusals.rod-not-at-rest", Severity.REFUSAL)
        if target.velocity:
            return Note("refusals.beam-not-at-rest", Severity.REFUSAL, velocity=target.velocity)
        if not scene.rigid_contact:
            return Note("refusals.law-of-switching", Severity.REFUSAL, law=scene.contact.NAME)
        if scene.mass_ratio > self.modes:
            rod, ratio = not target.bends, scene.mass_ratio
            return Note("refusals.too-few-modes", Severity.REFUSAL, modes=self.modes, ratio=ratio, rod=rod)
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
        motion = (SwitchedMotion if isinstance(scene.target, Rod) else SwitchedBeamMotion)(scene, course, units)
        contacts = [motion.period(contact) for contact in course.contacts]
        found = summary(scene, motion, contacts, duration, wall_time)
        found["diagnostics"] |= {
            "steps": len(course.phases),
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
            **with_error(found, lambda: self._estimated_error(scene, course, duration) if self.estimate else None),
        )

    def _resolution(self, scene: Scene) -> str | None:
        return None if bodies_that_bend(scene) else super()._resolution(scene)

    def _miscounts(self) -> str:
        if self.smoothing != "delay":
            return "gibbs"
        return "modes"

    def _course(self, scene: Scene, limit: float) -> SwitchedModes | SwitchedBeam:
        """`limit` in the units of the course."""
        target, mass = scene.target, scene.impactor.mass
        if isinstance(target, Rod):
            course = SwitchedModes(scene.mass_ratio, target.fixed, self.modes, self.smoothing)
        else:
            target = target.known_as(Bending)
            together = target.joined_modes(self.modes, mass)
            course = SwitchedBeam(together, target.modes(self.modes), mass, scene.speed, target.length)
        course.solve(limit)
        return course

    def _estimated_error(self, scene: Scene, course: SwitchedModes | SwitchedBeam, duration: float) -> float:
        """Of the final velocity, relative to the impact speed: against two other numbers of modes.

        After the impact, though it may last longer with these; of an impact that is cut off, at that very instant.
        """
        units = _units(scene)
        limit = duration / units.time
        if course.parted:
            limit = course.phases[-1].start + 2.0 * scene.time_unit / units.time
        others = [round(share * self.modes) for share in (SHARES if self.modes > FEW_MODES else FINER_SHARES)]
        at_limit = np.array([limit])
        final = course.mass_motion(at_limit)[1][0]
        finals = [replace(self, modes=modes)._course(scene, limit).mass_motion(at_limit)[1][0] for modes in others]
        differences = [(modes / self.modes, float(final - other)) for modes, other in zip(others, finals, strict=True)]
        order = 1.5 if isinstance(scene.target, Rod) and scene.target.fixed else 1.0  # about, or somewhat less
        estimated = FACTOR * error_left(differences, order) * units.speed / scene.speed
        if isinstance(scene.target, Rod) and self.smoothing == "delay" and course.contacts[0].end < 1.0 <= limit:
            # parted at rest before the front is back, as any number of modes may, while the mass has v exp(-2 m2 / m1)
            estimated = max(estimated, (1.0 + ROUNDING) * math.exp(-2.0 * scene.mass_ratio))
        return estimated

    def _notes(self, scene: Scene, course, contacts: list[ContactPeriod], duration: float) -> list[Note]:
        notes = []
        if contacts[-1].end >= duration * (1.0 - 1e-12):
            notes.append(STILL_TOUCHING)
        elif not (course.parted or course.stopped):
            notes.append(Note("not-parted", Severity.WARNING))
        if isinstance(scene.target, Bending):
            return notes + scene.target.notes_on_modes(self.modes) + _notes_on_a_beam(scene, course)
        if len(course.phases) >= MAX_PHASES:
            notes.append(Note("switching-chatters", Severity.WARNING, switches=MAX_PHASES))
        lost = course.phases[-1].lost * _units(scene).energy / scene.initial_energy
        if lost > NEGLIGIBLE:
            needed = math.ceil(self.modes * lost / NEGLIGIBLE)
            affordable = needed <= MOST_MODES
            notes.append(
                Note(
                    "switching-loses",
                    Severity.WARNING,
                    modes=self.modes,
                    ratio=scene.mass_ratio,
                    lost=lost,
                    affordable=affordable,
                    needed=needed,
                )
            )
        return notes


def _notes_on_a_beam(scene: Scene, course: SwitchedBeam) -> list[Note]:
    notes, count, pull = [], len(course.contacts), min(float(contact.forces.min()) for contact in course.contacts)
    if course.stopped:
        many = len(course.phases) >= beam_switch.MAX_PHASES
        end, switches = course.contacts[-1].end, len(course.phases)
        notes.append(Note("switching-stopped", Severity.WARNING, time=end, many=many, switches=switches))
    lost = course.phases[-1].lost / scene.initial_energy
    if count == 1 and lost > NEGLIGIBLE:
        notes.append(Note("switching-impulse", Severity.WARNING, lost=lost))
    if count > 1:
        notes.append(Note("switching-ill-conditioned", Severity.WARNING, contacts=count, lost=lost))
    if pull < -1e-9 * max(contact.peak for contact in course.contacts):
        notes.append(Note("switching-pulls", Severity.WARNING, pull=-pull))
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
    if isinstance(scene.target, Rod):
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

    def impulse(self, time, after=True):
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
