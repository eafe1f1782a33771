"""Finite elements in nodal coordinates."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from ... import validation
from ...contact.duration import steepest_stiffness
from ...numerics.elements import newmark
from ...numerics.elements.banded import times
from ...numerics.elements.line import Line, highest_frequency, line
from ...numerics.elements.mesh import CONSISTENT, LUMPED, with_accelerations
from ...numerics.law_functions import asked, stepped
from ...numerics.parting import reach
from ...scene import Scene
from ...solution.sampled_motion import ShapeField, given_up
from ...text.notes import Note, Severity
from ..options import option, word
from ..parting import End
from .follow import March, Plan, follow
from .march import MANY_ELEMENTS, FiniteElements
from .modal import FeModal
from .motion import Course, given, shape_field

STEPS_PER_ELEMENT = 4  # of Newmark's step while a wave crosses one element
MAX_ENERGY_GAIN = 0.01  # of the energy, gained or lost by the scheme


@dataclass(frozen=True, kw_only=True)
class FeNodal(FiniteElements):
    """Two-node elements marched node by node: straight displacements in rods, Hermite's or Timoshenko's in beams.

    scheme "newmark": constant mean acceleration, consistent mass; "central-difference": explicit, lumped mass, below
    its limit with the contact spring. Where `status` is
    "implicit" the contact force of a step does exactly the law's work, stable at any stiffness; "frozen" is the
    thesis's, decided at the start of the step, which diverges with stiff contacts.
    A rigid contact gets the stiffness of the neighbouring element, E A / l of a rod and E I / l^3 of a beam, of two in
    series, times `contact_stiffness`. Beams know no central differences.
    Error: second order in the step, central differences first if a law's force jumps at first touch; in elements of a
    rod second, 4/3 if it jumps, first if rigid, 2/3 where the front parts rigid faces (free rod); of a beam as for
    'fe-modal'. In beams rounding changes the energy by some 1e-13 elements^2. Cost: steps * nodes.
    Source: thesis 6.4.1, 8.2 and 8.3.
    Differs: table 8.1 prints an analytic peak of 89960 N, (4.33) gives 78277 N; its F_max of 50 elements and more is
    that of the step of 1 us and of the chatter.
    """

    scheme: str = option("newmark", word(("newmark", "central-difference")))
    status: str = option("implicit", word(("implicit", "frozen")))

    NAME = "fe-nodal"
    CONSERVES = False
    RESOLUTIONS = ("elements",)

    @classmethod
    def read(cls, given: Mapping[str, Any]) -> Self:
        found = super().read(given)
        if found.status == "frozen" and found.scheme != "newmark":
            raise validation.SceneError("method.status", found.status, validation.allowed("frozen-status"))
        return found

    def why_not(self, scene: Scene) -> Note | None:
        if self.status == "frozen" and scene.contact.NAME not in ("rigid", "linear"):
            return Note("refusals.frozen-law", Severity.REFUSAL, law=scene.contact.NAME)
        if self.scheme != "newmark" and scene.bends:
            return Note("refusals.central-beam", Severity.REFUSAL)
        return super().why_not(scene)

    def _energy_notes(self, diagnostics: Mapping[str, Any]) -> list[Note]:
        gained = diagnostics["energy_error"]
        if abs(gained) < MAX_ENERGY_GAIN:
            return []
        implicit = self.scheme == "newmark"
        return [Note("energy-changed", Severity.WARNING, change=100.0 * gained, implicit=implicit)]

    def _left_by_mesh(self, scene: Scene, difference: Callable[[FiniteElements], float]) -> float:
        """Of a rigid contact with rods by meshes with a massless boundary, which settle sooner: how far one twice as
        fine is from this, and from one as fine as this.
        """
        if not scene.rigid_contact or scene.bends or self.elements > MANY_ELEMENTS:
            return super()._left_by_mesh(scene, difference)
        finer, alike = (difference(FeModal(elements=times * self.elements)) for times in (2, 1))
        return math.hypot(1.8 * finer, 2.0 * (finer - alike))

    def _course(self, scene: Scene, duration: float | None) -> Course:
        if duration is None and self.steps is not None:
            duration = replace(self, steps=None)._course(scene, None).duration
        return _nodal_course(scene, *self._marched(scene, duration))

    def _given(self, scene: Scene, duration: float) -> tuple[float, float]:
        *_, plan, record, steps, _, _ = self._marched(scene, duration)
        return given(scene, plan.step, record.impulse[: steps + 1], record.indentation[: steps + 1])

    def _marched(
        self, scene: Scene, duration: float | None
    ) -> tuple[Any, Line, Any, Plan, newmark.Record, int, End, bool]:
        """Meshes, both as one, law, plan, record, steps, how it ended, and whether it has diverged."""
        lumping = LUMPED if self.scheme == "central-difference" else CONSISTENT
        meshes = tuple(body.mesh(self.elements, lumping) for body in (scene.impactor, scene.target))
        whole, law = line(*meshes), self._law(scene)
        fine, limit = min(mesh.transit for mesh in meshes) / STEPS_PER_ELEMENT, math.inf
        if self.scheme == "central-difference":
            limit = 2.0 / highest_frequency(whole, steepest_stiffness(law, scene.reduced_mass, scene.speed))
            fine = limit
        plan = Plan.of(scene, law, fine, limit, self.steps, duration, whole.mass.shape[1])
        return meshes, whole, law, plan, *self._march(scene, meshes, whole, law, plan)

    def _march(self, scene, meshes, whole: Line, law: Any, plan: Plan) -> tuple[newmark.Record, int, End, bool]:
        v = np.concatenate(
            [mesh.moving(body.velocity) for mesh, body in zip(meshes, (scene.impactor, scene.target), strict=True)]
        )
        u, start, step, stride = np.zeros(v.size), v.copy(), plan.step, plan.stride
        fall = scene.weight_acceleration

        def make(steps: int) -> newmark.Record:
            record = newmark.record(steps, stride, start.size)
            record.velocity[0] = start
            record.first_velocity[0] = scene.impactor.velocity
            record.second_velocity[0] = scene.target.velocity
            return record

        if self.scheme == "central-difference":
            lossy, explicit = law.LOSSY or law.PLASTIC, newmark.explicit(whole, step)
            of_law = asked(law)

            def advance(begin, end, record):
                newmark.march_explicit(*of_law, lossy, explicit, fall, step, u, v, stride, begin, end, record)
                return end
        elif self.status == "frozen":
            matrices = newmark.newmark(whole, step)

            def advance(begin, end, record):
                return newmark.march_frozen(law.stiffness, matrices, fall, step, u, v, stride, begin, end, record)
        else:
            matrices, drift = newmark.newmark(whole, step), whole.wholes.still()
            of_law = stepped(law)

            def advance(begin, end, record):
                newmark.march_implicit(*of_law, matrices, fall, step, u, v, drift, stride, begin, end, record)
                return end

        masses = meshes[0].rigid_mass, meshes[1].rigid_mass
        bodies = (scene.impactor, scene.target)

        def room(record, instant):
            snapshot = instant // stride
            fallen = 0.5 * fall * (snapshot * stride * step) ** 2  # as seen from the frame of the march
            dent = float(law.dent(max(float(record.deepest[instant]), 0.0)))
            return _room(bodies, _ringing(meshes, record, snapshot)) + dent - fallen

        def pushes(record, instant):
            return np.diff(record.impulse[: instant + 1])

        def rings(record, instant):
            return sum(energy for _, energy in _ringing(meshes, record, instant // stride))

        march = March(masses, law, make, advance, lambda record, k: float(record.impulse[k]), room, pushes, rings)
        record, done, how = follow(scene, plan, march)
        diverged = self.status == "frozen" and done < plan.most and how is End.FOLLOWED and not fall
        if diverged:
            done -= done % stride
        done = max(done, stride)
        if fall:
            _let_fall(record, fall, step, stride, done, np.concatenate((meshes[0].moving(1.0), meshes[1].moving(0.0))))
        return record, done, how, diverged


def _let_fall(record: newmark.Record, fall: float, step: float, stride: int, done: int, moves: np.ndarray) -> None:
    """Put the impactor, marched in the frame that falls with it, to where it is; moves (unknowns,): of it by 1 m."""
    time = step * np.arange(done + 1)
    rows, at = done // stride + 1, time[::stride]
    record.first[: done + 1] += 0.5 * fall * time**2
    record.first_velocity[: done + 1] += fall * time
    record.displacement[:rows] += np.multiply.outer(0.5 * fall * at**2, moves)
    record.velocity[:rows] += np.multiply.outer(fall * at, moves)


def _ringing(meshes, record: newmark.Record, snapshot: int) -> list[tuple[float, float]]:
    """See `Mesh.ringing`, of both bodies."""
    u, v, first = record.displacement[snapshot], record.velocity[snapshot], meshes[0].size
    parts = slice(first), slice(first, None)
    return [mesh.ringing(u[part], v[part]) for mesh, part in zip(meshes, parts, strict=True)]


def _room(bodies, known: list[tuple[float, float]]) -> float:
    """By how much further both bodies as wholes are apart than their faces reach [m]; see `numerics.parting`."""
    reaches = [reach(energy, body.face_compliance) for (_, energy), body in zip(known, bodies, strict=True)]
    return float(known[1][0] - known[0][0] - sum(reaches))


def _nodal_course(scene, meshes, whole, law, plan, record, steps, end, diverged) -> Course:
    """Histories and fields of a march over nodes."""
    rows = steps // plan.stride + 1
    u, v = record.displacement[:rows], record.velocity[:rows]
    energy = 0.5 * v * times(whole.mass, v) + whole.strain_energy(u)
    parts = slice(whole.split), slice(whole.split, None)
    own, other = (energy[:, part].sum(1) for part in parts)
    pushed = v[:, parts[1]] @ meshes[1].weights
    rigid = meshes[1].rigid_energy(v[:, parts[1]])
    instants = slice(0, steps + 1)
    force = record.contact_force[instants]
    depth, deepest = (values[instants][:: plan.stride].tolist() for values in (record.indentation, record.deepest))
    stored = np.array([law.stored(a, most) for a, most in zip(depth, deepest, strict=True)])
    lost = given_up(law, stored, plan.stride * np.arange(rows), np.diff(record.impulse[instants]))
    travelled = np.concatenate(([0.0], np.cumsum(record.impulse[1 : steps + 1] + record.impulse[:steps])))
    time = plan.step * np.arange(steps + 1)
    free = time * (scene.impactor.velocity + 0.5 * scene.weight_acceleration * time)
    centre = free - 0.5 * plan.step * travelled / scene.impactor.mass
    return Course(
        step=plan.step,
        stride=plan.stride,
        force=force,
        impulse=record.impulse[instants],
        indentation=record.indentation[instants],
        position=centre if meshes[0].rings else record.first[instants],
        end_position=record.second[instants],
        end_velocity=record.second_velocity[instants],
        target_velocity=pushed / scene.target.mass,
        field=_field(scene, meshes, whole, plan.step * plan.stride * np.arange(rows), u, v, force[:: plan.stride]),
        energies={
            "impactor": own,
            "target_rigid": rigid,
            "target_vibration": other - rigid,
            "local": stored - lost,
            "dissipated": record.lost[instants][:: plan.stride] + lost,
        },
        momenta=(float(v[-1, parts[0]] @ meshes[0].weights), float(pushed[-1])),
        resolved_time=max(mesh.resolved_time for mesh in meshes),
        shortest_period=min(mesh.shortest_period for mesh in meshes if mesh.rings),
        end=end,
        diverged=diverged,
    )


def _field(scene, meshes, whole: Line, times, u, v, force) -> ShapeField:
    """Of both bodies at the snapshots; that of a beam by its accelerations too, with which its shear force balances."""
    if not any(mesh.bends for mesh in meshes):
        return shape_field(scene, times, u, v, meshes)
    accelerations = whole.accelerations(u, force)
    coordinates, rates = [], []
    for mesh, part in zip(meshes, (slice(whole.split), slice(whole.split, None)), strict=True):
        behind = accelerations[:, part] if mesh.bends else np.zeros((times.size, 0))
        coordinates += [u[:, part], behind]
        rates += [v[:, part], np.zeros_like(behind)]
    sides = [with_accelerations(mesh) for mesh in meshes]
    return shape_field(scene, times, np.hstack(coordinates), np.hstack(rates), sides)
