"""Modal superposition: any linear structure known by its lowest natural modes, any contact law."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from .. import checks
from ..contact import Rigid
from ..doubts import STILL_TOUCHING, bodies_that_bend, cut_short, doubts_of_a_front, doubts_of_a_rigid_blow
from ..machine import clock
from ..method import AFTERGLOW, MAX_ROUND_TRIPS, Method
from ..numerics.modes import Modes
from ..numerics.oscillators import Record, Residual, march
from ..scene import Scene
from ..solution import Later, Solution, later, summary
from .modal_motion import ModalMotion, Pair

STEPS_PER_PERIOD = 20  # of the highest kept mode
STEPS_PER_CONTACT = 200  # of the shortest contact there can be
EXPECTED_STEPS = 60_000  # more are not chosen unasked: energy is kept at any step
FINER = 8  # times as many on a beam, where the contact may be over long before the beam has swung once
MAX_STEPS = 4_000_000
FRAMES = ("mean-axis", "attached", "attached-far")
COUNTS = 0.2  # least share of the largest impulse that a contact must have to count
FEW_CONTACTS = 6  # with a beam: so many are well determined
CHANGES = (-1e-3, 1e-4)  # of the mass, by which the conditioning is tried
AMPLIFIED = 10.0  # times what is no longer in proportion to the change, as in an ensemble
LONG_GAP = 3.0  # shortest kept periods, longer than which chatter under a law seldom breaks off
FEW_STEPS = 20.0  # in a contact: with fewer neither its peak nor what it loses is told
REPEATED_STRIDE = 1_000  # steps between checkpoints of blows that are repeated for their figures, not their fields
CHECKPOINT_NUMBERS = 1_000_000  # doubles kept of each kind, from which fields at any time are rebuilt


@dataclass(frozen=True)
class Modal(Method):
    """Two bodies by their lowest natural modes, rigid-body motion on top; a body without waves has none or all of them.
    Rods struck on their end, beams struck across.

    The modes left out act as a spring of their static compliance in series with the contact law; for rigid contact
    that spring is the whole law, so no stiffness is ever invented. Exact oscillators, energy-exact contact force.
    A free rod may be described in a frame on the mean of its sections, with the shapes of the free rod, or in one fixed
    to its struck or its far end, "attached" or "attached-far", with the shapes of a rod clamped there: thesis 10.2. The
    oscillators are then those of the coupled system; what the frame does is in the diagnostics.
    Error: second order in the step; in the number of modes of a rod modes^-3 with a contact law, modes^-2 if its force
    jumps at first touch, 1/modes to modes^-1.5 if rigid; of a slender beam modes^-7, plastic laws with it down to 1e-8,
    where only the step counts; modes^-2.5 if the force jumps; none if rigid: a beam struck at one point gives way at
    once as far as its highest mode lets it, so that each contact lasts about the shortest kept period and there are
    ever more of them, whose sum scatters. Without the residual compliance 1/modes for any contact, but modes^-3 in the
    frame on the struck end.
    Source: thesis 5.2, 5.3, 8.4, 9.2 and 9.3; kernel: see `numerics.oscillators`.
    Differs: thesis 8.2 takes the stiffness of the neighbouring element and misses the second contact below 400 modes.
    """

    modes: int = 50
    steps: int | None = None  # over the whole duration
    frame: str = "mean-axis"  # of a free rod: floating frame and the shapes that go with it
    residual: bool = True  # whether the modes left out give way
    estimate: bool = field(default=True, repr=False)  # the error, which costs as much again

    NAME = "modal"
    BEAMS = DAMPED = True
    KNOBS = ("modes", "steps")

    @classmethod
    def read(cls, given: Mapping[str, object]) -> "Modal":
        given = checks.table("method", given, ("modes", "steps", "frame", "residual"))
        steps, residual = given.get("steps"), given.get("residual", True)
        if not isinstance(residual, bool):
            raise checks.SceneError("method.residual", residual, "true or false")
        return cls(
            checks.whole_number("method.modes", given.get("modes", 50), 1, 10_000),
            None if steps is None else checks.whole_number("method.steps", steps, 10, MAX_STEPS),
            checks.choice("method.frame", given.get("frame", "mean-axis"), FRAMES),
            residual,
        )

    def why_not(self, scene: Scene) -> str | None:
        impactor, target = scene.impactor, scene.target
        if target.kind == "rods":
            return "the target must be one body, got a chain of rods; use 'waves'"
        rods = [body for body in (impactor, target) if body.kind == "rod"]
        if any(rod.end_mass or rod.support == "anechoic" for rod in rods):
            return "a rod must end fixed or free, with no mass on its far end; use 'waves'"
        if isinstance(scene.contact, Rigid) and not (impactor.time_unit or target.time_unit):
            got = f"{impactor.kind} and {target.kind}"
            return f"rigid contact needs a body that waves run in, which gives way, got {got}; use 'rigid'"
        if self.frame != "mean-axis" and (target.kind != "rod" or target.support != "free"):
            got = getattr(target, "support", target.kind)
            return f"a frame fixed to an end ('{self.frame}') floats with a free rod, got {got}"
        if not self.residual and isinstance(scene.contact, Rigid):
            return (
                "rigid contact needs the residual compliance, which is all that gives way; leave out residual = false"
            )
        return None

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = clock()
        motion = self._march(scene, duration)
        wall_time = clock() - begun
        contacts = motion.contacts()
        rigid, deepest = isinstance(scene.contact, Rigid), float(motion.deepest[-1])
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=motion.duration,
            motion=motion,
            peak_force=max(contact.peak_force for contact in contacts),
            peak_indentation=None if rigid else deepest,
            residual_indentation=None if rigid else float(scene.contact.dent(deepest)),
            notes=Later(lambda _: self._notes(scene, motion, duration is not None, contacts)),
            **later(lambda: self._figures(scene, motion, contacts, wall_time)),
        )

    def _figures(self, scene: Scene, motion: ModalMotion, contacts: list, wall_time: float) -> dict[str, Any]:
        found = summary(scene, motion, contacts, motion.duration, wall_time)
        found["diagnostics"] |= {
            "steps": motion.steps,
            "estimated_error": self._estimated_error(scene, motion) if self.estimate else None,
            "raw_contacts": len(motion.raw_contacts()[0]),
            "raw_peak_force": float(motion.record.contact_force.max()),
            "resolved_time": motion.pair.resolved_time,
        }
        if self.frame != "mean-axis":
            found["diagnostics"] |= motion.frame_figures(contacts[-1].end, self.frame == "attached")
        if found["restitution"]["newton_at_contact"] is not None:
            rigid, parting = isinstance(scene.contact, Rigid), contacts[-1].end
            found["restitution"]["newton_at_contact"] = None if rigid else _parting_speed(motion, parting)
        return found

    def _notes(self, scene: Scene, motion: ModalMotion, asked: bool, contacts: list) -> list[str]:
        notes, raw = [], len(motion.raw_contacts()[0])
        if not asked and self.steps is None and not motion.parted:  # a given number divides a time that is long enough
            notes.append(cut_short(f"{motion.steps} steps"))
        elif contacts[-1].end >= motion.duration * (1.0 - 1e-12):
            notes.append(STILL_TOUCHING)
        period = motion.pair.resolved_time
        notes += [doubt for body in bodies_that_bend(scene) for doubt in body.doubts_of_modes(self.modes)]
        if isinstance(scene.contact, Rigid):
            notes += doubts_of_a_rigid_blow(scene, period, self.modes, "modes")
        notes += doubts_of_a_front(scene, period, self.modes, "modes")
        notes += self._ill_conditioned(scene, motion, contacts)
        steps = _steps_of_a_contact(motion)
        if steps < FEW_STEPS:
            fine = motion.step * steps / STEPS_PER_CONTACT
            notes.append(
                f"A contact lasts {steps:.2g} steps, too few for its peak force and what it loses: ask for so many "
                f"steps that each lasts {fine:.2g} s, over a shorter duration if they are too many."
            )
        if raw > len(contacts):
            notes.append(
                f"The raw force breaks off {raw - len(contacts)} times more often than the bodies part: chatter at the"
                f" shortest kept period ({period:.3g} s), as the modes left out cannot carry the front of the wave. "
                + _remedy_of_chatter(motion)
            )
        return notes

    def _recount(self) -> str:
        return "So few modes do not tell slight gaps and contacts: keep more, or use 'waves'."

    def _ill_conditioned(self, scene: Scene, motion: ModalMotion, contacts: list) -> list[str]:
        """Of many contacts with a beam, by blows of a mass that is changed a little."""
        if not (self.estimate and bodies_that_bend(scene)) or len(contacts) <= FEW_CONTACTS:
            return []
        if scene.impactor.kind not in ("mass", "sphere"):
            return []
        final, record, moved = motion.record.velocity[-1], None, {}
        for change in CHANGES:
            other = scene.replace({"impactor.mass": scene.impactor.mass * (1.0 + change)})
            record = again(motion, other, record)[1]
            moved[change] = abs(float(record.velocity[-1]) - final) / scene.speed
        change = max(moved, key=lambda change: moved[change] / abs(change))
        if moved[change] <= AMPLIFIED * abs(change):
            return []
        return [
            f"Ill-conditioned: with {100.0 * abs(change):g} % {'more' if change > 0.0 else 'less'} mass the final "
            f"velocity moves by {100.0 * moved[change]:.2g} % of the speed of approach, as each of {len(contacts)} "
            "contacts starts from how the one before left the beam. Trust the band of an ensemble, not one curve; a "
            "softer contact, such as 'hertz' or 'plastic-power' from radius and materials, makes fewer contacts."
        ]

    def pair(self, scene: Scene) -> Pair:
        """The modes that take part in this blow."""
        bodies = (scene.impactor, scene.target)
        pair = [body.modes(self.modes).felt() for body in bodies]
        if self.frame != "mean-axis":
            pair[1] = scene.target.attached_modes(self.modes, self.frame == "attached")
        if not self.residual:
            nothing: dict = {
                "residual_compliance": 0.0,
                "static_shapes": None,
                "static_moments": None,
                "static_shears": None,
            }
            pair = [replace(modes, **nothing) for modes in pair]
        truncated = tuple(body.time_unit is not None for body in bodies)
        return Pair(*pair, truncated, tuple(getattr(body, "damping", 0.0) for body in bodies))

    def _estimated_error(self, scene: Scene, motion: ModalMotion) -> float:
        """Of the final velocity, relative to the impact speed: against other numbers of modes and half the steps.

        Against two of them, as one coarse answer may agree with the fine one by chance.
        """
        others = {self.modes // 2, 2 * self.modes // 3} if self.modes > 4 else {2 * self.modes, 3 * self.modes}
        if not any(motion.pair.truncated):
            others = {self.modes}
        final = motion.record.velocity[-1]
        differences = []
        for modes in others:
            other = replace(self, modes=modes, steps=max(10, motion.steps // 2))._march(scene, motion.duration)
            differences.append(abs(final - other.record.velocity[-1]))
        estimated = float(max(differences) / scene.speed)
        # shorter than any mode kept: all numbers of modes are wrong alike
        steps = _steps_of_a_contact(motion)
        if steps < FEW_STEPS:  # so coarse that half the steps may be as wrong; second order
            estimated = max(estimated, 2.0 * steps**-2.0)
        blow = scene.blow if bodies_that_bend(scene) and isinstance(scene.contact, Rigid) else _blow(scene)
        return max(estimated, 1.0) if blow < motion.pair.resolved_time else estimated

    def _march(self, scene: Scene, duration: float | None) -> ModalMotion:
        pair = self.pair(scene)
        if duration is None and self.steps is not None:
            duration = replace(self, steps=None)._march(scene, None).duration
        step = duration / self.steps if self.steps is not None else default_step(scene, pair)
        count = self.steps
        if duration is not None and count is None:
            count = min(max(10, math.ceil(duration / step)), MAX_STEPS)
            step = duration / count
        return _follow(scene, pair, step, count)


def _blow(scene: Scene) -> float:
    """Time in which the force of a rigid blow between a mass and a rod fades, m / Z [s]; infinite for other blows."""
    rods = [body for body in (scene.impactor, scene.target) if body.time_unit is not None]
    if len(rods) != 1 or rods[0].kind != "rod" or not isinstance(scene.contact, Rigid):
        return math.inf
    mass = scene.target.mass if rods[0] is scene.impactor else scene.impactor.mass
    return mass / rods[0].impedance


def _remedy_of_chatter(motion: ModalMotion) -> str:
    """What to do about it, and whether some of it may be none."""
    if isinstance(motion.scene.contact, Rigid):
        return "Read the averaged force; a contact law soft enough for these modes ends it, and 'waves' has none."
    doubtful = motion.doubtful_gaps(LONG_GAP)
    if doubtful:
        return f"{doubtful} of these gaps may be real, and too slight for these modes: keep more, or use 'waves'."
    return "Read the averaged force; more modes make it less, and 'waves' has none."


def _steps_of_a_contact(motion: ModalMotion) -> float:
    """How many steps the shortest contact has that counts, by a law of its own; infinite where the contact is rigid."""
    if isinstance(motion.scene.contact, Rigid):
        return math.inf
    contacts = motion.contacts()
    least = COUNTS * max(contact.impulse for contact in contacts)
    return min(contact.end - contact.start for contact in contacts if contact.impulse >= least) / motion.step


def _parting_speed(motion: ModalMotion, parting: float) -> float:
    """Of the touching faces, relative to that of approach."""
    parted = np.array([parting])
    return float(motion.end_velocity(parted)[0] - motion.impactor_end_velocity(parted)[0]) / motion.scene.speed


def _mobility(modes: Modes, truncated: bool) -> float:
    """Rate that the struck face gains at once by a unit impulse [1/kg], as far as it moves with the whole body."""
    return 1.0 / modes.rigid_mass + (0.0 if truncated else float(np.sum(modes.at_contact**2)))


def default_step(scene: Scene, pair: Pair) -> float:
    """Fine enough for the highest mode and for the shortest contact; never a longer run than is worth it."""
    law, residual = pair.law(scene)
    parts = list(zip((pair.impactor, pair.target), pair.truncated, strict=True))
    reduced = 1.0 / sum(_mobility(modes, truncated) for modes, truncated in parts)
    depth = scene.speed * scene.time_unit  # the law's secant stiffness at the depth of a free collision
    for _ in range(60):
        stiffness = 2.0 * law.mean(0.0, depth, 0.0, 0.0)[0] / depth
        depth = 0.5 * (depth + scene.speed * math.sqrt(reduced / stiffness))
    soft = 1.0 / stiffness
    bodies = (scene.impactor, scene.target)
    trips = sum(body.time_unit for body in bodies if body.time_unit is not None)
    give = sum(1.0 / body.stiffness for body in bodies if hasattr(body, "stiffness"))
    give += sum(
        float(np.sum((modes.at_contact / modes.frequencies) ** 2))
        for modes, body in zip((pair.impactor, pair.target), bodies, strict=True)
        if body.kind == "beam"
    )
    fine = math.pi * math.sqrt(reduced * (soft + residual)) / STEPS_PER_CONTACT
    if pair.frequencies.size:
        fine = min(fine, 2.0 * math.pi / float(pair.frequencies.max()) / STEPS_PER_PERIOD)
    usual = (trips + math.pi * math.sqrt(scene.reduced_mass * (soft + give))) / EXPECTED_STEPS
    if any(body.kind == "beam" for body in bodies):  # few modes, many contacts, each of which starts and ends in a step
        return max(min(fine, usual), usual / FINER)
    return max(fine, usual)


def _follow(scene: Scene, pair: Pair, step: float, count: int | None) -> ModalMotion:
    """March `count` steps, or whole periods of the bodies until one has passed without a touch and none can come."""
    law, spring = _contact(scene, pair, step)
    slowest = [2.0 * math.pi / modes.frequencies[0] for modes in (pair.impactor, pair.target) if modes.frequencies.size]
    period, size = max(slowest, default=scene.time_unit), pair.frequencies.size
    bank = pair.bank(step)
    stride = max(1, (count or 3 * math.ceil(period / step)) * size // CHECKPOINT_NUMBERS)
    most = count or int(min(MAX_STEPS, math.ceil(MAX_ROUND_TRIPS * scene.time_unit / step)))
    chunk = count or min(most, math.ceil(period / step))
    record = _record(chunk, stride, size)
    record.velocity[0], record.rigid_velocity[0] = scene.impactor.velocity, scene.target.velocity
    displacement, velocity = np.zeros(size), np.zeros(size)
    done, parted = 0, False
    while done < most:
        until = min(done + chunk, most)
        if until > record.contact_force.size:
            record = _grown(record, min(2 * until, most), stride)
        march(
            law, spring, pair.impactor.rigid_mass, pair.target.rigid_mass, step, bank,
            displacement, velocity, stride, done, until, record,
        )  # fmt: skip
        apart = not record.contact_force[done:until].any()
        done = until
        if count is None and apart and record.rigid_velocity[done] > record.velocity[done]:
            # two bodies that ring may meet again when both bulge out at once, until they are too far apart for that
            bulge = np.hypot(displacement, velocity).sum() + spring.compliance * abs(record.spring_force[done])
            if len(slowest) == 2 and record.rigid_position[done] - record.position[done] < bulge:
                continue
            parted = True
            last = int(np.flatnonzero(record.contact_force[:done])[-1]) + 1
            done = min(done, last + math.ceil(AFTERGLOW * scene.time_unit / step))
            break
    return ModalMotion(scene, pair, step, stride, _cut(record, done, stride), parted)


def _contact(scene: Scene, pair: Pair, step: float) -> tuple[Any, Residual]:
    law, residual = pair.law(scene)
    settling = min(0.5, step / pair.resolved_time) if residual and (law.JUMPS or law.PLASTIC) else 0.0
    return law, Residual(residual, settling, law.JUMPS)


def again(motion: ModalMotion, scene: Scene, record: Record | None = None) -> tuple[ModalMotion, Record]:
    """Another blow of a rigid impactor on the same target over the same steps, and the record it was written into.

    For many blows in a row that differ by the impactor or the contact law alone: nothing is worked out twice, and a
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
        law, spring, pair.impactor.rigid_mass, pair.target.rigid_mass, step, pair.bank(step), displacement, velocity,
        stride, 0, motion.steps, record,
    )  # fmt: skip
    return ModalMotion(scene, pair, step, stride, record, False), record


def _record(steps: int, stride: int, modes: int) -> Record:
    instants = [np.zeros(steps + 1) for _ in range(7)]
    return Record(np.zeros(steps), *instants, *(np.zeros((steps // stride + 1, modes)) for _ in range(2)))


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
