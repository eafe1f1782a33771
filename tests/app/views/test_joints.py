"""What the joint between two links does to waves, for the page."""

import json

import numpy as np
import pytest

from app.choices.scene_of import own_choices
from app.views.joints import FREQUENCIES, joints_data, of_joined_links
from solvers.studies.scattering import INCOMING, OUTGOING
from tests.app.sentences import sentence


def test_the_shares_are_all_of_the_power():
    found = json.loads(joints_data(own_choices("bent-rods")))
    assert found["kind"] == "revolute" and found["bend"] == pytest.approx(90.0)
    assert len(found["frequency"]) == FREQUENCIES and np.all(np.diff(found["frequency"]) > 0.0)
    for name in INCOMING:
        assert sum(np.array(found[name][out]) for out in OUTGOING) == pytest.approx(100.0, abs=1e-3)
    assert found["axial"]["reflected_bending"] == [0.0] * FREQUENCIES  # a pin passes no moment: nothing bends the first
    assert found["axial"]["transmitted_bending"][-1] > 50.0


def test_it_is_asked_where_two_links_are_joined():
    assert of_joined_links(own_choices("bent-rods")) == ("bent-rods", "")
    for scene in ("compound-pendulum", "fixed-rod", "four-bar", "slider-crank"):  # or one of the two has no section
        assert of_joined_links(own_choices(scene)) is None


def test_a_link_without_a_section_is_named():
    assert "link 'crank'" in sentence(json.loads(joints_data(own_choices("slider-crank")))["error"])
