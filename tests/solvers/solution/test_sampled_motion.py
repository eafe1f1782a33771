"""Histories on a grid: what is said of a target of which its method tells no places apart."""

import numpy as np
import pytest

from solvers.solution.motion import knows_field
from solvers.solution.sampled_motion import SampledMotion

TIME = np.array([0.0, 1.0, 2.0])
PLACES = np.array([0.0, 0.2, 0.3])


def without_field(mean: float) -> SampledMotion:
    """Of a face that is pushed in by 0, 1, 2 m, on a target of this mean velocity [m/s]."""
    nothing = np.zeros(3)
    names = ("force", "impulse", "impactor_position", "impactor_velocity")
    return SampledMotion(
        time=TIME,
        **dict.fromkeys(names, nothing),
        end_position=TIME,
        end_velocity=np.ones(3),
        rigid_velocity=np.full(3, mean),
        energies={},
    )


@pytest.mark.parametrize("mean", [0.0, 1.0])
def test_a_target_without_a_field_moves_as_a_whole_unless_it_is_held(mean):
    """Its wall does not go along with the struck face."""
    motion = without_field(mean)
    assert not knows_field(motion)
    np.testing.assert_array_equal(motion.displacement(TIME, PLACES), mean * np.repeat(TIME[:, None], 3, axis=1))
    np.testing.assert_array_equal(motion.velocity(TIME, PLACES), np.full((3, 3), mean))
    np.testing.assert_array_equal(motion.stress(TIME, PLACES), np.zeros((3, 3)))
