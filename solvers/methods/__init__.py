"""One file each; a method knows no other method."""

from collections.abc import Mapping

from .. import checks
from ..method import Method
from .balance import Balance
from .fe_modal import FeModal
from .fe_nodal import FeNodal
from .modal import Modal
from .mode_switch import ModeSwitch
from .quasi_static import QuasiStatic
from .rigid import RigidImpulse
from .waves import Waves

METHODS = {
    method.NAME: method for method in (Waves, Modal, ModeSwitch, FeNodal, FeModal, Balance, QuasiStatic, RigidImpulse)
}

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
    "read_method",
]


def read_method(given: Mapping[str, object], usual: str = "waves") -> tuple[Method, float | None]:
    """Method and duration [s] from the table `[method]` of a scene file; `usual` is the method if it names none.

    Raises SceneError naming the key.
    """
    given = dict(given)
    duration = given.pop("duration", None)
    name = checks.choice("method.name", given.pop("name", usual), METHODS)
    return METHODS[name].read(given), duration
