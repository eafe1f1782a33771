"""When faces part is a smooth function of the scene, so that it can be differentiated and fitted."""

import numpy as np
import pytest

import solvers
from solvers import Scene

SHARES = np.linspace(-1.0, 1.0, 11)
CHANGE = 5e-4  # of the stiffness
# How far a polynomial of sixth degree may miss a smooth function over so small a change: its seventh term is below
# 1e-15. By a dashpot beside a spring the root of the force is known to its rounding; where powers are marched, to the
# tolerance of `waves`, as rounding decides which steps are taken.
SMOOTH = {"kelvin-voigt": 1e-11, "lee-wang": 1e-9, "hunt-crossley": 1e-9}

STEEL = {"length": 0.5, "section": {"area": 3e-4}, "material": "steel"}
RODS = {
    "fixed": {"kind": "rod", "support": "fixed", **STEEL},
    "free": {"kind": "rod", "support": "free", **STEEL},
    "chain": {
        "kind": "rods",
        "support": "free",
        "rods": [STEEL, {**STEEL, "section": {"area": 1.2e-4}, "joint": "bonded"}],
    },
}


@pytest.mark.parametrize("rods", RODS)
@pytest.mark.parametrize("restitution", [0.05, 0.3, 0.9])
@pytest.mark.parametrize("law", SMOOTH)
def test_the_last_parting_is_smooth_in_the_stiffness(law, restitution, rods):
    random = np.random.default_rng([len(law), len(rods), int(100 * restitution)])
    mass, stiffness = 10 ** random.uniform(-0.7, 0.7), 10 ** random.uniform(7.0, 9.5)
    ends, contacts = [], set()
    for share in SHARES:
        table = {
            "impactor": {"mass": mass, "velocity": 1.0},
            "contact": {"law": law, "stiffness": stiffness * (1.0 + CHANGE * share), "restitution": restitution},
            "target": RODS[rods],
        }
        solution = solvers.solve(Scene.from_table(table))
        ends.append(solution.contacts[-1].end)
        contacts.add(len(solution.contacts))
    assert len(contacts) == 1  # else another contact is the last
    missed = np.polyval(np.polyfit(SHARES, ends, 6), SHARES) - ends
    assert np.abs(missed).max() < SMOOTH[law] * ends[0]
