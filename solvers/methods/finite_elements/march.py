"""What the methods of finite elements share: the options, the local stiffness, the march until the bodies part."""

import math
from abc import abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, Self

import numpy as np

from ... import validation
from ...contact import Linear
from ...contact.duration import contact_time
from ...provenance import clock
from ...scene import Scene
from ...solution.solution import Later, Solution
from ...solution.summary import summary
from ...text.notes import Note, Severity
from ..base import AFTERGLOW, MAX_ROUND_TRIPS, Method
from ..estimates import error_left, with_error
from ..options import option, real, whole
from ..parting import MAY_TOUCH_AGAIN, End, may_gain, moves_alike, patience
from ..validity import (
    STILL_TOUCHING,
    bodies_that_bend,
    cut_short,
    missed_dashpot,
    notes_on_front,
    notes_on_rigid_impact,
)
from ..weight import PARTS, comes_to_rest, flights, is_at_rest, moved
from .motion import Course, ElementMotion

# Of the shortest contact there can be. With fewer the peak force is off by more than the mesh is; orders:
# `tests/solvers/methods/test_orders.py`.
STEPS_PER_CONTACT = 100
# Of the largest stable step of central differences. Nearer to it a contact that opens and closes feeds the mesh.
EXPLICIT_LIMIT_SHARE = 0.8
# Unless more are asked for. Fewer, and long impacts are solved more coarsely, at which the energy is kept all the same.
MAX_USUAL_STEPS = 60_000
MAX_STEPS = 4_000_000  # of any solve; it is ended there, which is said
MOST_CHUNKS = 800  # of what stays within reach under its weight
SNAPSHOTS = 1000  # of all nodes, over the time expected
MOST_NUMBERS = 10_000_000  # doubles kept of nodes
SETTLED_ERROR = 1e-3  # estimated; with less, many contacts by a law are well determined all the same
# Of an estimate: other meshes, as shares of the elements. Against much finer ones the difference is the error; of more
# elements they are as fine as is bearable, and of many, or in beams, coarser: more of them if the contact is rigid, as
# its rebound scatters.
MUCH_FINER, FINER, COARSER, COARSER_RIGID = (4.0, 6.0), (3 / 2, 2.0), (1 / 2, 1 / 3), (1 / 2, 2 / 5, 1 / 3, 1 / 4)
FEW_ELEMENTS, MANY_ELEMENTS = 30, 100
MAX_SURE_CONTACTS = 6  # of a stiff contact with a beam; of more, the later ones hang on rounding, which is said
ELEMENTS_RANGE = (1, 2000)


@dataclass(frozen=True, kw_only=True)
class FiniteElements(Method):
    """What both methods share: the mesh, the local stiffness of a rigid contact, the march until the bodies part."""

    elements: int = option(100, whole(*ELEMENTS_RANGE))
    steps: int | None = option(None, whole(10, MAX_STEPS))  # over the whole duration
    contact_stiffness: float = option(1.0, real(1e-6, 1e8, "stiffnesses of an element"))  # of a rigid contact
    estimate: bool = field(default=True, repr=False)

    BEAMS = WEIGHT = RIPPLES = True

    def why_not(self, scene: Scene) -> Note | None:
        bodies = (scene.impactor, scene.target)
        for body in bodies:
            if body.endless:
                return Note("refusals.no-end", Severity.REFUSAL)
            if not body.bonded:
                return Note("refusals.loose-chain", Severity.REFUSAL)
            if not body.has_mesh:
                return Note("refusals.no-mesh", Severity.REFUSAL, body=body.kind)
        if all(body.time_unit is None for body in bodies):
            return Note("refusals.nothing-divided", Severity.REFUSAL)
        return None

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = clock()
        course = self._course(scene, duration)
        motion = ElementMotion(scene, course)
        contacts = motion.contacts()
        wall_time = clock() - begun
        found = summary(scene, motion, contacts, course.duration, wall_time)
        found["diagnostics"] |= {
            "steps": course.steps,
            "momentum_error": motion.momentum_error(),
            "raw_contacts": motion.raw_contacts()[0].size,
            "raw_peak_force": float(course.force.max()),
            "resolved_time": course.resolved_time,
        }
        rigid = scene.rigid_contact
        depth = None if rigid else float(max(course.indentation.max(), 0.0))
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=course.duration,
            motion=motion,
            peak_force=max(contact.peak_force for contact in contacts),
            peak_indentation=depth,
            residual_indentation=None if depth is None else float(scene.contact.dent(depth)),
            notes=Later(lambda solved: self._all_notes(solved, motion, duration)),  # pyright: ignore[reportArgumentType]
            **with_error(found, lambda: self._error(scene, course, found)),
        )

    def _error(self, scene: Scene, course: Course, found: Mapping[str, Any]) -> float | None:
        if not self.estimate or course.diverged:
            return None
        return max(self._estimated_error(scene, course), may_gain(scene, found, course.end))

    def _all_notes(self, solved: Solution, motion: ElementMotion, duration: float | None) -> list[Note]:
        found = solved.diagnostics
        notes = self._notes(solved.scene, motion, duration, len(solved.contacts), found["estimated_error"])
        return notes + self._energy_notes(found)

    def _energy_notes(self, diagnostics: Mapping[str, Any]) -> list[Note]:
        """What the figures themselves say."""
        return []

    def _notes(
        self, scene: Scene, motion: ElementMotion, duration: float | None, contacts: int, error: float | None
    ) -> list[Note]:
        course, notes = motion.course, []
        if scene.rigid_contact and self._needs_stiffness(scene):
            both = scene.impactor.time_unit is not None and scene.target.time_unit is not None
            factor, stiffness = self.contact_stiffness, self._stiffness(scene)
            notes.append(Note("mesh-stiffness", Severity.REMARK, factor=factor, both=both, stiffness=stiffness))
        if course.diverged:
            notes.append(Note("diverged", Severity.INVALID))
        elif scene.weight_acceleration and is_at_rest(scene, motion.impactor_velocity(motion.time), course.force[-1]):
            notes.append(comes_to_rest(scene, course.duration, float(course.position[-1])))
        elif duration is None and self.steps is None and course.end is End.FOLLOWED:
            notes.append(cut_short(course.steps, "steps"))
        elif course.force[-1] > 0.0:
            notes.append(STILL_TOUCHING)
        elif course.end is End.MAY_TOUCH:
            notes.append(MAY_TOUCH_AGAIN)
        raw, beam = motion.raw_contacts()[0].size, scene.bends
        if raw > contacts and not course.diverged:
            remedy = "law" if beam else self._calmer(scene)
            notes.append(Note("mesh-chatter", Severity.WARNING, touches=raw, contacts=contacts, remedy=remedy))
        if scene.rigid_contact:
            notes += notes_on_rigid_impact(scene, self._known_down_to(scene, course), self.elements, "elements")
        notes += notes_on_front(scene, course.shortest_period, self.elements, "elements")
        rough = scene.rigid_contact or (error is not None and error > SETTLED_ERROR)
        if beam and rough and contacts > MAX_SURE_CONTACTS:
            notes.append(Note("ill-conditioned-mesh", Severity.WARNING, contacts=contacts))
        return notes

    def _estimated_error(self, scene: Scene, course: Course) -> float:
        """Of the final velocity, relative to the impact speed: against other numbers of elements, with steps to match.

        The factors are such that random impacts keep to it: `tests/random_estimates.py`.
        """
        rigid, scale = scene.rigid_contact, scene.impactor.mass * scene.speed

        def difference(method: FiniteElements, scene: Scene = scene) -> float:
            return (float(course.impulse[-1]) - method._last_impulse(scene, course.duration)) / scale

        estimated = self._left_by_mesh(scene, difference)
        cut = scene.target.with_single_elements_cut(self.elements)
        if cut is not scene.target:  # which no coarser mesh can show
            again = difference(replace(self, steps=None), replace(scene, target=cut))
            estimated = max(estimated, 2.0 * abs(again))
        known = self._known_down_to(scene, course)
        if rigid and scene.halting_time < known:
            return max(estimated, 1.0)  # shorter than the mesh resolves: all meshes are wrong alike
        if rigid or bodies_that_bend(scene):
            return estimated
        return max(
            estimated, missed_dashpot(scene, contact_time(scene.contact, scene.reduced_mass, scene.speed), known)
        )

    def _left_by_mesh(self, scene: Scene, difference: Callable[["FiniteElements"], float]) -> float:
        """The error by other meshes; `difference`: of the final velocity to that of another, of the impact speed."""
        others = [self._with_share(scene, share) for share in self._shares(scene)]
        order, factor = self._order_and_factor(scene)
        return factor * error_left([(self._share(other), difference(other)) for other in others], order)

    def _shares(self, scene: Scene) -> tuple[float, ...]:
        """Other meshes, as shares of the elements."""
        if self.elements <= FEW_ELEMENTS:
            return FINER if scene.bends else MUCH_FINER
        if self.elements <= MANY_ELEMENTS and not scene.bends:
            return FINER
        return COARSER_RIGID if scene.rigid_contact else COARSER

    def _order_and_factor(self, scene: Scene) -> tuple[float, float]:
        """The order of the error in the elements, about or somewhat less, and a factor on what differences leave by it:
        random impacts keep to it so. What runs through several rods scatters, as no two meshes share them out alike.
        """
        alone, shares = len(scene.impactor.rods) + len(scene.target.rods) == 1, self._shares(scene)
        if scene.rigid_contact:
            return self._of_rigid_contact(scene, alone)
        if scene.bends:
            return 2.0, 1.25
        jumps = scene.contact.JUMPS
        if shares is MUCH_FINER:
            return (4 / 3 if jumps else 2.0), 1.5
        if shares is FINER:
            return (4 / 3, 2.0 if alone else 2.5) if jumps else (2.0, 1.5 if alone else 2.0)
        return 4 / 3 if jumps else 3 / 2, 1.0 if alone else 2.5

    def _of_rigid_contact(self, scene: Scene, alone: bool) -> tuple[float, float]:
        """Order and factor, see `_order_and_factor`."""
        shares = self._shares(scene)
        if shares is MUCH_FINER:
            return 1.0, 2.0
        if shares is FINER:
            return 1.0, 3.0
        return 1.0 if scene.target.fixed else 2 / 3, 2.8 if alone else 4.2

    def _share(self, other: Self) -> float:
        """Of the resolution that another has."""
        return other.elements / self.elements

    def _known_down_to(self, scene: Scene, course: Course) -> float:
        """The shortest period of the mesh at the contact [s], or half a swing of what strikes a beam on the local
        stiffness.
        """
        if not bodies_that_bend(scene):
            bodies = (scene.impactor, scene.target)
            return max(course.shortest_period, *(body.mesh(self.elements).struck_period for body in bodies))
        if not self._needs_stiffness(scene):
            return course.shortest_period
        return max(course.shortest_period, contact_time(self._law(scene), scene.reduced_mass, scene.speed))

    def _with_share(self, scene: Scene, share: float) -> Self:
        """Itself with a share of the elements."""
        return replace(self, elements=max(1, round(share * self.elements)), steps=None)

    def _stiffness(self, scene: Scene) -> float:
        """Local stiffness of a rigid contact [N/m]: of the elements next to it, in series if both bodies have one.

        So it does not matter who strikes.
        """
        neighbours = [body.mesh(self.elements).neighbour for body in (scene.impactor, scene.target)]
        return self.contact_stiffness / sum(1.0 / stiffness for stiffness in neighbours if stiffness)

    def _law(self, scene: Scene) -> Any:
        return Linear(self._stiffness(scene)) if scene.rigid_contact else scene.contact

    def _calmer(self, scene: Scene) -> str:
        """What avoids chatter in rods, an option of the note."""
        if scene.rigid_contact:
            return "massless"
        return "elements"

    def _resolution(self, scene: Scene) -> str | None:
        return None if bodies_that_bend(scene) else super()._resolution(scene)

    def _miscounts(self) -> str:
        return "mesh"

    def _needs_stiffness(self, scene: Scene) -> bool:
        """Whether a rigid contact needs a local stiffness."""
        return True

    @abstractmethod
    def _course(self, scene: Scene, duration: float | None) -> Course: ...

    @abstractmethod
    def _last_impulse(self, scene: Scene, duration: float) -> float:
        """That has been given by then [N s], without histories and fields."""


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

    masses [kg]: what an impact feels of impactor and target as wholes, infinite of what is held; make(steps): an empty
    record; advance(begin, end, record): the instant reached; impulse(record, instant) [N s]; room(record, instant):
    by how much further the bodies as wholes are apart than their faces reach [m]; pushes(record, instant): impulses of
    all steps before (steps,) [N s].
    """

    masses: tuple[float, float]
    make: Callable[[int], Any]
    advance: Callable[[int, int, Any], int]
    impulse: Callable[[Any, int], float]
    room: Callable[[Any, int], float]
    pushes: Callable[[Any, int], np.ndarray]


def follow(scene: Scene, plan: Plan, march: March) -> tuple[Any, int, End]:
    """March by chunks until the bodies have parted for good, see `methods.parting`: record, steps, and how it ended."""
    record, done, touched = march.make(plan.chunk), 0, 0
    alike, longest = moves_alike(scene), patience(scene)
    while done < plan.most:
        until = min(done + plan.chunk, plan.most)
        if until > record.contact_force.size - 1:
            record = _grown(record, march.make(max(until, min(2 * until, plan.most))))
        before, reached = march.impulse(record, done), march.advance(done, until, record)
        if reached < until:
            return record, reached, End.FOLLOWED
        done, gained = until, march.impulse(record, until)
        if plan.count is None and scene.weight_acceleration:
            how = _under_weight(scene, plan, march, record, done)
            if how is not None:
                return record, done, how
        elif gained != before:
            touched = done
        elif plan.count is None and _apart(scene, march.masses, gained):
            if alike or march.room(record, done) > 0.0:
                return record, done, End.PARTED
            if (done - touched) * plan.step >= longest:
                return record, done, End.MAY_TOUCH
    return record, done, End.FOLLOWED


def _under_weight(scene: Scene, plan: Plan, march: March, record: Any, done: int) -> End | None:
    """How a march of what weight brings back has ended by this instant; None: it has not."""
    pushes = march.pushes(record, done)
    beyond = pushes[-1] == 0.0 and march.room(record, done) > 0.0  # of what rings now: losses ring no more
    if beyond or flights(scene, plan.step, pushes, march.masses[0]).size:
        return End.PARTED
    velocity = moved(scene, plan.step, pushes, march.masses[0])[0]
    rests = is_at_rest(scene, velocity, float(pushes[-1]) / plan.step)
    return End.FOLLOWED if rests or done >= MOST_CHUNKS * plan.chunk else None


def _apart(scene: Scene, masses: tuple[float, float], pushed: float) -> bool:
    """Whether the bodies move apart as wholes."""
    return scene.target.velocity + pushed / masses[1] > scene.impactor.velocity - pushed / masses[0]


def _grown(record: Any, larger: Any) -> Any:
    for old, new in zip(record, larger, strict=True):
        new[: old.shape[0]] = old
    return larger


def shown(plan: Plan, scene: Scene, pushes: np.ndarray, done: int, mass: float) -> int:
    """Steps to keep of a march until the bodies parted: a little beyond the last touch, up to a snapshot; pushes
    (steps,): zero where they do not touch. Of one under weight a part of the flight, before it comes back."""
    touching = np.flatnonzero(pushes > 0.0)
    last = int(touching[-1]) + 1 if touching.size else 1  # in a step too long for a law they part as they touch
    glow = math.ceil(AFTERGLOW * scene.time_unit / plan.step)
    if scene.weight_acceleration:
        flown = flights(scene, plan.step, pushes, mass)
        later = touching[touching > flown[0]] if flown.size else touching[:0]
        last = int(touching[touching < flown[0]][-1]) + 1 if flown.size else last
        done = int(later[0]) if later.size else done
        glow = min(glow, max(1, (done - last) // 2))
    return min(done, plan.stride * math.ceil((last + glow) / plan.stride))
