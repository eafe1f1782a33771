"""Contact laws: one NamedTuple each, with its constants and pure functions that kernels call.

To add a law: write its class in one of the files here (or a new one) and name it in `LAWS`; scenes, tests and the
command line take it from there.
"""

from typing import Any

from .elastic import Hertz, Linear, Power, Rigid
from .own import check_law
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
LAWS: dict[str, type[Any]] = {law.NAME: law for law in _ALL}

__all__ = ["LAWS", "check_law", *(law.__name__ for law in _ALL)]  # pyright: ignore[reportUnsupportedDunderAll]
