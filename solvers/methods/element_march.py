"""What the methods of finite elements share: the options, the local stiffness, the march until the bodies part."""

import math
from abc import abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from .. import checks
from ..bodies import Rods
from ..contact import Linear
from ..doubts import STILL_TOUCHING, bodies_that_bend, cut_short, doubts_of_a_front, doubts_of_a_rigid_blow
from ..machine import clock
from ..method import AFTERGLOW, MAX_ROUND_TRIPS, Method
from ..numerics.beam_statics import static_compliance
from ..scene import Scene, contact_time
from ..solution import Solution, summary
from .element_motion import Course, ElementMotion

STEPS_PER_CONTACT = 100
LIMIT_SHARE = 0.8  # of the explicit limit; nearer to it a contact that opens and closes feeds the mesh
EXPECTED_STEPS = 60_000  # more are not chosen unasked
MAX_STEPS = 4_000_000
SNAPSHOTS = 1000  # of all nodes, over the time expected
MOST_NUMBERS = 10_000_000  # doubles kept of nodes
LEAST_ORDER = 0.6  # in 1 / elements, that is told from none
FEW_CONTACTS = 6  # of a stiff contact with a beam: so many are well determined
UNSETTLED = 1e-3  # estimated error of many contacts with a law: with less they are well determined
ELEMENTS_RANGE = (1, 2000)


@dataclass(frozen=True, kw_only=True)
class FiniteElements(Method):
    """What both methods share: the mesh, the local stiffness of a rigid contact, the march until the bodies part."""

    elements: int = 100
    steps: int | None = None  # over the whole duration
    contact_stiffness: float = 1.0  # of a rigid contact, in stiffnesses of the neighbouring element
    estimate: bool = field(default=True, repr=False)

    BEAMS = True

    def why_not(self, scene: Scene) -> str | None:
        bodies = (scene.impactor, scene.target)
        for body in bodies:
            if body.kind == "half-space" or getattr(body, "support", "") == "anechoic":
                return "the bodies must end somewhere, got one that waves run away in; use 'waves'"
            if isinstance(body, Rods) and not all(joint.bonded for joint in body.joints):
                return "the rods of a chain must be bonded; for rods that only touch use 'waves'"
        if all(body.time_unit is None for body in bodies):
            return "at least one body must be a rod or a beam, divided into elements; use 'quasi-static' or 'balance'"
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
            "estimated_error": self._estimated_error(scene, course) if self.estimate and not course.diverged else None,
            "raw_contacts": motion.raw_contacts()[0].size,
            "raw_peak_force": float(course.force.max()),
            "resolved_time": course.resolved_time,
        }
        rigid = scene.contact.NAME == "rigid"
        depth = None if rigid else float(max(course.indentation.max(), 0.0))
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=course.duration,
            motion=motion,
            peak_force=max(contact.peak_force for contact in contacts),
            peak_indentation=depth,
            residual_indentation=None if rigid else float(scene.contact.dent(depth)),
            notes=self._notes(scene, motion, duration, len(contacts), found["diagnostics"]["estimated_error"])
            + self._doubts(found["diagnostics"]),
            **found,
        )

    def _doubts(self, diagnostics: Mapping[str, Any]) -> list[str]:
        """What the figures themselves say."""
        return []

    def _notes(
        self, scene: Scene, motion: ElementMotion, duration: float | None, contacts: int, error: float | None
    ) -> list[str]:
        course, notes = motion.course, []
        if scene.contact.NAME == "rigid" and self._needs_stiffness(scene):
            both = scene.impactor.time_unit is not None and scene.target.time_unit is not None
            whose = "both neighbouring elements in series" if both else "the neighbouring element"
            notes.append(
                f"A rigid contact of a mesh needs a local stiffness: {self.contact_stiffness:g} times that of {whose}, "
                f"{self._stiffness(scene):.4g} N/m, as the thesis takes it."
            )
        if course.diverged:
            notes.append(
                "The solution grows without bound and was stopped: the contact status is frozen over each step, which "
                "feeds a stiff contact. Use status 'implicit', a smaller contact_stiffness or more steps."
            )
        elif duration is None and self.steps is None and not course.parted:
            notes.append(cut_short(f"{course.steps} steps"))
        elif course.force[-1] > 0.0:
            notes.append(STILL_TOUCHING)
        raw, beam = motion.raw_contacts()[0].size, "beam" in (scene.impactor.kind, scene.target.kind)
        if raw > contacts and not course.diverged:
            remedy = (
                "A law by which the contact gives way, such as 'hertz', avoids it." if beam else self._calmer(scene)
            )
            notes.append(
                f"The faces touch {raw} times in {contacts} contact{'s' * (contacts > 1)}: the mesh chatters at its "
                f"shortest period, and the peak of the raw force means nothing. {remedy}"
            )
        if scene.contact.NAME == "rigid":
            notes += doubts_of_a_rigid_blow(scene, self._told_down_to(scene, course), self.elements, "elements")
        notes += doubts_of_a_front(scene, course.shortest_period, self.elements, "elements")
        rough = scene.contact.NAME == "rigid" or (error is not None and error > UNSETTLED)
        if beam and rough and contacts > FEW_CONTACTS:
            notes.append(
                f"{contacts} contacts, each of which starts from how the one before left the beam: a millionth more "
                "mass, or half the step, changes the later ones, their number and the final velocity. The first few "
                "and the largest deflection are well determined; an ensemble of such blows tells what is, and a softer "
                "contact makes fewer."
            )
        return notes

    def _estimated_error(self, scene: Scene, course: Course) -> float:
        """Of the final velocity, relative to the impact speed: against half and a third of the elements and steps.

        Against two of them, as one coarse answer may agree with the fine one by chance.
        """
        others = [self._coarser(scene, parts)._course(scene, course.duration).impulse[-1] for parts in (2, 3)]
        rigid, scale = scene.contact.NAME == "rigid", scene.impactor.mass * scene.speed
        estimated = left_of(*(float(course.impulse[-1] - other) / scale for other in others), rigid)
        if rigid and scene.blow < self._told_down_to(scene, course):
            return max(estimated, 1.0)  # shorter than the mesh can tell: all meshes are wrong alike
        return estimated if rigid or bodies_that_bend(scene) else max(estimated, self._unfelt(scene, course))

    def _unfelt(self, scene: Scene, course: Course) -> float:
        """What a blow under a law on a rod is off by, of the speed of approach, where all meshes are wrong alike.

        A mass so light that it is stopped before a wave has left the struck node, and a contact so short, meet that
        node as a mass, where a rod would give way at F / Z; that takes pi^2 / 2 m / (Z t) of the speed from a spring.
        Measured at mass ratios of 60 to 1000, 6 to 200 elements: 0.3 to 1.6 times what is returned.
        """
        shortest, touch = course.shortest_period, contact_time(self._law(scene), scene.reduced_mass, scene.speed)
        if scene.blow >= shortest:
            return 0.0
        return min(3.0 * scene.blow / touch, 1.0) * min(0.6 * shortest / touch, 1.0) ** 2

    def _told_down_to(self, scene: Scene, course: Course) -> float:
        """The shortest period of the mesh [s], or half a swing of what strikes a beam on the local stiffness."""
        if not self._needs_stiffness(scene) or not bodies_that_bend(scene):
            return course.shortest_period
        return max(course.shortest_period, contact_time(self._law(scene), scene.reduced_mass, scene.speed))

    def _coarser(self, scene: Scene, parts: int) -> "FiniteElements":
        return replace(self, elements=max(1, self.elements // parts), steps=None)

    def _stiffness(self, scene: Scene) -> float:
        """Local stiffness of a rigid contact [N/m]: of the elements next to it, in series if both bodies have one.

        So it does not matter who strikes.
        """
        neighbours = [body.mesh(self.elements).neighbour for body in (scene.impactor, scene.target)]
        return self.contact_stiffness / sum(1.0 / stiffness for stiffness in neighbours if stiffness)

    def _law(self, scene: Scene) -> Any:
        return Linear(self._stiffness(scene)) if scene.contact.NAME == "rigid" else scene.contact

    def _calmer(self, scene: Scene) -> str:
        """What avoids chatter in rods."""
        if scene.contact.NAME == "rigid":
            return "All modes with the massless boundary of 'fe-modal' avoid most of it."
        return "More elements make it less, and 'waves' has none."

    def _knob(self, scene: Scene) -> str | None:
        return None if bodies_that_bend(scene) else super()._knob(scene)

    def _recount(self) -> str:
        return "The mesh and its local stiffness blur slight gaps and contacts: use 'fe-modal' as it comes, or 'waves'."

    def _needs_stiffness(self, scene: Scene) -> bool:
        """Whether a rigid contact needs a local stiffness."""
        return True

    @abstractmethod
    def _course(self, scene: Scene, duration: float | None) -> Course: ...


def left_of(half: float, third: float, rigid: bool) -> float:
    """The error left, from the differences to half and to a third of a resolution (signed).

    By the order that the two show together, where it is one: a contact with a law converges with the second power or
    better, and the second is taken; a rigid one with about the first. Else the larger difference.
    """
    largest, most = max(abs(half), abs(third)), 1.0 if rigid else 2.0
    orders = np.linspace(LEAST_ORDER, most + 1.5 if rigid else 2.0 * most, 100)
    ratios = (3.0**orders - 1.0) / (2.0**orders - 1.0)
    if half * third <= 0.0 or not ratios[0] <= third / half <= ratios[-1]:
        return largest
    return abs(half) / (2.0 ** min(float(np.interp(third / half, ratios, orders)), most) - 1.0)


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
        trips = [body.time_unit for body in ringing]
        touch = contact_time(law, scene.reduced_mass, scene.speed)
        reduced = scene.reduced_mass
        expected = 3.0 * (sum(trips) + touch + math.pi * math.sqrt(reduced * sum(map(_softness, ringing))))
        fine = min(max(min(fine, touch / STEPS_PER_CONTACT), expected / EXPECTED_STEPS), LIMIT_SHARE * limit)
        count = given
        if duration is not None:
            count = min(max(10, math.ceil(duration / fine)), MAX_STEPS) if given is None else given
            fine = duration / count
        if fine > limit * (1.0 + 1e-9):
            least = math.ceil(duration / limit)
            raise checks.SceneError(
                "method.steps", count, f"at least {least} for this mesh, contact and duration: the step is explicit"
            )
        expected_steps, nodes = count or math.ceil(expected / fine), max(nodes, 1)
        stride = max(1, expected_steps // min(SNAPSHOTS, max(10, MOST_NUMBERS // nodes)))
        if count is not None:
            stride = next(part for part in range(stride, 0, -1) if count % part == 0)
        period = 2.0 * max(trips)
        most = int(min(MAX_STEPS, MAX_ROUND_TRIPS * scene.time_unit / fine, stride * MOST_NUMBERS // nodes))
        most = count or stride * max(1, most // stride)  # so that the last instant has its snapshot
        chunk = count or stride * math.ceil(period / fine / stride)
        return cls(fine, count, most, chunk, stride)


def _softness(body: Any) -> float:
    """Static compliance [m/N] of a rod or a beam; free, against its own inertia or about so."""
    if body.kind != "beam":
        return sum(1.0 / rod.stiffness for rod in body.rods)
    return static_compliance(body.line, body.support, body.place, body.end_mass)


def follow(
    scene: Scene, plan: Plan, masses: tuple[float, float], make: Callable, advance: Callable, impulse: Callable
) -> tuple[Any, int, bool]:
    """March by chunks until the bodies have not touched for one and move apart. Returns record, steps, parted.

    masses [kg]: what a blow feels of impactor and target as wholes, infinite of what is held; make(steps): an empty
    record; advance(begin, end, record): the instant reached; impulse(record, instant) [N s].
    """
    record, done = make(plan.chunk), 0
    while done < plan.most:
        until = min(done + plan.chunk, plan.most)
        if until > record.contact_force.size - 1:
            record = _grown(record, make(max(until, min(2 * until, plan.most))))
        before, reached = impulse(record, done), advance(done, until, record)
        if reached < until:
            return record, reached, False
        done, gained = until, impulse(record, until)
        if plan.count is None and gained == before:
            parting = scene.target.velocity + gained / masses[1] - (scene.impactor.velocity - gained / masses[0])
            if parting > 0.0:
                return record, done, True
    return record, done, False


def _grown(record: Any, larger: Any) -> Any:
    for old, new in zip(record, larger, strict=True):
        new[: old.shape[0]] = old
    return larger


def end(plan: Plan, scene: Scene, last_touch: int, done: int) -> int:
    """Steps to keep of a march until the bodies parted: a little beyond the last touch, up to a snapshot."""
    wished = last_touch + math.ceil(AFTERGLOW * scene.time_unit / plan.step)
    return min(done, plan.stride * math.ceil(wished / plan.stride))


def read_common(given: Mapping[str, object]) -> dict[str, Any]:
    steps = given.get("steps")
    return {
        "elements": checks.whole_number("method.elements", given.get("elements", 100), *ELEMENTS_RANGE),
        "steps": None if steps is None else checks.whole_number("method.steps", steps, 10, MAX_STEPS),
        "contact_stiffness": checks.number(
            "method.contact_stiffness", given.get("contact_stiffness", 1.0), 1e-6, 1e8, "stiffnesses of an element"
        ),
    }
