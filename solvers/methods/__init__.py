"""One file each; a method knows no other method."""

from .modal import Modal
from .waves import Waves

METHODS = {method.NAME: method for method in (Waves, Modal)}

__all__ = ["METHODS", "Modal", "Waves"]
