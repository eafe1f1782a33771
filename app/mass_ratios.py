"""What the plot over all mass ratios needs: number of contacts, their times, rebound and restitution."""

from functools import lru_cache

import numpy as np

from solvers.studies import mass_ratio_sweep


@lru_cache(maxsize=2)
def mass_ratio_data(support: str = "fixed") -> dict[str, np.ndarray]:
    """Arrays over 200 mass ratios (rod over mass) from 1/1000 to 1000, rigid contact; worked out once per process.

    `ratio`, `contacts`, `rebound` [v], `restitution`, `restitution_at_contact`, `peak_stress` [v sqrt(E rho)], and of
    every contact that any of them has `start_1`, `end_1`, `start_2` ... [T], NaN where there is none. Do not write to
    them.
    """
    found = mass_ratio_sweep(support)
    data = {
        "ratio": found.mass_ratio,
        "contacts": found.contacts,
        "rebound": found.rebound_velocity,
        "restitution": found.restitution,
        "restitution_at_contact": found.restitution_at_contact,
        "peak_stress": found.peak_stress,
    }
    for number in range(found.periods.shape[1]):
        data[f"start_{number + 1}"] = found.periods[:, number, 0]
        data[f"end_{number + 1}"] = found.periods[:, number, 1]
    for values in data.values():
        values.flags.writeable = False
    return data
