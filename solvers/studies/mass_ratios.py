"""All impacts of a mass on a uniform rod, by their mass ratio alone."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import validation
from ..jit.kernels import kernel
from ..numerics.arrays import copy_to
from ..numerics.waves import rigid as rigid_waves
from ..numerics.waves.contact_table import ContactTable
from ..validation import SceneError, allowed
from .figures import Columns

RATIO_RANGE = (1e-6, 1e6)  # beyond it the lighter body does not feel the heavier one within doubles' reach
MOST_CONTACTS = 16
PIECES, TERMS = (400, 4_000), 40  # of a history, tried in turn; 1 600 are needed at a mass ratio of 1e-6


@dataclass(frozen=True, repr=False)
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

    def figures(self) -> Columns:
        """The same as columns over `mass_ratio`, the periods as `start_1`, `end_1` and so on."""
        names = ("contacts", "rebound_velocity", "peak_stress", "restitution", "restitution_at_contact")
        columns = {name: getattr(self, name) for name in names}
        units = {"rebound_velocity": "v", "peak_stress": "v sqrt(E rho)"}
        for number in range(self.periods.shape[1]):
            for place, edge in enumerate(("start", "end")):
                columns[f"{edge}_{number + 1}"] = self.periods[:, number, place]
                units[f"{edge}_{number + 1}"] = "T"
        kinds = {name: units.get(name, "") for name in columns}
        return Columns(columns, kinds, {"mass_ratio": self.mass_ratio}, {"mass_ratio": ""})

    def dataset(self) -> Any:
        """An xarray.Dataset over the mass ratio. Raises ImportError without the extra `notebook`."""
        return self.figures().dataset().assign_attrs(support=self.support)

    def plot(self, what: str = "rebound_velocity") -> Any:
        """A HoloViews object: one column over the mass ratio. Raises SceneError for another word."""
        return self.figures().plot(what)

    def __str__(self) -> str:
        return str(self.figures())

    def __repr__(self) -> str:
        return f"<MassRatioSweep of {self.mass_ratio.size} mass ratios, {self.support} rod>"

    def _repr_html_(self) -> str:
        return self.figures()._repr_html_()


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
