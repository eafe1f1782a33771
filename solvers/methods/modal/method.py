"""Modal superposition: any linear structure known by its lowest natural modes, any contact law."""

import math
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, Self

import numpy as np

from ... import validation
from ...bodies import AnyBody, Beam, Bending, Pivoted, Rod
from ...numerics.modal_steps import LEAST_STEPS, STEPS_PER_CONTACT
from ...numerics.modes import Modes
from ...provenance import clock
from ...scene import Scene
from ...solution.solution import Later, Solution, later
from ...solution.summary import summary, velocities
from ...text.notes import Note, Severity
from ..base import Method
from ..estimates import with_error
from ..options import option, whole, word
from ..parting import MAY_TOUCH_AGAIN, End, may_gain
from ..validity import STILL_TOUCHING, bodies_that_bend, cut_short, notes_on_front, notes_on_rigid_impact
from . import weight
from .estimate import MIN_STEPS_PER_CONTACT, MOST_MODES, STEPS_OF_FIRST_CONTACT, error_of_modes, steps_of_a_contact
from .frames import frame_figures, pivot_figures
from .march import MAX_STEPS, again, default_step, follow
from .motion import ModalMotion
from .pair import Pair

FRAMES = ("mean-axis", "attached", "attached-far")
MAX_SURE_CONTACTS = 6  # with a beam; of more, its conditioning is tested
MASS_CHANGES = (-1e-3, 1e-4)  # of the mass, by which the conditioning is tested: two, as one may be lucky
# Change of the velocity over that of the mass: more is out of proportion; see `tests/solvers/studies/test_ensemble.py`.
MAX_AMPLIFICATION = 10.0
CHATTER_PERIODS = 3.0  # shortest kept periods; chatter under a law seldom breaks off for longer
LISTED_MODES = 8  # of the target, whose frequencies the diagnostics have [Hz]


@dataclass(frozen=True)
class Modal(Method):
    """Two bodies by their lowest natural modes, rigid-body motion on top; a body without waves has none or all of them.
    Rods struck on their end, beams struck across.

    The modes left out act as a spring of their static compliance in series with the contact law; for rigid contact
    that spring is the whole law, so no stiffness is ever invented. Exact oscillators, energy-exact contact force.
    A free rod may be described in a frame on the mean of its sections, with the shapes of the free rod, or in one fixed
    to its struck or its far end, "attached" or "attached-far", with the shapes of a rod clamped there: thesis 10.2. The
    oscillators are then those of the coupled system; what the frame does is in the diagnostics. So may a beam on a pin,
    "attached" to its section there: thesis 10.3. A pendulum that bends has shapes of its own, and their number.
    Error: second order in the step; in the number of modes of a rod modes^-3 with a contact law, modes^-2 if its force
    jumps at first touch, 1/modes to modes^-1.5 if rigid; of a slender beam modes^-7, plastic laws with it down to 1e-8,
    where only the step counts; modes^-2.5 if the force jumps; none if rigid: a beam struck at one point gives way at
    once as far as its highest mode lets it, so that each contact lasts about the shortest kept period and there are
    ever more of them, whose sum scatters. Without the residual compliance 1/modes for any contact, but modes^-3 in the
    frame on the struck end.
    Source: thesis 5.2, 5.3, 8.4, 9.2 and 9.3; kernel: see `numerics.oscillators`.
    Differs: thesis 8.2 takes the stiffness of the neighbouring element and misses the second contact below 400 modes.
    """

    modes: int = option(50, whole(1, MOST_MODES))
    steps: int | None = option(None, whole(10, MAX_STEPS))  # over the whole duration
    # of a free rod or a beam on a pin: floating frame and the shapes that go with it
    frame: str = option("mean-axis", word(FRAMES))
    residual: bool = option(True, validation.flag)  # whether the modes left out give way
    estimate: bool = field(default=True, repr=False)  # the error, which costs as much again
    coarser: float = field(default=1.0, repr=False)  # times the usual step, where no steps are asked for
    flights: bool = field(default=False, repr=False)  # taken at once, of which nothing is known then

    NAME = "modal"
    BEAMS = DAMPED = WEIGHT = RIPPLES = True
    RESOLUTIONS = ("modes", "steps")

    def why_not(self, scene: Scene) -> Note | None:
        impactor, target = scene.impactor, scene.target
        for body in (target, impactor):
            if body.no_modes is not None:
                return body.no_modes
        if scene.rigid_contact and not (impactor.gives_way or target.gives_way):
            kinds = {"impactor": impactor.kind, "target": target.kind}
            return Note("refusals.nothing-gives-way", Severity.REFUSAL, **kinds)
        pinned = isinstance(target, Beam) and target.swings and self.frame == "attached"
        if self.frame != "mean-axis" and not (pinned or (isinstance(target, Rod) and target.support == "free")):
            got = target.support if isinstance(target, (Rod, Bending)) else target.kind
            return Note("refusals.frame-of-end", Severity.REFUSAL, frame=self.frame, target=got)
        if not self.residual and scene.rigid_contact:
            return Note("refusals.no-residual", Severity.REFUSAL)
        return None

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = clock()
        motion = self._march(scene, duration)
        wall_time = clock() - begun
        contacts = motion.contacts()
        rigid, deepest = scene.rigid_contact, float(motion.deepest[-1])
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=motion.duration,
            motion=motion,
            peak_force=max(contact.peak_force for contact in contacts),
            peak_indentation=None if rigid else deepest,
            residual_indentation=None if rigid else float(scene.contact.dent(deepest)),
            notes=Later(lambda _: self._notes(scene, motion, duration is not None, contacts)),  # pyright: ignore[reportArgumentType]
            **self._later_figures(scene, motion, contacts, wall_time),
        )

    def _later_figures(self, scene: Scene, motion: ModalMotion, contacts: list, wall_time: float) -> dict[str, Any]:
        """Figures worked out when they are read; the error, which takes other solves, with the diagnostics alone."""
        cheap = partial(velocities, scene, motion, contacts, motion.duration)
        found = later(partial(self._figures, scene, motion, contacts, wall_time), cheap)
        return with_error(found, lambda: self._error(scene, motion))

    def _error(self, scene: Scene, motion: ModalMotion) -> float | None:
        error = self._estimated_error(scene, motion) if self.estimate else None
        if error is None or motion.end is not End.MAY_TOUCH:
            return error
        return max(error, may_gain(scene, self._figures(scene, motion, motion.contacts(), 0.0), motion.end))

    def _figures(self, scene: Scene, motion: ModalMotion, contacts: list, wall_time: float) -> dict[str, Any]:
        found = summary(scene, motion, contacts, motion.duration, wall_time)
        found["diagnostics"] |= {
            "steps": motion.steps,
            "raw_contacts": len(motion.raw_contacts()[0]),
            "raw_peak_force": float(motion.record.contact_force.max()),
            "resolved_time": motion.pair.resolved_time,
            "frequencies": (motion.pair.target.frequencies[:LISTED_MODES] / (2.0 * math.pi)).tolist(),
        }
        if isinstance(scene.impactor, Pivoted) and scene.impactor.bends:
            found["diagnostics"] |= pivot_figures(motion)
        if self.frame != "mean-axis" and not scene.target.bends:
            found["diagnostics"] |= frame_figures(motion, contacts[-1].end, self.frame == "attached")
        if found["restitution"]["newton_at_contact"] is not None:
            apart = None if scene.rigid_contact else _parting_speed(motion, contacts[-1].end)
            found["restitution"]["newton_at_contact"] = apart
        return found

    def _notes(self, scene: Scene, motion: ModalMotion, asked: bool, contacts: list) -> list[Note]:
        raw = len(motion.raw_contacts()[0])
        notes = weight.notes(scene, motion.resting, motion.duration, float(motion.impactor_position(motion.duration)))
        # a given number of steps divides a time that is long enough
        if notes:
            pass
        elif not asked and self.steps is None and motion.end is End.FOLLOWED:
            notes.append(cut_short(motion.steps, "steps"))
        elif contacts[-1].end >= motion.duration * (1.0 - 1e-12):
            notes.append(STILL_TOUCHING)
        elif motion.end is End.MAY_TOUCH:
            notes.append(MAY_TOUCH_AGAIN)
        period = motion.pair.resolved_time
        notes += [note for body in bodies_that_bend(scene) for note in body.notes_on_modes(self.modes)]
        if scene.rigid_contact:
            notes += notes_on_rigid_impact(scene, period, self.modes, "modes")
        notes += notes_on_front(scene, period, self.modes, "modes")
        notes += self._ill_conditioned(scene, motion, contacts)
        steps = steps_of_a_contact(motion)
        if steps < MIN_STEPS_PER_CONTACT:
            fine = motion.step * steps / STEPS_PER_CONTACT
            notes.append(Note("few-steps-in-contact", Severity.WARNING, steps=steps, needed=fine))
        if raw > len(contacts):
            remedy, uncertain = _remedy_of_chatter(motion)
            notes.append(
                Note(
                    "modal-chatter",
                    Severity.WARNING,
                    separations=raw - len(contacts),
                    period=period,
                    remedy=remedy,
                    doubtful=uncertain,
                )
            )
        return notes

    def _miscounts(self) -> str:
        return "modes"

    def _ill_conditioned(self, scene: Scene, motion: ModalMotion, contacts: list) -> list[Note]:
        """Of many contacts with a beam, by impacts of a mass that is changed a little."""
        if not (self.estimate and bodies_that_bend(scene)) or len(contacts) <= MAX_SURE_CONTACTS:
            return []
        if not scene.impactor.free_mass:
            return []
        final, record, moved = motion.record.velocity[-1], None, {}
        for change in MASS_CHANGES:
            other = scene.with_impactor_mass(scene.impactor.mass * (1.0 + change))
            record = again(motion, other, record)[1]
            moved[change] = abs(float(record.velocity[-1]) - final) / scene.speed
        change = max(moved, key=lambda change: moved[change] / abs(change))
        if moved[change] <= MAX_AMPLIFICATION * abs(change):
            return []
        percent, far = 100.0 * abs(change), 100.0 * moved[change]
        return [
            Note(
                "ill-conditioned-mass",
                Severity.WARNING,
                change=percent,
                more=change > 0.0,
                moved=far,
                contacts=len(contacts),
            )
        ]

    def pair(self, scene: Scene) -> Pair:
        """The modes that take part in this impact."""
        bodies = (scene.impactor, scene.target)
        impactor, target = (body.modes(self.modes).excited() for body in bodies)
        if self.frame != "mean-axis":
            target = self._attached(scene.target)
        if not self.residual:
            nothing: dict = {
                "residual_compliance": 0.0,
                "static_shapes": None,
                "static_slopes": None,
                "static_moments": None,
                "static_shears": None,
            }
            impactor, target = replace(impactor, **nothing), replace(target, **nothing)
        truncated = (scene.impactor.time_unit is not None, scene.target.time_unit is not None)
        return Pair(impactor, target, truncated, (scene.impactor.damping, scene.target.damping))

    def _attached(self, body: AnyBody) -> Modes:
        if isinstance(body, Beam):
            return body.attached_modes(self.modes)
        return body.known_as(Rod).attached_modes(self.modes, self.frame == "attached")

    def _estimated_error(self, scene: Scene, motion: ModalMotion) -> float | None:
        """Of the final velocity, relative to the impact speed: against other numbers of modes, in half the steps or so
        many that they resolve them.

        None where the target says itself how many modes it has and nothing but they gives way.
        """
        if scene.target.own_modes and scene.rigid_contact:
            return None

        def solved(modes: int, target: AnyBody) -> float:
            steps = max(10, math.ceil(0.5 * motion.steps * max(1.0, modes / self.modes / 2.0)))
            other = replace(scene, impactor=scene.impactor.with_share_of_modes(modes / self.modes), target=target)
            return replace(self, modes=modes, steps=steps)._march(other, motion.duration).parting_velocity

        def begun(modes: int, until: float) -> float:
            return replace(self, modes=modes, steps=STEPS_OF_FIRST_CONTACT)._march(scene, until).final_velocity

        return error_of_modes(motion, self.modes, solved, begun)

    def for_figures(self, fields: bool, estimate: bool) -> Self:
        return replace(super().for_figures(fields, estimate), flights=not (fields or estimate))

    def _march(self, scene: Scene, duration: float | None) -> ModalMotion:
        pair = self.pair(scene)
        count = self.steps
        if count is not None:
            if duration is None:
                duration = replace(self, steps=None)._march(scene, None).duration
            step = duration / count
        else:
            step = self.coarser * default_step(scene, pair)
        if duration is not None and count is None:
            count = min(max(LEAST_STEPS, math.ceil(duration / step)), MAX_STEPS)
            step = duration / count
        flights = self.flights and self.frame == FRAMES[0] and not (scene.rigid_contact or scene.impactor.turns)
        return follow(scene, pair, step, count, flights)


def _remedy_of_chatter(motion: ModalMotion) -> tuple[str, int]:
    """What to do about it, an option of the note, and how many of its gaps may be real."""
    if motion.scene.rigid_contact:
        return "law", 0
    uncertain = motion.uncertain_gaps(CHATTER_PERIODS)
    return "gaps" if uncertain else "modes", uncertain


def _parting_speed(motion: ModalMotion, parting: float) -> float:
    """Of the touching faces, relative to that of approach."""
    parted = np.array([parting])
    return float(motion.end_velocity(parted)[0] - motion.impactor_end_velocity(parted)[0]) / motion.scene.speed
