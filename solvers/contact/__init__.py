"""Contact laws: one NamedTuple each, with its constants and pure functions that kernels call.

To add a law: write its class in one of the files here (or a new one) and name it in `LAWS`; scenes, tests and the
command line take it from there.
"""

from .elastic import Hertz, Linear, Power, Rigid
from .plastic import PlasticLinear, PlasticPower, YigitChristoforou
from .viscous import HuntCrossley, KelvinVoigt, LankaraniNikravesh, LeeWang

_ALL = (
    Rigid,
    Linear,
    Hertz,
    Power,
    KelvinVoigt,
    LeeWang,
    HuntCrossley,
    LankaraniNikravesh,
    YigitChristoforou,
    PlasticLinear,
    PlasticPower,
)
LAWS = {law.NAME: law for law in _ALL}

__all__ = ["LAWS", *(law.__name__ for law in _ALL)]  # pyright: ignore[reportUnsupportedDunderAll]
