"""Which scenes a browser answers by itself, by the kernels that it has: the only place that says so in Python.

The browser's own word on each answer is `covers` in `app/static/wasm/answers.js`, which also knows of which choices.
"""

import math
from collections.abc import Callable, Mapping

from solvers import Balance, Beam, Modal, QuasiStatic, RigidMass, Rod, Scene, Waves, usual_method
from solvers.bodies import SpringMass, Wall, Waveguide
from solvers.contact import Rigid
from solvers.contact.duration import exponent_of
from solvers.numerics.balance_drawn import MOST_LOCATED, MOST_MODES
from solvers.numerics.waves.chain_drawn import MOST_RODS


def covered(scene: Scene) -> bool:
    """Whether some kernel of the module answers this scene as it is: none has what weight does in it."""
    return not scene.weight_acceleration and any(answers(scene) for answers in ANSWERED_BY.values())


def covered_of(scenes: Mapping[str, Scene]) -> list[str]:
    """Names of those that are."""
    return [name for name, scene in scenes.items() if covered(scene)]


def _mass_strikes(scene: Scene) -> bool:
    return isinstance(scene.impactor, RigidMass) and "height" not in scene.given.get("impactor", {})


def _on_plain_rod(scene: Scene) -> bool:
    """A mass on one uniform rod at rest, fixed or free at its far end."""
    target = scene.target
    if not _mass_strikes(scene) or not isinstance(target, Rod):
        return False
    return target.support in ("fixed", "free") and not target.end_mass and not target.velocity


def _on_rod(scene: Scene) -> bool:
    """The same by waves or modes; through a law for as long as is asked, and by modes that are all there is."""
    method, law = scene.method, not scene.rigid_contact
    name, known = method.get("name", Waves.NAME), {"name", "modes"} | ({"duration"} if law else set())
    if name == Modal.NAME and law and not method.get("residual", True):
        known |= {"residual"} | ({"frame"} if method.get("frame", "attached") == "attached" else set())
    return _on_plain_rod(scene) and (
        (name == Waves.NAME and (law or "duration" not in method)) or (name == Modal.NAME and method.keys() <= known)
    )


def _on_chain(scene: Scene) -> bool:
    """A mass or a rod on rods one behind the other, all faces rigid, by waves: but a mass on one plain rod."""
    impactor, target, method = scene.impactor, scene.target, scene.method
    striking = isinstance(impactor, Rod) and not impactor.end_mass
    if not isinstance(target, Waveguide) or not (striking or _mass_strikes(scene)):
        return False
    laws = (scene.contact, *scene.joint_laws)
    if not all(law is None or isinstance(law, Rigid) for law in laws) or _on_plain_rod(scene):
        return False
    few = len(impactor.rods) + len(target.rods) <= MOST_RODS
    known = {Waves.NAME: {"name", "duration"}, QuasiStatic.NAME: {"name", "model"}}.get(method.get("name", Waves.NAME))
    return few and known is not None and method.keys() <= known


def _on_spring(scene: Scene) -> bool:
    """The same where it is fixed and bends as a spring, beside waves."""
    method = scene.method
    if not _on_plain_rod(scene) or not scene.target.held or method.get("name") != QuasiStatic.NAME:
        return False
    shown = QuasiStatic(model=method.get("model", "auto")).model_of(scene)
    known = scene.rigid_contact or "model" in method  # by a law, which one is taken hangs on the mass
    return shown.startswith("structural") and known and method.keys() <= {"name", "model"}


def _balanced(scene: Scene) -> bool:
    """A mass balanced against a rod that is divided into a few, or against a mass on a spring with rigid faces."""
    method = scene.method
    if not (_on_plain_rod(scene) or (_mass_strikes(scene) and isinstance(scene.target, SpringMass))):
        return False
    known = method.keys() <= {"name", "variant", "elements", "modes", "restitution", "step"}
    most = {"event-located": MOST_LOCATED, "step-end": MOST_MODES}.get(method.get("variant", "event-located"), 0)
    few = method.get("modes", method.get("elements", math.inf)) <= most or not scene.target.rods
    return method.get("name", usual_method(scene)) == Balance.NAME and scene.rigid_contact and known and few


def _on_beam(scene: Scene) -> bool:
    """A mass across a beam at rest, by modes."""
    target, method = scene.target, scene.method
    if not _mass_strikes(scene) or not isinstance(target, Beam):
        return False
    still = not target.velocity and not target.acceleration and not target.swings
    by_modes = method.get("name", usual_method(scene)) == Modal.NAME
    return still and by_modes and method.keys() <= {"name", "modes", "residual", "duration"}


def _compact(scene: Scene) -> bool:
    """A mass on one at rest or on a wall, by any law but a spring."""
    target, method = scene.target, scene.method
    if not _mass_strikes(scene) or not isinstance(target, (RigidMass, Wall)) or target.velocity:
        return False
    closed = method.get("name", usual_method(scene)) == QuasiStatic.NAME and method.keys() <= {"name", "model"}
    return closed and exponent_of(scene.contact) != 1.0


ANSWERED_BY: dict[str, Callable[[Scene], bool]] = {  # by entry, as in `entries.ENTRIES`
    "rod": lambda scene: scene.rigid_contact and _on_rod(scene),
    "law": lambda scene: not scene.rigid_contact and _on_rod(scene),
    "beam": _on_beam,
    "spring": _on_spring,
    "chain": _on_chain,
    "compact": _compact,
    "balance": _balanced,
}
