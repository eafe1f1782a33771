"""Oscillators held together at one place, against a dense eigenvalue problem on the plane they are held in."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

from solvers.numerics.secular import held_together


def check(poles: np.ndarray, weights: np.ndarray) -> np.ndarray:
    found, vectors = held_together(poles, weights)
    size, largest = poles.size, poles.max(initial=1e-300)
    assert found.shape == (size - 1,) and np.all(np.diff(found) >= 0.0)
    assert vectors.T @ vectors == approx(np.eye(size - 1), abs=1e-12 * size)
    assert weights @ vectors / np.linalg.norm(weights) == approx(np.zeros(size - 1), abs=1e-12 * size)
    assert vectors.T @ (poles[:, None] * vectors) == approx(np.diag(found), abs=1e-12 * size * largest)
    plane = np.linalg.svd(weights[None, :])[2][1:].T
    assert found == approx(np.linalg.eigvalsh(plane.T @ (poles[:, None] * plane)), abs=1e-12 * size * largest)
    return found


@settings(max_examples=200, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(2, 30))
def test_any_oscillators(seed, size):
    """Some equal, some without a weight, some at rest, of very different weights."""
    chance = np.random.default_rng(seed)
    poles = chance.uniform(0.0, 1.0, size) ** chance.integers(1, 5)
    poles[chance.random(size) < 0.2] = 0.0
    poles = np.where(chance.random(size) < 0.3, chance.choice(poles, size), poles)
    weights = chance.normal(size=size) * 10.0 ** -chance.uniform(0.0, 8.0, size)
    weights[chance.random(size) < 0.1] = 0.0
    weights[0] = 1.0
    check(poles, weights)


def test_rods_that_are_alike():
    """Every pole stands twice: their common modes are those of each alone, and those that lie between."""
    poles = np.repeat((np.pi * np.arange(0.0, 60.0)) ** 2, 2)
    found = check(poles, np.ones(120))
    assert found[::2] == approx(poles[::2], rel=1e-12)
    assert np.all(found[1::2] > poles[1:-1:2])


@pytest.mark.parametrize("size", [2, 3, 400])
def test_low_frequencies_keep_their_digits(size):
    """Each to its own rounding, as Newton's next step shows, however much stiffer the others are."""
    poles = (np.pi * (np.arange(size) + 0.5)) ** 2
    found, _ = held_together(poles, np.ones(size))
    sums = [float((1.0 / (poles - root)).sum()) for root in found]
    slopes = [float((1.0 / (poles - root) ** 2).sum()) for root in found]
    assert np.all(np.abs(np.array(sums) / np.array(slopes)) < 1e-14 * found)
