"""What a march over a mesh gives: histories at every instant, fields at some, contacts located in between."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...numerics.elements.line import two_sided
from ...numerics.modal_contacts import run_out
from ...scene import Scene
from ...solution.sampled_motion import SampledMotion, ShapeField, growth
from ...solution.solution import ContactPeriod
from ..parting import End


@dataclass(frozen=True)
class Course:
    """Histories (steps + 1,) at every instant, SI units, and snapshots (rows,) at every `stride`-th."""

    step: float
    stride: int
    force: np.ndarray
    impulse: np.ndarray
    indentation: np.ndarray  # of the law; negative: the gap
    position: np.ndarray  # of the impactor as a whole
    end_position: np.ndarray  # of the target's face
    end_velocity: np.ndarray
    target_velocity: np.ndarray  # (rows,), mean over its mass
    field: ShapeField
    energies: dict[str, np.ndarray]  # (rows,)
    momenta: tuple[float, float]  # of impactor and target at the end, summed over the mesh [kg m/s]
    resolved_time: float  # apart for less is still in contact, as far as this mesh resolves it [s]
    shortest_period: float  # of the mesh [s]
    end: End
    diverged: bool

    @property
    def steps(self) -> int:
        return self.force.size - 1

    @property
    def duration(self) -> float:
        return self.steps * self.step


class ElementMotion(SampledMotion):
    """Straight between the instants; velocities as wholes from the impulse that both bodies received."""

    def __init__(self, scene: Scene, course: Course):
        self.scene, self.course = scene, course
        time = np.arange(course.steps + 1) * course.step
        rows = time[:: course.stride][: next(iter(course.energies.values())).size]
        impactor, target = scene.impactor, scene.target
        rigid, energies = target.velocity + course.impulse / target.mass, dict(course.energies)
        if scene.weight_acceleration:
            height = course.position[:: course.stride][: rows.size]
            energies["weight"] = -impactor.mass * scene.weight_acceleration * height
        if target.held:
            rigid = np.interp(time, rows, course.target_velocity)
        super().__init__(
            time=time,
            force=course.force,
            impulse=course.impulse,
            impactor_position=course.position,
            impactor_velocity=impactor.velocity + scene.weight_acceleration * time - course.impulse / impactor.mass,
            end_position=course.end_position,
            end_velocity=course.end_velocity,
            rigid_velocity=rigid,
            energies={name: np.interp(time, rows, values) for name, values in energies.items()},
            field=course.field if target.length else None,
        )

    def momentum_error(self) -> float:
        """Of what is summed over the meshes at the end against the impulse, relative to the smaller body's share."""
        impactor, target = self.scene.impactor, self.scene.target
        end = np.array([self.course.duration])
        errors = [self.course.momenta[0] - impactor.mass * float(self.impactor_velocity(end)[0])]
        if not target.held:
            errors.append(self.course.momenta[1] - target.mass * float(self.rigid_velocity(end)[0]))
        return max(errors, key=abs) / (min(impactor.mass, target.mass) * self.scene.speed)

    def resolved_force(self, time: np.ndarray) -> np.ndarray:
        """The force averaged over the shortest period of the mesh: the finest that it can resolve."""
        if self.course.shortest_period == 0.0:
            return self.force(time)
        return growth(time, self.time, self.course.impulse, self.course.shortest_period)

    def raw_contacts(self) -> tuple[np.ndarray, np.ndarray]:
        """Start and end [s] of every stretch with a contact force, located inside the steps."""
        return touches(self.scene, self.course.step, self.course.impulse, self.course.indentation)

    def contacts(self) -> list[ContactPeriod]:
        """Contact periods that this mesh resolves: the bodies are apart for longer than a front lasts in it."""
        starts, ends = self.raw_contacts()
        parts = starts[1:] - ends[:-1] >= self.course.resolved_time
        firsts, lasts = starts[np.append(True, parts)], ends[np.append(parts, True)]
        rigid = self.scene.rigid_contact
        found = []
        for start, end in zip(firsts.tolist(), lasts.tolist(), strict=True):
            first, last = int(start / self.course.step), min(int(np.ceil(end / self.course.step)), self.course.steps)
            during = self.time[first : last + 1]
            peak = float((self.resolved_force(during) if rigid else self.force(during)).max())
            gained = float(self.course.impulse[last] - self.course.impulse[first])
            found.append(ContactPeriod(start, end, gained, peak))
        return found


def touches(scene: Scene, step: float, impulse: np.ndarray, indentation: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """See `ElementMotion.raw_contacts`; impulse so far [N s] and indentation [m], (steps + 1,)."""
    cells = np.flatnonzero(np.diff(impulse) > 0.0)  # the force at an instant may be of the step before it
    if not cells.size:
        return np.zeros(1), np.zeros(1)
    breaks = np.flatnonzero(np.diff(cells) > 1)
    firsts, lasts = cells[np.append(0, breaks + 1)], cells[np.append(breaks, cells.size - 1)]
    dent = (lambda deepest: 0.0) if scene.rigid_contact else scene.contact.dent
    deepest = np.maximum(np.maximum.accumulate(indentation), 0.0)

    def closed(instants: np.ndarray, cells: np.ndarray) -> np.ndarray:
        return indentation[instants] - np.array([dent(value) for value in deepest[cells].tolist()])

    starts = step * (firsts + _zero(closed(firsts, firsts), closed(firsts + 1, firsts)))
    left = closed(lasts + 1, lasts)
    ends = step * (lasts + 1.0 - _zero(left, closed(lasts, lasts)))
    for k in np.flatnonzero((left > 0.0) & (lasts + 2 < impulse.size)):  # damping has used up the force before
        pushes = np.diff(impulse[max(lasts[k] - 3, firsts[k]) : lasts[k] + 1])
        lasting = run_out(*pushes.tolist()) if pushes.size == 3 else 1.0
        ends[k] = step * (lasts[k] + lasting)
    return starts, ends


def given(scene: Scene, step: float, impulse: np.ndarray, indentation: np.ndarray) -> tuple[float, float]:
    """Impulses that the impactor has got by its last parting [N s]: of the contact, and of its weight until then."""
    if not scene.weight_acceleration:
        return float(impulse[-1]), 0.0
    until = float(touches(scene, step, impulse, indentation)[1][-1])
    return float(impulse[-1]), scene.impactor.mass * scene.weight_acceleration * until


def shape_field(
    scene: Scene, time: np.ndarray, coordinates: np.ndarray, rates: np.ndarray, sides: Sequence[Any]
) -> ShapeField:
    """Fields of both bodies, the impactor where x is negative.

    coordinates, rates (time, unknowns of both); `sides` have shapes, slopes, moments and shears, as `Mesh` and `Modes`.
    """
    first, second = sides
    stresses = two_sided(_stresses(scene.impactor, first), _stresses(scene.target, second), -1.0)
    forces = {}
    if first.moments or second.moments:
        for name, sign in (("moments", 1.0), ("shears", -1.0)):
            ahead, behind = (getattr(side, name) or (lambda x, side=side: 0.0 * side.shapes(x)) for side in sides)
            forces[name] = two_sided(ahead, behind, sign)
    shapes = two_sided(first.shapes, second.shapes, 1.0)
    return ShapeField(time, coordinates, rates, shapes, stresses, 1.0, **forces)


def _stresses(body: Any, side: Any) -> Callable[[np.ndarray], np.ndarray]:
    """Tension per 1 of each coordinate [Pa]."""
    name, factor = body.stress_source
    return lambda x: factor * getattr(side, name)(x)


def _zero(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Where in a cell (0 to 1) the line from a negative value to a positive one is zero; 0 for any other."""
    crosses = (before < 0.0) & (after > 0.0)
    return np.where(crosses, before / np.where(crosses, before - after, 1.0), 0.0)
