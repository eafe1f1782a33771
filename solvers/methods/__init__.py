"""One file each; a method knows no other method."""

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
]
