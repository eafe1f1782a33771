"""What follows from any motion: velocities, impulse, restitution, energies and what they are off by."""

from typing import Any

import numpy as np

from ..bodies import AnyBody
from ..scene import Scene
from .motion import Motion, Pushes
from .restitution import restitution
from .solution import ContactPeriod


def summary(
    scene: Scene, motion: Motion, contacts: list[ContactPeriod], duration: float, wall_time: float
) -> dict[str, Any]:
    """What follows from any motion alone: velocities, `solvers.solution.restitution`, energies and residuals."""
    if scene.prescribed_force:
        return _summary_of_a_push(scene, motion, duration, wall_time)
    end = np.array([duration])
    together = touching(contacts, duration)
    since = 0.0 if together else duration - contacts[-1].end
    energies = {name: float(value[0]) for name, value in motion.energies(end).items()}
    fall = scene.weight_acceleration if "weight" in energies else 0.0  # some methods leave it out
    gained = fall * since  # of what flies under its weight after the last parting: figures are those of that
    known = velocities(scene, motion, contacts, duration)
    final, target_final, impulse = (known[name] for name in ("impactor_velocity", "target_velocity", "impulse"))
    if gained:
        moved = scene.impactor.mass * gained * (0.5 * gained + final)  # kinetic energy that the flight has changed
        energies |= {"impactor": energies["impactor"] - moved, "weight": energies["weight"] + moved}
    return balanced(
        scene,
        final,
        target_final,
        impulse,
        energies,
        None if together else restitution(scene, motion, contacts[-1].end, duration, fall),
        wall_time,
        scene.impactor.mass * fall * (duration - since) if fall else 0.0,
    )


def velocities(scene: Scene, motion: Motion, contacts: list[ContactPeriod], duration: float) -> dict[str, Any]:
    """Of `summary`, what takes two looks at the motion: velocities and impulse."""
    end = np.array([duration])
    impulse = float(motion.impulse(end)[0])
    if scene.prescribed_force:
        moved = 0.0 if scene.target.held else float(motion.rigid_velocity(end)[0])
        return {"impulse": impulse, "impactor_velocity": None, "target_velocity": moved}
    target = _swing(scene.target, impulse) if scene.target.swings else 0.0
    if not scene.target.held:
        target = float(motion.rigid_velocity(end)[0])
    final, fall = float(motion.impactor_velocity(end)[0]), scene.weight_acceleration
    if fall and not touching(contacts, duration) and "weight" in motion.energies(end):
        final -= fall * (duration - contacts[-1].end)
    return {"impulse": impulse, "impactor_velocity": final, "target_velocity": target}


def touching(contacts: list[ContactPeriod], duration: float) -> bool:
    """Whether the bodies are together at the end of the time solved: nothing is restored yet."""
    return contacts[-1].end >= duration * (1.0 - 1e-12)


def balanced(
    scene: Scene,
    final: float,
    target_final: float,
    impulse: float,
    energies: dict[str, float],
    restored: dict[str, float | None] | None,
    wall_time: float,
    weight: float = 0.0,
) -> dict[str, Any]:
    """The figures of `summary` from the last velocities, the impulse and the energies, with what they are off by;
    `weight`: its impulse on the impactor until then [N s]."""
    m1, m2 = scene.impactor.mass, scene.target.mass
    initial = scene.initial_energy
    lost = impulse if scene.impactor.held else m1 * (scene.impactor.velocity - final) + weight
    mismatches = [lost - impulse]
    if not scene.target.held:
        mismatches.append(m2 * (target_final - scene.target.velocity) - lost)
    return {
        "impulse": impulse,
        "impactor_velocity": final,
        "target_velocity": target_final,
        "restitution": restored or {"newton": None, "poisson": None, "newton_at_contact": None},
        "energy": {"initial": initial} | energies,
        "diagnostics": {
            "energy_error": (sum(energies.values()) - initial) / (initial or 1.0),
            "momentum_error": max(mismatches, key=abs) / (m1 * scene.speed),
            "steps": 0,
            "wall_time": wall_time,
            "estimated_error": None,
        },
    }


def _swing(beam: AnyBody, impulse: float) -> float:
    """Mean velocity [m/s] with which a beam on a pin swings on: what it vibrates has no moment about the pin."""
    known = beam.modes(1)
    return known.rigid_mean * impulse / known.rigid_mass


def _summary_of_a_push(scene: Scene, motion: Motion, duration: float, wall_time: float) -> dict[str, Any]:
    """The same for a prescribed force: nothing strikes, nothing is restored; the first energy is the work it does."""
    known, end = velocities(scene, motion, [], duration), np.array([duration])
    impulse, final, held = known["impulse"], known["target_velocity"], scene.target.held
    energies = {name: float(value[0]) for name, value in motion.energies(end).items()}
    assert isinstance(motion, Pushes)
    initial = scene.initial_energy + motion.work(duration)
    return {
        **known,
        "restitution": {"newton": None, "poisson": None, "newton_at_contact": None},
        "energy": {"initial": initial} | energies,
        "diagnostics": {
            "energy_error": (sum(energies.values()) - initial) / initial,
            "momentum_error": 0.0 if held else scene.target.mass * (final - scene.target.velocity) / impulse - 1.0,
            "steps": 0,
            "wall_time": wall_time,
            "estimated_error": None,
        },
    }
