"""All impacts of a mass on a uniform rod, by their mass ratio alone."""

from dataclasses import dataclass

import numpy as np

from .. import validation
from ..jit.kernels import kernel
from ..numerics.arrays import copy_to
from ..numerics.waves import rigid as rigid_waves
from ..numerics.waves.contact_table import ContactTable
from ..validation import SceneError, allowed

RATIO_RANGE = (1e-6, 1e6)  # beyond it the lighter body does not feel the heavier one within doubles' reach
MOST_CONTACTS = 16
PIECES, TERMS = (400, 4_000), 40  # of a history, tried in turn; 1 600 are needed at a mass ratio of 1e-6


@dataclass(frozen=True)
class MassRatioSweep:
    """What becomes of every impact of a rigid mass on a uniform rod, by mass ratio alone; all arrays (ratios,).

    Time in round trips T, velocity in the impact speed, stress in v sqrt(E rho); compression positive.
    """

    support: str
    mass_ratio: np.ndarray  # target over impactor
    contacts: np.ndarray  # how many periods of contact
    periods: np.ndarray  # (ratios, most contacts, 2) start and end of each; NaN where there is none
    rebound_velocity: np.ndarray  # of the mass
    peak_stress: np.ndarray
    restitution: np.ndarray  # by centre-of-mass velocities and by impulses: one number, as momentum is conserved
    restitution_at_contact: np.ndarray  # by the touching surfaces, as they part for the last time


def mass_ratio_sweep(support: str = "fixed", ratios: np.ndarray | None = None) -> MassRatioSweep:
    """St. Venant's problem for many mass ratios; 200 from 1/1000 to 1000 if none are given.

    Error: rounding; every ratio is solved by the event-exact kernel of `waves`. Neither the rebound nor the number of
    contacts is monotone.
    Cost: 10 to 100 microseconds a ratio on one core. `waves.stepped` with 128 steps a round trip is six times cheaper
    and counts the contacts as well, but misses the rebound from heavy rods by up to 0.27 of the speed.
    Source: thesis 4.4, 4.5 for ratios other than 1.
    """
    reflection = {"fixed": 1.0, "free": -1.0}[validation.choice("support", support, ("fixed", "free"))]
    ratios = np.geomspace(1e-3, 1e3, 200) if ratios is None else np.asarray(ratios, float)
    low, high = RATIO_RANGE
    wrong = ratios[~((ratios >= low) & (ratios <= high))] if ratios.ndim == 1 else ratios.ravel()
    if wrong.size or not ratios.size:
        got = float(wrong[0]) if wrong.size else None
        raise SceneError("ratios", got, allowed("mass-ratios", low=low, high=high))
    count, contacts = np.empty(ratios.size, np.int64), np.full((ratios.size, MOST_CONTACTS, 7), np.nan)
    for pieces in PIECES:
        sent = rigid_waves.Pieces.of(pieces, TERMS, MOST_CONTACTS)
        if _impacts(reflection, np.ascontiguousarray(ratios), sent, count, contacts):
            break
    table = ContactTable.of(contacts)
    last = table.at((np.arange(ratios.size), count - 1))
    rebound = last.velocity_after
    target = 0.0 if support == "fixed" else (1.0 - rebound) / ratios
    return MassRatioSweep(
        support=support,
        mass_ratio=ratios,
        contacts=count,
        periods=np.stack((table.start, table.end), axis=-1)[:, : count.max()],
        rebound_velocity=rebound,
        peak_stress=np.nanmax(table.peak_stress, axis=1),
        restitution=target - rebound,
        restitution_at_contact=last.face_velocity - rebound,
    )


@kernel
def _impacts(reflection, ratios, sent, count, contacts):
    """Write every impact until the bodies part for good, and say whether all were followed so far.

    sent: room for one of them; count (ratios,); contacts (ratios, most contacts, 7), to be filled with NaN before.
    """
    complete = True
    for i in range(ratios.size):
        status, _, count[i] = rigid_waves.strike(ratios[i], reflection, rigid_waves.FOREVER, sent)
        complete = complete and status == rigid_waves.PARTED
        for n in range(count[i]):
            copy_to(contacts[i, n], sent.contacts[n])
    return complete
