"""Rigid bodies: one impulse without duration, in closed form or, where they rub, over the normal impulse."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...bodies import AnyBody, in_space
from ...contact.friction import MODELS
from ...numerics.rigid.friction import Rubbed
from ...numerics.rigid.impulses import Bodies, Strike, gained, kinetic_energy, strike
from ...provenance import clock
from ...scene import Scene
from ...solution.sampled_motion import SampledMotion, field_as_a_whole
from ...solution.solution import ContactPeriod, Solution
from ...text.notes import Note, Severity
from ..base import AFTERGLOW, Method
from ..options import option, real, word
from ..weight import left_out_later
from .friction import models, restored, rubbed, rubbing_notes, sliding

ALONG = (1.0, 0.0, 0.0)  # the axis on which bodies without a normal meet


@dataclass(frozen=True)
class RigidImpulse(Method):
    """Both bodies move as a whole before and after one impulse, J = (1 + e) mu v_imp without friction.

    Bodies in space with their tensors of inertia, or any bodies on an axis, where rods and chains of bonded rods count
    by their mass and what is held by a support counts as immovable; a beam counts by the mass felt where it is struck,
    1 / (1 / m + d^2 / J) at d from its centre, J / x^2 at x from its pin.
    The contact law has no say, but `restitution`; bodies in space may rub, and then `model` says what is restored: of
    the work of the normal force its share e^2 (stronge), of the normal impulse (poisson), of the normal velocity with
    the impulse of sticking cut off at the cone of friction (newton), which can make energy.
    Source: note on rigid-body impulses; thesis 3.2 and (9.1) on an axis; friction: `solvers.numerics.rigid.sliding`.
    Differs: the note has no guard against bodies that part already, J = 0, and leaves out the loss of energy,
    mu (1 - e^2) v_imp^2 / 2.
    """

    restitution: float = option(1.0, real(0.0, 1.0))
    model: str = option(MODELS[0], word(MODELS))  # of what rubs

    NAME = "rigid"
    WEIGHT = True  # which has no time to act
    SPATIAL = BEAMS = True

    def why_not(self, scene: Scene) -> Note | None:
        target = scene.target
        if target.half_swing is not None:
            return Note("refusals.mass-on-spring", Severity.REFUSAL)
        if not (scene.impactor.bonded and target.bonded):
            return Note("refusals.loose-chain-as-whole", Severity.REFUSAL)
        return None

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = clock()
        normal, method = np.array(scene.normal or ALONG), self.table()
        before = in_space(scene.impactor), in_space(scene.target)
        by_model = {}
        if scene.friction is None:
            found: Strike | Rubbed = strike(*before, normal, self.restitution)
            pushed = found.impulse * normal
            del method["model"]  # has no say
        else:
            by_model = rubbed(scene, self.restitution)
            found = by_model[self.model]
            pushed = found.impulse
        wall_time = clock() - begun
        asked = duration is not None
        duration = AFTERGLOW * scene.time_unit if duration is None else duration
        impulse = float(pushed @ normal)
        energy, force = _energy(scene, before, found), None if impulse else 0.0
        figures = {
            "impulse": impulse,
            "restitution": self._restitution(scene, before, found, normal),
            "notes": _notes(scene, before, found, impulse),
        }
        if asked:
            figures["notes"] += left_out_later(scene, scene.weight_acceleration, duration)
        if isinstance(found, Rubbed):
            figures["notes"] += rubbing_notes(scene, by_model, self.model)
            figures |= {
                "impulse": tuple(pushed.tolist()),
                "restitution": restored(scene, found),
                "sliding": sliding(scene, found),
                "models": models(scene, by_model),
            }
        return Solution(
            scene=scene,
            method=method,
            contacts=[ContactPeriod(0.0, 0.0, impulse, force)] if impulse else [],
            duration=duration,
            motion=_motion(scene, before, found, impulse, duration) if scene.normal is None else None,
            peak_force=force,
            peak_indentation=None,
            residual_indentation=None,
            energy=energy,
            diagnostics=_diagnostics(before, found, pushed, energy) | {"wall_time": wall_time} | _unknown(scene),
            effective_mass=float(found.effective_mass),
            **figures,
            **_velocities(scene, found),
        )

    def _restitution(
        self, scene: Scene, before: tuple[Bodies, Bodies], found: Strike | Rubbed, normal: np.ndarray
    ) -> dict[str, float | None]:
        """By impulses and by the touching points what was asked for; by the centres of mass what follows from it."""
        if not found.approach > 0.0:
            return {"newton": None, "poisson": None, "newton_at_contact": None}
        if scene.normal is None:
            first, second = (_wholes(scene, found)[name][-1] for name in ("impactor", "target"))
            newton = None if scene.target.swings else (second - first) / scene.speed
            return {"newton": newton, "poisson": self.restitution, "newton_at_contact": self.restitution}
        closing = float(normal @ (before[0].velocity - before[1].velocity))
        parting = float(normal @ (found.second.velocity - found.first.velocity))
        newton = parting / closing if closing > 0.0 else None
        return {"newton": newton, "poisson": self.restitution, "newton_at_contact": self.restitution}


def _velocities(scene: Scene, found: Strike | Rubbed) -> dict[str, Any]:
    """Scalars on an axis, vectors and spins in space."""
    if scene.normal is None:
        return {f"{name}_velocity": mean for name, (_, mean) in _wholes(scene, found).items()}
    parts = {"impactor": found.first, "target": found.second}
    velocities = {f"{name}_velocity": tuple(body.velocity.tolist()) for name, body in parts.items()}
    return velocities | {f"{name}_spin": tuple(body.spin.tolist()) for name, body in parts.items()}


def _wholes(scene: Scene, found: Strike | Rubbed) -> dict[str, tuple[float, float]]:
    """On an axis: velocity of the struck place and of the centre of mass, which differ where one turns."""
    wholes = {}
    for name, after in (("impactor", found.first), ("target", found.second)):
        body, struck = getattr(scene, name), after.velocity[0]
        turns = (body.bends or body.turns) and not body.fixed
        mean = body.modes(1).mean_velocity(body.velocity, struck) if turns else struck
        wholes[name] = float(struck), float(mean)
    return wholes


def _kinetic(body: AnyBody, state: Bodies) -> float:
    """Energy of a body as a whole [J]; of a beam more than that of the mass that is felt where it is struck."""
    if not body.bends:
        return float(kinetic_energy(state))
    return float(body.modes(1).moving_energy(body.mass, body.velocity, state.velocity[0]))


def _energy(scene: Scene, before: tuple[Bodies, Bodies], found: Strike | Rubbed) -> dict[str, float]:
    bodies = scene.impactor, scene.target
    return {
        "initial": float(sum(_kinetic(body, state) for body, state in zip(bodies, before, strict=True))),
        "impactor": _kinetic(scene.impactor, found.first),
        "target_rigid": _kinetic(scene.target, found.second),
        "target_vibration": 0.0,
        "local": 0.0,
        "dissipated": float(found.lost),
        **({"friction": float(found.rubbed)} if isinstance(found, Rubbed) else {}),
    }


def _diagnostics(
    before: tuple[Bodies, Bodies], found: Strike | Rubbed, pushed: np.ndarray, energy: dict[str, float]
) -> dict[str, Any]:
    """Residuals relative to what there was: of energy, of momentum, of angular momentum about the point of impact."""
    momentum, angular = (float(np.linalg.norm(each)) for each in gained(before, (found.first, found.second), pushed))
    given = float(np.linalg.norm(pushed))
    push = turn = given
    for body in before:
        mass = 0.0 if np.isinf(body.mass) else float(body.mass)
        arm, speed, spin = (float(np.linalg.norm(v)) for v in (body.centre, body.velocity, body.spin))
        push += mass * speed
        turn += mass * arm * speed + float(np.abs(body.inertia).max()) * spin + given * arm
    split = sum(value for name, value in energy.items() if name != "initial")
    # what is held and moves, as seen from a mechanism, does work
    work = sum(
        way * float(pushed @ body.velocity)
        for body, way in zip(before, (1.0, -1.0), strict=True)
        if np.isinf(body.mass)
    )
    errors = {
        "energy_error": (split - energy["initial"] - work) / (energy["initial"] or 1.0),
        "momentum_error": momentum / (push or 1.0),
        "angular_momentum_error": angular / (turn or 1.0),
    }
    return errors | {"steps": 0, "estimated_error": max(map(abs, errors.values()))}


def _unknown(scene: Scene) -> dict[str, None]:
    """Where waves run, the error of a rigid body is not known."""
    return {"estimated_error": None} if _rings(scene) else {}


def _rings(scene: Scene) -> bool:
    return any(body.time_unit is not None for body in (scene.impactor, scene.target))


def _notes(scene: Scene, before: tuple[Bodies, Bodies], found: Strike | Rubbed, impulse: float) -> list[Note]:
    notes = [] if impulse else [Note("no-impact", Severity.REMARK, parts=bool(found.approach < 0.0))]
    if _rings(scene):
        notes.append(Note("waves-ignored", Severity.WARNING, beam=scene.bends))
    for name, body in zip(("impactor", "target"), before, strict=True):
        beside = np.linalg.norm(np.cross(body.centre, scene.normal or ALONG)) > 0.0
        if beside and not np.any(body.inertia):
            notes.append(Note("no-inertia", Severity.WARNING, body=name))
    return notes


def _motion(
    scene: Scene, before: tuple[Bodies, Bodies], found: Strike | Rubbed, impulse: float, duration: float
) -> SampledMotion:
    """On an axis: straight on before and after, with the jump at time zero."""
    wholes = _wholes(scene, found)
    face, first = (np.array([scene.impactor.velocity, new, new]) for new in wholes["impactor"])
    end, second = (np.array([scene.target.velocity, new, new]) for new in wholes["target"])
    instants = np.array([0.0, 0.0, duration])
    energy = _energy(scene, before, found)
    started = {
        "impactor": _kinetic(scene.impactor, before[0]), "target_rigid": _kinetic(scene.target, before[1]),
        "dissipated": 0.0,
    }  # fmt: skip
    return SampledMotion(
        time=instants,
        force=np.zeros(3),  # the impact has no duration: all of it is in the impulse
        impulse=impulse * np.array([0.0, 1.0, 1.0]),
        impactor_position=instants * first,
        impactor_velocity=first,
        end_position=instants * end,
        end_velocity=end,
        rigid_velocity=second,
        energies={
            name: np.array([started.get(name, 0.0), value, value])
            for name, value in energy.items()
            if name != "initial"
        },
        field=field_as_a_whole(scene.target, instants, instants * end, end) if scene.target.bends else None,
        face_velocity=face,
    )
