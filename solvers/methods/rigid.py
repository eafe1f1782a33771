"""Rigid bodies: one impulse without duration, in closed form."""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import checks
from ..bodies import Rods, in_space
from ..method import AFTERGLOW, Method
from ..motion import SampledMotion
from ..numerics.impulses import Bodies, Strike, kinetic_energy, residuals, strike
from ..scene import Scene
from ..solution import ContactPeriod, Solution

ALONG = (1.0, 0.0, 0.0)  # the axis on which bodies without a normal meet


@dataclass(frozen=True)
class RigidImpulse(Method):
    """Both bodies move as a whole before and after one frictionless impulse J = (1 + e) mu v_imp.

    Bodies in space with their tensors of inertia, or any bodies on an axis, where rods and chains of bonded rods count
    by their mass and what is held by a support counts as immovable. The contact law has no say, but `restitution`.
    Source: note on rigid-body impulses; thesis 3.2 and (9.1) on an axis.
    Differs: the note has no guard against bodies that part already, J = 0, and leaves out the loss of energy,
    mu (1 - e^2) v_imp^2 / 2.
    """

    restitution: float = 1.0

    NAME = "rigid"
    SPATIAL = True

    @classmethod
    def read(cls, given: Mapping[str, object]) -> "RigidImpulse":
        given = checks.table("method", given, ("restitution",))
        return cls(checks.number("method.restitution", given.get("restitution", 1.0), 0.0, 1.0))

    def why_not(self, scene: Scene) -> str | None:
        target = scene.target
        if target.kind == "spring-mass":
            return "the target must move as a whole, got a mass on a spring, which swings back for another blow"
        if isinstance(target, Rods) and not all(joint.bonded for joint in target.joints):
            return "the rods of a chain must be bonded to move as a whole; for rods that only touch use 'waves'"
        return None

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = time.perf_counter()
        normal = np.array(scene.normal or ALONG)
        before = in_space(scene.impactor), in_space(scene.target)
        found = strike(*before, normal, self.restitution)
        wall_time = time.perf_counter() - begun
        duration = AFTERGLOW * scene.time_unit if duration is None else duration
        impulse, approached = float(found.impulse), bool(found.approach > 0.0)
        energy = _energy(before, found)
        force = None if approached else 0.0
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=[ContactPeriod(0.0, 0.0, impulse, force)] if approached else [],
            duration=duration,
            motion=_motion(before, found, duration) if scene.normal is None else None,
            impulse=impulse,
            peak_force=force,
            peak_indentation=None,
            residual_indentation=None,
            restitution=self._restitution(before, found, normal),
            energy=energy,
            diagnostics=_diagnostics(before, found, normal, energy) | {"wall_time": wall_time} | _unknown(scene),
            notes=_notes(scene, before, approached),
            effective_mass=float(found.effective_mass),
            **_velocities(scene, found),
        )

    def _restitution(self, before: tuple[Bodies, Bodies], found: Strike, normal: np.ndarray) -> dict[str, float | None]:
        """By impulses and by the touching points what was asked for; by the centres of mass what follows from it."""
        if not found.approach > 0.0:
            return {"newton": None, "poisson": None, "newton_at_contact": None}
        closing = float(normal @ (before[0].velocity - before[1].velocity))
        parting = float(normal @ (found.second.velocity - found.first.velocity))
        newton = parting / closing if closing > 0.0 else None
        return {"newton": newton, "poisson": self.restitution, "newton_at_contact": self.restitution}


def _velocities(scene: Scene, found: Strike) -> dict[str, Any]:
    """Scalars on an axis, vectors and spins in space."""
    parts = {"impactor": found.first, "target": found.second}
    if scene.normal is None:
        return {f"{name}_velocity": float(body.velocity[0]) for name, body in parts.items()}
    velocities = {f"{name}_velocity": tuple(body.velocity.tolist()) for name, body in parts.items()}
    return velocities | {f"{name}_spin": tuple(body.spin.tolist()) for name, body in parts.items()}


def _energy(before: tuple[Bodies, Bodies], found: Strike) -> dict[str, float]:
    return {
        "initial": float(sum(kinetic_energy(body) for body in before)),
        "impactor": float(kinetic_energy(found.first)),
        "target_rigid": float(kinetic_energy(found.second)),
        "target_vibration": 0.0,
        "local": 0.0,
        "dissipated": float(found.lost),
    }


def _diagnostics(
    before: tuple[Bodies, Bodies], found: Strike, normal: np.ndarray, energy: dict[str, float]
) -> dict[str, Any]:
    """Residuals relative to what there was: of energy, of momentum, of angular momentum about the point of impact."""
    momentum, angular = (float(np.linalg.norm(gained)) for gained in residuals(before, found, normal))
    push = turn = float(found.impulse)
    for body in before:
        mass = 0.0 if np.isinf(body.mass) else float(body.mass)
        arm, speed, spin = (float(np.linalg.norm(v)) for v in (body.centre, body.velocity, body.spin))
        push += mass * speed
        turn += mass * arm * speed + float(np.abs(body.inertia).max()) * spin + float(found.impulse) * arm
    split = sum(value for name, value in energy.items() if name != "initial")
    errors = {
        "energy_error": (split - energy["initial"]) / (energy["initial"] or 1.0),
        "momentum_error": momentum / (push or 1.0),
        "angular_momentum_error": angular / (turn or 1.0),
    }
    return errors | {"steps": 0, "estimated_error": max(map(abs, errors.values()))}


def _unknown(scene: Scene) -> dict[str, None]:
    """Where waves run, a rigid body cannot tell how wrong it is."""
    return {"estimated_error": None} if _rings(scene) else {}


def _rings(scene: Scene) -> bool:
    return any(getattr(body, "time_unit", None) for body in (scene.impactor, scene.target))


def _notes(scene: Scene, before: tuple[Bodies, Bodies], approached: bool) -> list[str]:
    notes = [] if approached else ["The bodies move apart: no impact."]
    if _rings(scene):
        notes.append("Rigid bodies know no waves: how far the answer is off only 'waves' or 'modal' can tell.")
    for name, body in zip(("impactor", "target"), before, strict=True):
        beside = np.linalg.norm(np.cross(body.centre, scene.normal or ALONG)) > 0.0
        if beside and not np.any(body.inertia):
            notes.append(
                f"The {name} is struck beside its centre of mass, but has no inertia: it is taken as a point mass, "
                "which does not turn. Give its inertia if it can turn."
            )
        if scene.normal is not None and not getattr(getattr(scene, name), "is_possible", True):
            notes.append(
                f"The {name} has a principal moment of inertia greater than the sum of the other two, which no real "
                "body has. That is right only if nothing turns out of one plane; or else check its inertia."
            )
    return notes


def _motion(before: tuple[Bodies, Bodies], found: Strike, duration: float) -> SampledMotion:
    """On an axis: straight on before and after, with the jump at time zero."""
    first, second = (
        np.array([old.velocity[0], new.velocity[0], new.velocity[0]])
        for old, new in zip(before, (found.first, found.second), strict=True)
    )
    instants = np.array([0.0, 0.0, duration])
    energy, still = _energy(before, found), {"dissipated": 0.0}
    started = {"impactor": float(kinetic_energy(before[0])), "target_rigid": float(kinetic_energy(before[1]))} | still
    return SampledMotion(
        time=instants,
        force=np.zeros(3),  # the blow has no duration: all of it is in the impulse
        impulse=float(found.impulse) * np.array([0.0, 1.0, 1.0]),
        impactor_position=instants * first,
        impactor_velocity=first,
        end_position=instants * second,
        end_velocity=second,
        rigid_velocity=second,
        energies={
            name: np.array([started.get(name, 0.0), value, value])
            for name, value in energy.items()
            if name != "initial"
        },
    )
