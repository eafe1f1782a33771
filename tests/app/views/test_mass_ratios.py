"""The data of the plot over all mass ratios."""

import numpy as np
import pytest

from app.views.mass_ratios import mass_ratio_data


@pytest.mark.parametrize("support, contacts", [("fixed", 2), ("free", 1)])
def test_data_for_the_plot(support, contacts):
    data = mass_ratio_data(support)
    assert all(values.shape == (200,) for values in data.values())
    assert {f"start_{contacts}", f"end_{contacts}"} <= set(data) and f"start_{contacts + 1}" not in data
    touching = ~np.isnan(data[f"end_{contacts}"])
    assert (data["contacts"][touching] == contacts).all()
    assert mass_ratio_data(support) is data
    with pytest.raises(ValueError, match="read-only"):
        data["rebound"][0] = 0.0
