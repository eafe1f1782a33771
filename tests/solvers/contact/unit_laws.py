"""Every contact law in units of its own, and how tests run over the laws."""

import numpy as np
import pytest
from hypothesis import strategies as st

from solvers.contact import (
    Hertz,
    HuntCrossley,
    KelvinVoigt,
    LankaraniNikravesh,
    LeeWang,
    Linear,
    PlasticLinear,
    PlasticPower,
    Power,
    YigitChristoforou,
)
from tests.catalog import LAWS, WITH_INDENTATION

EPS = np.finfo(float).eps
DEPTHS = st.floats(-12.0, 0.0).map(lambda power: 10.0**power)  # m
# in units in which stiffness and yield indentation are 1: a few times beyond yield, and beyond full flow
UNIT_LAWS = {
    "linear": Linear(1.0),
    "hertz": Hertz(1.0),
    "power": Power(1.0, 1.3),
    "kelvin-voigt": KelvinVoigt(1.0, 0.7),
    "lee-wang": LeeWang(1.0, 0.7),
    "hunt-crossley": HuntCrossley(1.0, 0.7),
    "lankarani-nikravesh": LankaraniNikravesh(1.0, 0.7),
    "yigit-christoforou": YigitChristoforou(1.0, 1.0),
    "plastic-linear": PlasticLinear(1.0, 1.0),
    "plastic-power": PlasticPower.through(1.0, 1.0, 30.0),
}
each_law = pytest.mark.parametrize("law", [LAWS[name] for name in WITH_INDENTATION], ids=WITH_INDENTATION)
each_unit_law = pytest.mark.parametrize("law", UNIT_LAWS.values(), ids=UNIT_LAWS)
