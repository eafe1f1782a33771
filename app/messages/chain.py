"""What the browser needs of an impact on rods one behind the other to follow other choices by itself: see app/wasm."""

from typing import Any

from solvers import Modal, QuasiStatic, Scene, Solution, Waves
from solvers.bodies import RigidMass, Rod, Waveguide
from solvers.contact import Rigid
from solvers.methods.base import AFTERGLOW
from solvers.methods.waves.chain_scene import ChainScene
from solvers.numerics.waves.chain_drawn import MOST_RODS

SAME = 1e-9  # [T] by which two durations may differ


def chain_fields(scene: Scene, exact: Solution, other: Solution | None) -> dict[str, Any] | None:
    """What holds at every node and its gap [v T], and for how long it is solved if that is asked [T], else 0.

    Rigid faces only: a method beside is the same at any speed then, as it is linear too. None for other impacts.
    """
    target = scene.target
    if not isinstance(target, Waveguide) or not isinstance(scene.impactor, (RigidMass, Rod)) or scene.impactor.end_mass:
        return None
    rigid = all(law is None or isinstance(law, Rigid) for law in (scene.contact, *scene.joint_laws))
    if not rigid or exact.method["name"] != Waves.NAME or _is_plain(scene) or "steps" in scene.method:
        return None
    given = ChainScene(scene)
    gaps = given.chain.gap.tolist()
    linear = other is not None and other.method["name"] in (Modal.NAME, QuasiStatic.NAME) and not any(gaps)
    if len(given.rods) > MOST_RODS or not (other is None or linear):
        return None
    return {"kinds": given.chain.kind.tolist(), "gaps": gaps, "asked": _asked(scene, exact, other)}


def _is_plain(scene: Scene) -> bool:
    """Whether a mass strikes one rod that is its own mirror: of that the browser knows more."""
    rod = scene.target.rods[0]
    alone = len(scene.target.rods) == 1 and not scene.impactor.rods
    return alone and rod.support != "anechoic" and not rod.end_mass


def _asked(scene: Scene, exact: Solution, other: Solution | None) -> float:
    trip = scene.time_unit
    shown = exact.duration / trip
    longer = other is not None and shown > exact.contacts[-1].end / trip + AFTERGLOW + SAME  # for the method beside
    return shown if longer or "duration" in scene.method else 0.0
