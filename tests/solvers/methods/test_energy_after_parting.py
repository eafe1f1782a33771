"""Once the bodies have parted the energy that is lost stays what it is, however it is read out."""

import numpy as np
import pytest

import solvers
from tests.catalog import LAWS, contact_table, struck_rod

DAMPED = [name for name, law in LAWS.items() if law.LOSSY]
ROUNDING = 1e-12  # of the energy at first: depths are differences of positions a hundred times as large, by steps


@pytest.mark.parametrize("method", ["waves", "modal", "fe-nodal", "fe-modal"])
@pytest.mark.parametrize("law", DAMPED)
def test_nothing_is_lost_or_won_after_the_bodies_have_parted(law, method):
    """Faces that a dashpot has held back come out by themselves: what they store is lost as they part."""
    scene = struck_rod(support="free", contact=contact_table(law))
    solution = solvers.solve(scene, method)
    parted = solution.contacts[-1].end
    instants = np.linspace(parted + 0.02 * (solution.duration - parted), solution.duration, 4_001)
    lost = solution.motion.energies(instants)["dissipated"] / scene.initial_energy
    assert lost[0] > 0.1 and np.ptp(lost) <= ROUNDING
