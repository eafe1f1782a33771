"""One file each; a method knows no other method. Here it is decided which of them solves a scene that names none."""

from ..scenes.library import SceneOrName, scene_of
from .balance.method import Balance
from .base import SceneNotSupported, no_method
from .finite_elements.modal import FeModal
from .finite_elements.nodal import FeNodal
from .modal.method import Modal
from .mode_switch import ModeSwitch
from .quasi_static.method import QuasiStatic
from .rigid.method import RigidImpulse
from .waves.method import Waves

METHODS = {
    method.NAME: method for method in (Waves, Modal, ModeSwitch, FeNodal, FeModal, Balance, QuasiStatic, RigidImpulse)
}

# The first that can solve the scene is its usual method: exact ones first, rigid bodies where nothing else is left.
RINGING = ("waves", "modal", "fe-modal", "balance", "rigid")
COMPACT = ("quasi-static", "modal")  # only the contact gives way: closed forms, and modes for a mass on a spring
UNYIELDING = (
    "rigid",
    "balance",
)  # nothing gives way: a restitution has to be given, or that of a mass on a spring is taken

__all__ = [
    "METHODS",
    "Balance",
    "FeModal",
    "FeNodal",
    "Modal",
    "ModeSwitch",
    "QuasiStatic",
    "RigidImpulse",
    "Waves",
    "usual_method",
]


def usual_method(scene: SceneOrName) -> str:
    """Name of the method that solves the scene unless another is asked for.

    Raises SceneNotSupported with all the reasons if no method can.
    """
    scene = scene_of(scene)
    if any(body.time_unit is not None for body in (scene.impactor, scene.target)):
        order = RINGING
    else:
        order = UNYIELDING if scene.rigid_contact else COMPACT
    reasons = {}
    for name in order:
        reasons[name] = METHODS[name].read({}).refusal(scene)
        if reasons[name] is None:
            return name
    raise SceneNotSupported("method.name", None, no_method(reasons))
