"""What the page draws of a mechanism that is struck."""

import numpy as np
import pytest

import solvers
from app.choices.scene_of import own_choices
from app.messages.solve import solve_frame
from tests.app.messages.test_axial import arrays
from tests.catalog import SCENES

MOVING = [name for name, scene in SCENES.items() if scene.method.get("name") == "multibody"]


@pytest.mark.parametrize("name", MOVING)
def test_links_that_are_held_still_in_their_directions_are_not_shown_until_they_fly_apart(name):
    """A scene that is followed for seconds as it moves is not shown so long by a method that knows it at the impact.

    Within its impacts, of 26 ms, the tip of the four-bar goes a sixth of its size.
    """
    found = arrays(solve_frame(own_choices(name) | {"method": solvers.usual_method(solvers.load(name))}))
    points = found["linkPoints"].reshape(-1, 2)
    assert np.abs(found["linkMoves"]).max() < 0.2 * np.ptp(points, axis=0).max()
