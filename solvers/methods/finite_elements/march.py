"""What the methods of finite elements share: the options, the local stiffness, the march until the bodies part."""

from abc import abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

from ...contact import Linear
from ...contact.duration import contact_time
from ...provenance import clock
from ...scene import Scene
from ...solution.solution import Later, Solution
from ...solution.summary import summary
from ...text.notes import Note, Severity
from ..base import Method
from ..estimates import error_left, with_error
from ..options import option, real, whole
from ..parting import MAY_TOUCH_AGAIN, End, may_gain
from ..validity import (
    STILL_TOUCHING,
    bodies_that_bend,
    cut_short,
    missed_dashpot,
    notes_on_front,
    notes_on_rigid_impact,
)
from ..weight import comes_to_rest, is_at_rest, never_leaves
from .follow import MAX_STEPS
from .motion import Course, ElementMotion, given

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
        elif course.end is End.NEVER:
            notes.append(never_leaves(scene, course.duration))
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
        own, later = given(scene, course.step, course.impulse, course.indentation), [0.0]

        def difference(method: FiniteElements, scene: Scene = scene) -> float:
            pushed, weighed = (a - b for a, b in zip(own, method._given(scene, course.duration), strict=True))
            later.append(abs(weighed) / scale)
            return (pushed - weighed) / scale

        estimated = self._left_by_mesh(scene, difference)
        if rigid or scene.contact.JUMPS:  # then ripples end the contact, which no order tells
            estimated = max(estimated, *later)
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
    def _given(self, scene: Scene, duration: float) -> tuple[float, float]:
        """See `motion.given`: by then, without histories and fields."""
