"""What the browser needs of a pendulum that strikes: where it hangs, how it bends, the waves that its force sends."""

from typing import Any

import numpy as np

from solvers import Solution, Waves
from solvers.bodies import AnyBody, FlexiblePendulum, Pendulum, Pivoted
from solvers.methods.finite_elements.motion import ElementMotion
from solvers.methods.modal.motion import ModalMotion
from solvers.solution.motion import Motion

from .encoding import whole_numbers

PLACES = 25  # along a bar that bends
FORCE_POINTS = 600  # of the force whose waves are drawn
NO_PLACE = 1e-300  # [m]: its pivot, as places in the impactor are negative


def pendulum_fields(body: AnyBody) -> dict[str, float]:
    """Length of the bar, or of one of the same centre, and distances of pivot and contact; nothing of other bodies."""
    if not isinstance(body, Pivoted):
        return {}
    length = body.length if isinstance(body, FlexiblePendulum) else 2.0 * body.centre
    if isinstance(body, Pendulum) and body.bar_length is not None:
        length = body.bar_length
    return {"length": max(length, body.pivot_distance), "place": body.pivot_distance, "ownMass": body.own_mass}


def striker_arrays(name: str, solution: Solution, time: np.ndarray, length_unit: float) -> dict[str, Any]:
    """Displacements of the face that strikes, and displacements and bending moments [N m] of a bar that bends, from its
    pivot on, where the method knows them.

    Of such a bar the face is not where its turning as a whole has it.
    """
    body, motion = solution.scene.impactor, solution.known_motion
    if isinstance(body, FlexiblePendulum) and isinstance(motion, ModalMotion):
        x = np.append(np.linspace(NO_PLACE, body.length, PLACES), body.place)
        moved = motion.displacement(time, -x) / length_unit
        bent = motion.moment(time[::2], -x[:-1:2])  # fewer than are drawn as a shape
        return {
            f"{name}Mass": moved[:, -1],
            f"{name}Bar": whole_numbers(moved[:, :-1]),
            f"{name}Bend": whole_numbers(bent),
        }
    face = motion.impactor_position(time)
    if isinstance(body, FlexiblePendulum) and isinstance(motion, ElementMotion):
        face = motion.end_position(time) + np.interp(time, motion.time, motion.course.indentation)
    return {f"{name}Mass": face / length_unit}


def pivot_moments(name: str, solution: Solution, time: np.ndarray) -> dict[str, Any]:
    """Bending moments of a bar that bends as it swings [N m]: at its pivot, half way, and where it strikes,
    (instants, 3)."""
    body, motion = solution.scene.impactor, solution.known_motion
    if not isinstance(body, FlexiblePendulum) or not isinstance(motion, ModalMotion):
        return {}
    return {f"{name}Moments": whole_numbers(motion.moment(time, np.array([-NO_PLACE, -0.5 * body.place, -body.place])))}


def waves_of_force(solution: Solution) -> tuple[Motion | None, float]:
    """The waves that this contact force sends into the struck rods, and their unit over Z v."""
    time, forces = np.linspace(0.0, solution.duration, FORCE_POINTS), solution.known_motion.force
    pulse = {"kind": "pulse", "points": np.column_stack((time, forces(time))).tolist()}
    scene = solution.scene.replace({"impactor": pulse, "contact": {"law": "rigid"}, "method": {}})
    return Waves().solve(scene, solution.duration).motion, scene.speed / solution.scene.speed
