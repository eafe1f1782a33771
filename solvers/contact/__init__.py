"""Contact laws: one NamedTuple each, with its constants and pure functions that kernels call.

To add a law: write its class in one of the files here (or a new one) and name it in `LAWS`; scenes, sliders, tests and
the command line take it from there.
"""

from .elastic import Hertz, Linear, Rigid
from .viscous import HuntCrossley

LAWS = {law.NAME: law for law in (Rigid, Linear, Hertz, HuntCrossley)}

__all__ = ["LAWS", "Hertz", "HuntCrossley", "Linear", "Rigid"]
