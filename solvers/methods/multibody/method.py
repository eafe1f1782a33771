"""A mechanism followed through impacts as far as it moves."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from ...bodies import Mechanism
from ...jit.reference import referred
from ...numerics.multibody import flight, moving, variational
from ...numerics.multibody.bouncing import march
from ...provenance import clock
from ...scene import Scene
from ...solution.solution import ContactPeriod, Solution
from ...text.notes import Note, Severity
from ..base import Method, SceneNotSupported
from ..estimates import LEFT_BY_MODES, with_error
from ..freezing import freezing_error
from ..options import option, real, whole
from ..validity import cut_short
from .flexible_motion import FlexibleMotion
from .floating_linkage import bent_start, fastest_vibration, floating_linkage, room_of
from .law import law_of
from .linkage import Rows, centres, rates_of_centres, rigid_linkage, struck_by
from .motion import MovingMotion, RigidMotion

# Of the fastest link, or of the shortest one as it swings under its weight: with as many the energy of a double
# pendulum is kept to 1e-8, see `tests/solvers/numerics/multibody/test_moving.py`.
STEPS_PER_TURN = 200
MAX_STEPS = 1_000_000
MOST_IMPACTS = 2_000
USUAL_TURNS = 1.0  # for which it is followed, where no duration is asked for
USUAL_PERIODS, USUAL_STEPS = 2.0, 3_000  # of the slowest vibration, of flexible links, if both are less than that
# Of the fastest one: it is off by 6e-5 in a period, velocities of the shipped scenes by up to 2e-6 of the speed of
# approach, which is little beside what the modes leave out.
STEPS_PER_VIBRATION = 12
MIN_STEPS_PER_VIBRATION = 6  # with fewer the fastest ones are slower than they are
LEAST_TURN = 1e-9  # [rad] of links; less is rounding of what only slides
MAX_SLOPE = 0.1  # of bent links; what is left out is of its square
MOST_STEPS_OF_FLEXIBLE = 300_000  # which take a minute; more must be asked for
MAX_INSTANTS = 50_000  # that are kept, besides impacts
STOP = "stop"  # a kind of body
MOST_OPEN = 1e-6  # of the size of the mechanism, by which joints may be open: else they could not be closed
MOST_DRIFT, GREAT_DRIFT = 1e-5, 1e-2  # of the energy; usual steps keep it to 1e-7 and better
FINER = 4  # times as many steps where they do not
SAME_PLACE = 0.1  # of the time, by which joints open sooner or later with more steps where that is not for want of them
# The error of the modes of links is measured by twice as many, at least so many, in a quarter of the steps that
# fewer take, or so many: then the highest vibrations go slower, but give way as they should.
LEAST_MODES, MOST_MODES, LEAST_STEPS = 8, 60, 500
MOST_CONTACT_STEPS = 100_000  # of contact laws, all kept; they take some ten seconds


@dataclass(frozen=True)
class Multibody(Method):
    """Links that move as far as they like, joints closed in positions and velocities, by a symplectic integrator of
    sixth order; impacts of a point mass by a contact law or, where the contact is rigid, with a restitution, located to
    rounding.

    The mass strikes the line of the struck link, bent as it is, along a normal that turns with it, and misses it a
    hundredth of its length beside its ends; so does a stop, a point that is held. Flexible links start bent by their
    weight and inertia, which is steady to first order.
    Assumes: slopes of bent links small beside 1; no friction; a dent meets the mass again wherever that strikes.
    Error: sixth order in the step, second in that of a contact by a law; the energy does not drift, but for rounding:
    3e-15 a step of flexible links.
    Source: thesis 6.2, 6.3, (6.12); kernels: see `numerics.multibody.moving`, `variational` for flexible links, and
    `pressing` for contact laws.
    """

    restitution: float = option(1.0, real(0.0, 1.0))
    steps: int | None = option(None, whole(10, MAX_STEPS))  # over the whole duration
    contact_steps: int = option(200, whole(10, 100_000))  # of the shortest contact by a law that there can be
    most_contact_steps: int = field(default=MOST_CONTACT_STEPS, repr=False)  # after which it is ended
    estimate: bool = field(default=True, repr=False)
    quick: bool = field(default=False, repr=False)  # whether free motion is of second order only, in as many steps

    NAME = "multibody"
    WEIGHT = True
    BEAMS = MOVES = True

    def why_not(self, scene: Scene) -> Note | None:
        target = scene.target
        if not isinstance(target, Mechanism):
            return Note("refusals.no-mechanism", Severity.REFUSAL, target=target.kind)
        if not (scene.impactor.free_mass or scene.impactor.kind == STOP):
            return Note("refusals.mass-on-mechanism", Severity.REFUSAL, impactor=scene.impactor.kind)
        return None

    def too_long(self, scene: Scene, duration: float | None, most: int) -> Note | None:
        """The note that the vibrations of flexible links need more steps than `most` in this time [s], or None."""
        mechanism = scene.target.known_as(Mechanism)
        lasts, steps = self._steps(mechanism, scene.speed, duration)
        if self.steps is not None or not mechanism.flexible or steps <= most:
            return None
        reached = lasts * most / steps
        return Note("refusals.flexible-steps", Severity.REFUSAL, steps=steps, most=most, reached=reached)

    def lasts(self, scene: Scene, duration: float | None) -> tuple[float, int]:
        """For how long it is followed [s], as is usual without a duration, and in how many steps."""
        return self._steps(scene.target.known_as(Mechanism), scene.speed, duration)

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        reason = self.too_long(scene, duration, MOST_STEPS_OF_FLEXIBLE)
        if reason:
            raise SceneNotSupported("method.duration", duration, reason)
        begun = clock()
        motion, steps, full, torn = self._follow(scene, duration)
        wall_time = clock() - begun
        end = float(motion.time[-1])
        contacts = motion.contacts()
        energy = {name: float(value[-1]) for name, value in motion.energies(motion.time[-1:]).items()}
        initial = scene.initial_energy
        drift = _drift(scene, motion)
        final = float(motion.impactor_velocity(np.array([end]))[0])
        law = not scene.rigid_contact
        deepest = float(motion.course.contact[:, flight.INDENTATION].max())
        diagnostics = {
            "energy_error": (sum(energy.values()) - initial) / initial,
            "energy_drift": drift,
            "momentum_error": self._momentum_error(scene, motion, contacts[0].end),
            "constraint_error": motion.widest_gap,
            "steps": steps,
            **({} if law else {"balances": motion.impulses[0].size}),
            "wall_time": wall_time,
        }
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=end,
            motion=motion,
            impulse=float(motion.course.contact[-1, flight.IMPULSE]),
            impactor_velocity=final,
            target_velocity=float(motion.rigid_velocity(np.array([end]))[0]),
            restitution=self._restitution(scene, motion, contacts[0].end),
            energy={"initial": initial} | energy,
            notes=self._notes(scene, motion, contacts, full) + _notes_on_steps(motion, drift, torn),
            peak_force=max(contact.peak_force for contact in contacts) if law else None,
            peak_indentation=deepest if law else None,
            residual_indentation=float(scene.contact.dent(deepest)) if law else None,
            **with_error(
                {"diagnostics": diagnostics},
                lambda: self._estimated_error(scene, motion, steps) if self.estimate and not torn else None,
            ),
        )

    def _restitution(self, scene: Scene, motion: MovingMotion, parted: float) -> dict[str, float | None]:
        """Of the first contact; by impulses that of the balances."""
        time = np.array([parted])
        apart = float(motion.end_velocity(time)[0] - motion.impactor_velocity(time)[0]) / scene.speed
        given = self.restitution if scene.rigid_contact else None
        return {"newton": None, "poisson": given, "newton_at_contact": apart}

    @staticmethod
    def _momentum_error(scene: Scene, motion: MovingMotion, parted: float) -> float:
        """Of the first contact: what the mass has lost from instant to instant, but for its weight, and the impulse,
        over that of approach; of a stop what the links have lost, but for their weight and the ground."""
        course = motion.course
        rows = np.flatnonzero((course.time[:-1] < parted) | (course.time[1:] <= parted))
        if scene.impactor.held:
            mass, lost = motion.mechanism.mass, motion.given_to_links(rows)
        else:
            mass = scene.impactor.mass
            fallen = np.multiply.outer(np.diff(course.time), motion.mechanism.system.gravity)
            lost = mass * np.hypot(*(np.diff(course.speed, axis=0) - fallen)[rows].T)
        return float((lost - np.diff(course.contact[:, flight.IMPULSE])[rows]).sum()) / (mass * scene.speed)

    def _estimated_error(self, scene: Scene, motion: MovingMotion, steps: int) -> float | None:
        """Of the last velocity of the mass, of the struck point where that is held, relative to the speed of approach,
        against half the steps, of contacts too; of links that bend a quarter of them, with more modes. None where
        joints cannot be closed so."""
        end, finer, fewer = motion.time[-1:], _finer(scene), max(10, steps // 2)
        left = 1.0
        if finer is not scene:
            needed = self._steps(finer.target.known_as(Mechanism), scene.speed, float(end[0]))[1]
            fewer, left = max(10, steps // 4, min(needed // 2, LEAST_STEPS)), LEFT_BY_MODES
        coarser = replace(self, steps=fewer, contact_steps=max(10, self.contact_steps // 2))
        other = coarser._follow(finer, float(end[0]))
        found, other_found = (
            each.end_velocity(end) if scene.impactor.held else each.impactor_velocity(end)
            for each in (motion, other.motion)
        )
        return None if other.torn else left * float(np.abs(found - other_found)[0]) / scene.speed

    def _follow(self, scene: Scene, duration: float | None) -> "_Followed":
        """In more steps than usual where these do not keep joints and energy, as where an impact makes links fast."""
        duration, steps = self._steps(scene.target.known_as(Mechanism), scene.speed, duration)
        most = MAX_STEPS if not scene.target.known_as(Mechanism).flexible else MOST_STEPS_OF_FLEXIBLE
        torn_at = math.inf
        while True:
            found = self._followed(scene, duration, steps)
            end = float(found.motion.time[-1])
            kept = not found.torn and _drift(scene, found.motion) <= MOST_DRIFT
            stuck = found.torn and abs(end - torn_at) <= SAME_PLACE * end  # at a dead point no step is short enough
            if kept or stuck or self.steps is not None or self.quick or FINER * steps > most:
                return found
            torn_at, steps = end if found.torn else math.inf, FINER * steps

    def _followed(self, scene: Scene, duration: float, steps: int) -> "_Followed":
        mechanism = scene.target.known_as(Mechanism)
        moves = _flexible(mechanism) if mechanism.flexible else _rigid(mechanism)
        contact, normal = struck_by(mechanism, scene.impactor), np.array(mechanism.struck.normal)
        rows = moves.rows.joint.size
        begun = moves.coordinates, moves.rates, moves.struck, scene.impactor.velocity * normal
        state, later = (flight.state_of(*begun, rows) for _ in range(2))
        every = math.ceil(steps / MAX_INSTANTS)
        law, surface = law_of(scene, mechanism, self.contact_steps, duration / steps)
        most = 2 * MOST_IMPACTS if scene.rigid_contact else self.most_contact_steps
        kept = flight.course(steps // every + most + 3, state.q.size, rows)
        stages = moving.SINGLE if self.quick else moving.STAGES
        seen = moves.seen(kept.time.size, len(mechanism.links))
        count = march(
            referred(moves.linkage), referred(moves.room), referred(contact), law, referred(surface), stages,
            self.restitution, duration / steps, steps, every,
            referred(state), referred(later), referred(kept), referred(seen),
        )  # fmt: skip
        open_rows = np.flatnonzero(~(seen.gap[:count] <= MOST_OPEN * mechanism.extent))
        torn = bool(open_rows.size)
        count = max(2, int(open_rows[0])) if torn else count
        course, seen = (type(each)(*(values[:count] for values in each)) for each in (kept, seen))
        full = not torn and float(course.time[-1]) < duration - 1e-6 * duration / steps
        return _Followed(moves.motion(scene, course, seen, moves.linkage, moves.rows), steps, full, torn)

    def _notes(self, scene: Scene, motion: MovingMotion, contacts: list[ContactPeriod], full: bool) -> list[Note]:
        found = []
        if full and scene.impactor.held and scene.rigid_contact and motion.impulses[0].size < MOST_IMPACTS:
            found.append(Note("rests-on-stop", Severity.REMARK, time=float(motion.time[-1])))
        elif full:
            kind, limit = ("balances", MOST_IMPACTS) if scene.rigid_contact else ("steps", self.most_contact_steps)
            found.append(cut_short(limit, kind))
        if not scene.rigid_contact:
            if self.restitution != Multibody.restitution:
                found.append(Note("law-without-restitution", Severity.WARNING, restitution=self.restitution))
            found += _turning_notes(motion, contacts)
        return found + _notes_on_misses(motion) + self._notes_on_bending(motion)

    def _notes_on_bending(self, motion: MovingMotion) -> list[Note]:
        """Of flexible links that bend too far, or whose vibrations the steps are too long for."""
        if not isinstance(motion, FlexibleMotion):
            return []
        found, steepest = [], motion.steepest
        if not steepest <= MAX_SLOPE:
            severity = Severity.WARNING if steepest < 1.0 else Severity.INVALID
            found.append(Note("links-bend-far", severity, slope=steepest, allowed=MAX_SLOPE))
        duration = float(motion.time[-1])
        _, steps = self._steps(motion.mechanism, motion.scene.speed, duration)
        period = 2.0 * math.pi / fastest_vibration(motion.mechanism)
        if steps * period < MIN_STEPS_PER_VIBRATION * duration:
            needed = math.ceil(MIN_STEPS_PER_VIBRATION * duration / period)
            found.append(Note("vibrations-unresolved", Severity.WARNING, period=period, needed=needed))
        return found

    def _steps(self, mechanism: Mechanism, speed: float, duration: float | None) -> tuple[float, int]:
        """How long it is followed [s], and in how many steps."""
        turn, fastest = self._turn(mechanism, speed), 0.0
        usual = USUAL_TURNS * turn
        if mechanism.flexible:
            slowest = float(mechanism.frozen.vibrations[0][0])
            fastest = fastest_vibration(mechanism)
            soon = max(USUAL_PERIODS / slowest, USUAL_STEPS / (STEPS_PER_VIBRATION * fastest))
            usual = min(usual, 2.0 * math.pi * soon)
        duration = usual if duration is None else duration
        wanted = duration * max(STEPS_PER_TURN / turn, STEPS_PER_VIBRATION * fastest / (2.0 * math.pi))
        most = MAX_STEPS if not mechanism.flexible else math.inf
        return duration, self.steps or int(min(most, max(10, math.ceil(wanted))))

    @staticmethod
    def _turn(mechanism: Mechanism, speed: float) -> float:
        """Shortest time in which a link turns once, as fast as it is or as the mass can make it, or swings [s]."""
        system, rates = mechanism.system, mechanism.frozen.rates
        lengths = np.array([link.length or math.inf for link in system.links])
        spins = np.abs([system.spin(i, rates) for i in range(len(system.links))])
        shortest = float(lengths.min())
        swing = math.sqrt(1.5 * float(np.hypot(*system.gravity)) / shortest)
        fastest = max(float(spins.max()), 2.0 * speed / shortest, swing)
        return 2.0 * math.pi / fastest if fastest > 0.0 else 1.0


def _notes_on_misses(motion: MovingMotion) -> list[Note]:
    """That the mass passes the end of the struck link: one that is struck endwise has hardly any face."""
    mechanism, impactor = motion.mechanism, motion.scene.impactor
    contact, length = struck_by(mechanism, impactor), mechanism.struck_link.length
    endwise = contact.high - contact.low < 0.5 * length
    missed = motion.missed(contact.low, contact.high, math.inf if endwise else 0.5 * length)
    if missed is None:
        return []
    values = {"link": mechanism.struck.link, "time": missed[0], "apart": missed[1]}
    severity = Severity.WARNING if endwise else Severity.REMARK
    return [Note("passes-link", severity, **values, body=impactor.kind, endwise=endwise)]


def _turning_notes(motion: MovingMotion, contacts: list[ContactPeriod]) -> list[Note]:
    """How far the mechanism turns in any contact, and what the first would be off by if it did not; nothing of one
    that only slides."""
    angles = motion.centres[:, 2::3]
    ends = np.searchsorted(motion.time, [(contact.start, contact.end) for contact in contacts]).tolist()
    turned = np.array([np.abs(angles[first : last + 1] - angles[first]).max(axis=0) for first, last in ends])
    if turned.max() < LEAST_TURN:
        return []
    link = int(turned.max(axis=0).argmax())
    first, angle = contacts[0], float(turned[0].max())
    error = freezing_error(motion.scene, first.end - first.start, first.impulse, angle)
    values = {"link": motion.mechanism.links[link].name, "angle": math.degrees(turned.max()), "error": 100.0 * error}
    return [Note("configuration-followed", Severity.REMARK, **values)]


class _Followed(NamedTuple):
    """A motion, in how many steps, whether it was ended by too many impacts, or by joints that could not be closed."""

    motion: MovingMotion
    steps: int
    full: bool
    torn: bool


def _finer(scene: Scene) -> Scene:
    """The scene with more modes of the links of its mechanism; itself where none has any, or all that count."""
    mechanism = scene.target.known_as(Mechanism)
    most = max(min(max(2 * mechanism.most_modes, LEAST_MODES), MOST_MODES), mechanism.most_modes)
    return replace(scene, target=mechanism.with_own_modes(most), given={}) if mechanism.flexible else scene


def _drift(scene: Scene, motion: MovingMotion) -> float:
    """Of the energy, the largest, relative to that of the impactor at first; infinite where it is no number."""
    totals = sum(motion.energies(motion.time).values())
    worst = float(np.abs(totals - scene.initial_energy).max()) / scene.initial_energy
    return worst if math.isfinite(worst) else math.inf


def _notes_on_steps(motion: MovingMotion, drift: float, torn: bool) -> list[Note]:
    """Where joints or energy could not be kept."""
    if torn:
        return [Note("joints-open", Severity.INVALID, time=float(motion.time[-1]))]
    severity = Severity.INVALID if drift > GREAT_DRIFT else Severity.WARNING
    return [Note("energy-drifts", severity, share=100.0 * drift)] if drift > MOST_DRIFT else []


class _Moves(NamedTuple):
    """A mechanism as the integrator takes it: constraints, room, coordinates and rates before the impact, where the
    mass meets it (2,), what makes room for what is seen, and a motion of what is recorded."""

    linkage: Any
    rows: Rows
    room: Any
    coordinates: np.ndarray
    rates: np.ndarray
    struck: np.ndarray
    seen: Callable[[int, int], Any]
    motion: Callable[..., MovingMotion]


def _rigid(mechanism: Mechanism) -> _Moves:
    linkage, rows = rigid_linkage(mechanism)
    q, v = centres(mechanism), rates_of_centres(mechanism)
    room = moving.work(rows.joint.size, q.size)
    return _Moves(linkage, rows, room, q, v, mechanism.contact_point, moving.seen, RigidMotion)


def _flexible(mechanism: Mechanism) -> _Moves:
    linkage, rows = floating_linkage(mechanism)
    q, v, struck = bent_start(mechanism, linkage, rows)
    return _Moves(linkage, rows, room_of(linkage, rows), q, v, struck, variational.seen, FlexibleMotion)
