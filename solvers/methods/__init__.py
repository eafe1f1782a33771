"""One file each; a method knows no other method."""

from .modal import Modal
from .rigid import RigidImpulse
from .waves import Waves

METHODS = {method.NAME: method for method in (Waves, Modal, RigidImpulse)}

__all__ = ["METHODS", "Modal", "RigidImpulse", "Waves"]
