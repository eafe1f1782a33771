"""Finite elements in the modes of the mesh."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .. import checks
from ..contact import Linear
from ..motion import ShapeField
from ..numerics.elements import AVERAGED, CONSISTENT, mesh_modes, two_sided
from ..numerics.modes import Modes, front_time
from ..numerics.oscillators import Record, Residual, march, oscillator_bank
from ..scene import Scene
from .element_march import ELEMENTS_RANGE, FiniteElements, Plan, end, follow, read_common
from .element_motion import Course

STEPS_PER_PERIOD = 20  # of the highest mode kept
USUAL_MODES = 20  # with a consistent boundary
BOUNDARIES = ("consistent", "massless")


@dataclass(frozen=True, kw_only=True)
class FeModal(FiniteElements):
    """The lowest eigenvectors of a mesh (component mode synthesis); the modes left out act as a spring.

    scheme "energy-exact": exact oscillators; "newmark": constant mean acceleration. The contact force of a step does
    exactly the law's work in both. boundary "massless": the inertia of the struck node is moved to the next one and
    the mass of the mesh averaged between consistent and lumped, so that a rigid contact needs no local stiffness and
    hardly chatters; all modes are kept unless `modes` says otherwise. A contact with a law of its own does better with
    the "consistent" mass.
    Error: second order in the step; first order in 1 / elements and 1 / modes for a rigid contact. Cost: steps * modes
    and, once, elements^3.
    Source: thesis 6.4.1 and 8.2; massless boundary: Monjaraz Tec, Gross and Krack (2022).
    Differs: table 8.2 leaves out the compliance of the modes not kept, and its rows of 5 to 20 modes follow from no
    stiffness and step that could be tried.
    """

    modes: int | None = None  # 20, or all with a massless boundary
    scheme: str = "energy-exact"
    boundary: str | None = None  # "massless" if the contact is rigid, else "consistent"

    NAME = "fe-modal"
    KNOBS = ("elements",)

    @classmethod
    def read(cls, given: Mapping[str, object]) -> "FeModal":
        keys = ("elements", "modes", "steps", "contact_stiffness", "scheme", "boundary")
        given = checks.table("method", given, keys)
        modes, boundary = given.get("modes"), given.get("boundary")
        return cls(
            **read_common(given),
            modes=None if modes is None else checks.whole_number("method.modes", modes, 1, ELEMENTS_RANGE[1]),
            scheme=checks.choice("method.scheme", given.get("scheme", "energy-exact"), ("energy-exact", "newmark")),
            boundary=None if boundary is None else checks.choice("method.boundary", boundary, BOUNDARIES),
        )

    def _massless(self, scene: Scene) -> bool:
        return scene.contact.NAME == "rigid" if self.boundary is None else self.boundary == "massless"

    def _needs_stiffness(self, scene: Scene) -> bool:
        return not self._massless(scene)

    def _halved(self, course: Course) -> "FeModal":
        return replace(super()._halved(course), modes=None if self.modes is None else max(1, self.modes // 2))

    def _modes_of(self, body: Any, massless: bool) -> Modes:
        if body.time_unit is None:
            return body.modes(1)
        mesh = body.mesh(self.elements, AVERAGED if massless else CONSISTENT)
        return mesh_modes(mesh, self.modes or (None if massless else USUAL_MODES), massless)

    def _course(self, scene: Scene, duration: float | None) -> Course:
        if duration is None and self.steps is not None:
            duration = replace(self, steps=None)._course(scene, None).duration
        massless = self._massless(scene)
        first, second = (self._modes_of(body, massless) for body in (scene.impactor, scene.target))
        frequencies = np.concatenate((second.frequencies, first.frequencies))
        at_contact = np.concatenate((second.at_contact, first.at_contact))
        law, residual = self._law(scene), first.residual_compliance + second.residual_compliance
        if self._face_goes_along(scene):
            law, residual = Linear(1.0 / residual), 0.0
        fine = 2.0 * np.pi / float(frequencies.max()) / STEPS_PER_PERIOD
        plan = Plan.of(scene, law, fine, math.inf, self.steps, duration, frequencies.size)
        turning = 2.0 / plan.step * np.arctan(0.5 * frequencies * plan.step) if self.scheme == "newmark" else None
        bank = oscillator_bank(frequencies, at_contact, plan.step, turning)
        displacement, velocity = np.zeros(frequencies.size), np.zeros(frequencies.size)

        settling = min(0.5, plan.step * float(frequencies.max()) / (2.0 * np.pi)) if law.JUMPS or law.PLASTIC else 0.0
        spring = Residual(residual, settling, law.JUMPS)

        def make(steps: int) -> Record:
            record = Record(
                *(np.zeros(steps + 1) for _ in range(8)),
                *(np.zeros((steps // plan.stride + 1, frequencies.size)) for _ in range(2)),
            )
            record.velocity[0], record.rigid_velocity[0] = scene.impactor.velocity, scene.target.velocity
            return record

        def advance(begin, end, record):
            march(
                law, spring, first.rigid_mass, second.rigid_mass, plan.step, bank,
                displacement, velocity, plan.stride, begin, end, record,
            )  # fmt: skip
            return end

        record, done, parted = follow(
            scene, plan, make, advance, lambda record, k: plan.step * float(record.contact_force[:k].sum())
        )
        if parted:
            last = int(np.flatnonzero(record.contact_force[:done])[-1]) + 1
            done = end(plan, scene, last, done)
        return self._histories(scene, (first, second), law, residual, plan, record, done, parted)

    def _face_goes_along(self, scene: Scene) -> bool:
        """Whether a face has no compliance but its own: that of the massless element, and of the modes left out."""
        return self._massless(scene) and scene.contact.NAME == "rigid"

    def _histories(self, scene, modes, law, residual, plan, record, steps, parted) -> Course:
        """Histories at all instants, fields and energies at the snapshots."""
        instants, rows = slice(0, steps + 1), slice(0, steps + 1, plan.stride)
        own = _coordinates(modes, record, rows)
        push, depth = record.contact_force[:steps], record.indentation[instants]
        force = 0.5 * (np.append(push[:1], push) + np.append(push, push[-1:]))
        deepest = np.maximum(np.maximum.accumulate(depth), 0.0)
        stored = [law.stored(a, most) for a, most in zip(depth[rows].tolist(), deepest[rows].tolist(), strict=True)]
        energies = [0.5 * (rates**2 + (frequencies * q) ** 2) for q, rates, frequencies in own]
        field = self._field(scene, modes, own, force[rows], plan.step * plan.stride)
        closing = np.minimum(depth, 0.0) if self._face_goes_along(scene) else depth
        times = plan.step * np.arange(steps + 1)
        if scene.impactor.time_unit is None:
            face = record.position[instants] - closing
        else:
            face = np.interp(times, times[rows], field.displacement(times[rows], np.zeros(1))[:, 0])
        held, bodies = scene.target.held, (scene.impactor, scene.target)
        order = 4 if self._massless(scene) else 2  # of the dispersion of averaged and of consistent mass
        ringing = [m for m, body in zip(modes, bodies, strict=True) if body.time_unit is not None]
        return Course(
            step=plan.step,
            stride=plan.stride,
            force=force,
            impulse=np.append(0.0, np.cumsum(push)) * plan.step,
            indentation=depth,
            position=record.position[instants],
            end_position=face,
            end_velocity=np.gradient(face, plan.step),
            field=field,
            energies={
                "impactor": energies[0].sum(1),
                "target_rigid": np.zeros(energies[1].shape[0]) if held else energies[1][:, 0],
                "target_vibration": energies[1][:, 0 if held else 1 :].sum(1),
                "local": np.array(stored) + 0.5 * residual * record.spring_force[rows] ** 2,
                "dissipated": record.lost[rows],
            },
            momenta=(
                modes[0].rigid_mass * float(record.velocity[steps]),
                0.0 if held else modes[1].rigid_mass * float(record.rigid_velocity[steps]),
            ),
            resolved_time=max(front_time(m.frequencies.size, m.shortest_period, order) for m in ringing),
            shortest_period=min(m.shortest_period for m in ringing),
            parted=parted,
            diverged=False,
        )

    def _field(self, scene: Scene, modes: tuple[Modes, Modes], own, force: np.ndarray, interval: float) -> ShapeField:
        """Sums of the modes, and of the strain that the force leaves in a massless first element."""
        bodies, sides = (scene.impactor, scene.target), []
        coordinates, rates = ([side[part] for side in own] for part in (0, 1))
        for number, (body, known, sign) in enumerate(zip(bodies, modes, (-1.0, 1.0), strict=True)):
            fields = known.with_rigid()
            if self._massless(scene) and body.time_unit is not None:
                mesh = body.mesh(self.elements, AVERAGED)
                fields = tuple(
                    _beside(field, part) for field, part in zip(fields, (mesh.shapes, mesh.slopes), strict=True)
                )
                press = sign * force[:, None] / mesh.neighbour
                coordinates[number] = np.hstack((coordinates[number], press))
                rates[number] = np.hstack((rates[number], np.gradient(press, interval, axis=0)))
            sides.append(fields)
        (shapes1, slopes1), (shapes2, slopes2) = sides
        return ShapeField(
            interval * np.arange(force.size),
            np.hstack(coordinates),
            np.hstack(rates),
            two_sided(shapes1, shapes2, 1.0),
            two_sided(slopes1, slopes2, -1.0),
            scene.target.material.young if scene.target.length else 0.0,
        )


def _beside(field, nodes):
    """A field of modes with that of the struck node alone below it."""
    return lambda x: np.vstack((field(x), nodes(x)[:1]))


def _coordinates(modes: tuple[Modes, Modes], record: Record, rows: slice):
    """Mass-normalised coordinates, rates and frequencies of each body, its motion as a whole in front if it is free.

    The record holds the target's modes first, and the impactor's as if they moved the other way.
    """
    count = len(range(*rows.indices(rows.stop)))
    split, found = modes[1].frequencies.size, []
    for known, part, sign, whole in (
        (modes[0], slice(split, None), -1.0, (record.position, record.velocity)),
        (modes[1], slice(0, split), 1.0, (record.rigid_position, record.rigid_velocity)),
    ):
        q = sign * record.checkpoint_displacement[:count, part] / known.at_contact
        rates = sign * record.checkpoint_velocity[:count, part] * known.frequencies / known.at_contact
        frequencies = known.frequencies
        if np.isfinite(known.rigid_mass):
            root = np.sqrt(known.rigid_mass)
            q, rates = (np.column_stack((root * w[rows], own)) for w, own in zip(whole, (q, rates), strict=True))
            frequencies = np.append(0.0, frequencies)
        found.append((q, rates, frequencies))
    return found
