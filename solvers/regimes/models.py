"""What regimes are measured on: families of scenes by dimensionless groups, models, figures and their errors."""

import math
from typing import Any

import numpy as np

from ..accuracy.reference import rebound
from ..bodies import Bending, Rod
from ..contact import Hertz, Linear
from ..contact.protocol import Damped
from ..methods import Modal, QuasiStatic, RigidImpulse
from ..methods.base import Method
from ..numerics.collisions import duration_of_power
from ..scene import Scene
from ..solution.solution import Solution, apparent_time

QUESTIONS = ("final-velocities", "peak-force", "contact-times", "stresses")
RODS = ("fixed-rod", "free-rod")
BEAMS = ("cantilever", "pinned-pinned", "clamped-clamped", "free-free")
LAWS = ("linear", "hertz")
MODELS: dict[str, Method] = {  # from the smallest up; below what each family is measured by
    "rigid-impulse": RigidImpulse(),
    "local-quasi-static": QuasiStatic(model="local"),
    "structural-quasi-static": QuasiStatic(model="structural"),
}
LOSSES = {  # laws that lose energy, by how much: restitution of two rigid bodies, or speed over that of first yield
    "hunt-crossley": (0.75, 0.4, 0.15),
    "plastic-linear": (4.0, 40.0, 400.0),
}
PLACES, INSTANTS = 9, 1_000  # at which stress is looked for
LENGTH, SIDE, YOUNG, DENSITY = 0.3, 0.03, 210e9, 7900.0  # of the measured bodies; errors do not depend on them


def family_of(scene: Scene) -> str | None:
    """The measured family to which the target belongs when a compact body strikes it, or None."""
    if scene.normal is not None or not scene.impactor.free_mass:
        return None
    target = scene.target
    if target.end_mass:
        return None
    if isinstance(target, Rod) and target.support in ("fixed", "free"):
        return f"{target.support}-rod"
    if isinstance(target, Bending) and target.support in BEAMS:
        return target.support
    return None


def family_scene(
    family: str, mass_ratio: float, relative_time: float, law: str = "linear", slenderness: float = 10.0
) -> Scene:
    """A compact body on a rod's end or a beam, struck where it usually is.

    mass_ratio: target over impactor; relative_time: duration of the contact of two rigid bodies over the round trip of
    a wave, or over the period of the slowest vibration of a beam; 0: rigid contact, on rods. slenderness: length over
    depth of a beam.
    """
    rod = family in RODS
    height = SIDE if rod else LENGTH / slenderness
    mass = DENSITY * SIDE * height * LENGTH
    target = {
        "kind": "rod" if rod else "beam",
        "length": LENGTH,
        "section": {"width": SIDE, "height": height},
        "material": {"young": YOUNG, "density": DENSITY},
        "support": family.removesuffix("-rod"),
    }
    given = {"impactor": {"mass": mass / mass_ratio, "velocity": 1.0}, "target": target, "contact": {"law": "rigid"}}
    scene = Scene.from_table(given)
    if relative_time == 0.0:
        return scene
    stiffness = _stiffness(law, scene.reduced_mass, scene.speed, relative_time * scene.time_unit)
    return scene.replace({"contact": {"law": law, "stiffness": stiffness}})


def lossy_scene(family: str, mass_ratio: float, relative_time: float, law: str, loss: float) -> Scene:
    """The same under a law of `LOSSES`, with the contact of two rigid bodies as long as asked for, losses and all."""
    found = elastic = family_scene(family, mass_ratio, relative_time, "hertz")
    stiffness, wanted = elastic.contact.stiffness, relative_time * elastic.time_unit
    for _ in range(2):  # at the same loss the duration goes with stiffness^(-2/5)
        contact = {"law": law, "stiffness": stiffness}
        if law == "hunt-crossley":
            contact["restitution"] = loss
        else:
            energy = elastic.reduced_mass * (elastic.speed / loss) ** 2
            contact["yield_indentation"] = (1.25 * energy / stiffness) ** 0.4
        found = elastic.replace({"contact": contact})
        stiffness *= (contact_duration(found) / wanted) ** 2.5
    return found


def models_of(scene: Scene) -> dict[str, Method]:
    """The cheap models for a scene: an impulse with the restitution that a law with damping delivers."""
    if not isinstance(scene.contact, Damped):
        return MODELS
    delivered = scene.contact.delivered(scene.reduced_mass, scene.speed)
    return MODELS | {"rigid-impulse": RigidImpulse(restitution=delivered)}


def _stiffness(law: str, mass: float, speed: float, duration: float) -> float:
    """With which two rigid bodies touch for so long [s]."""
    exponent = 1.5 if law == "hertz" else 1.0
    deepest = duration * speed / duration_of_power(exponent)
    return 0.5 * (exponent + 1.0) * mass * speed**2 / deepest ** (exponent + 1.0)


def contact_duration(scene: Scene) -> float:
    """Of two rigid bodies under the law that acts [s]; 0 for a rigid contact."""
    law, mass, speed = scene.contact, scene.reduced_mass, scene.speed
    if law.NAME == "rigid":
        return 0.0
    if isinstance(law, (Linear, Hertz)):
        exponent = 1.0 if isinstance(law, Linear) else 1.5
        deepest = (0.5 * (exponent + 1.0) * mass * speed**2 / law.stiffness) ** (1.0 / (exponent + 1.0))
        return duration_of_power(exponent) * deepest / speed
    return QuasiStatic(model="local").solve(scene_of_rigid_bodies(scene)).contacts[0].end


def scene_of_rigid_bodies(scene: Scene) -> Scene:
    """The same law and approach, between a mass and a wall: the reduced mass strikes."""
    contact = {"law": scene.contact.NAME} | scene.contact.table(scene.speed)
    impactor = {"mass": scene.reduced_mass, "velocity": scene.speed}
    return Scene.from_table({"impactor": impactor, "target": {"kind": "stop"}, "contact": contact})


def figures(solution: Solution, stresses: bool = True) -> np.ndarray:
    """The answers, (4,): rebound over speed, peak force [N], apparent contact time [s], largest stress [Pa].

    NaN where the solution has none.
    """
    scene, found = solution.scene, np.full(4, np.nan)
    found[0] = rebound(solution) / scene.speed
    lasted = apparent_time(solution.contacts)
    if solution.peak_force is not None and lasted is not None:
        found[1], found[2] = solution.peak_force, lasted
        if stresses:
            found[3] = _peak_stress(solution)
    return found


def _peak_stress(solution: Solution) -> float:
    """Anywhere in the target, of either sign [Pa]; NaN in a target that moves as a whole."""
    places = np.linspace(0.0, solution.scene.target.length, PLACES)
    times = np.linspace(0.0, min(solution.duration, solution.contacts[-1].end + solution.scene.time_unit), INSTANTS)
    largest = float(np.abs(solution.known_motion.stress(times, places)).max())
    return largest if largest > 0.0 else math.nan


def errors(found: np.ndarray, true: np.ndarray) -> np.ndarray:
    """Of figures, (4,): the rebound's as a share of the speed, the others relative; infinity where there is none."""
    with np.errstate(invalid="ignore"):
        missed = np.abs(found - true)
        missed[1:] /= np.abs(true[1:])
    return np.where(np.isfinite(missed), missed, np.inf)


def model_errors(scene: Scene, true: np.ndarray) -> np.ndarray:
    """Of every model, (models, 4); infinity where a model cannot solve the scene."""
    rows = []
    for method in models_of(scene).values():
        if method.refusal(scene) is not None:
            rows.append(np.full(4, np.inf))
        else:
            rows.append(errors(figures(method.solve(scene)), true))
    return np.array(rows)


def modes_errors(scene: Scene, true: np.ndarray, counts: Any) -> np.ndarray:
    """Of `modal` with so many modes, (counts, 4)."""
    return np.array([errors(figures(Modal(modes=int(n), estimate=False).solve(scene)), true) for n in counts])
