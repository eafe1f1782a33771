"""Beyond its duration and its bodies no motion gives a number."""

import pickle
from copy import copy

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import SceneError
from solvers.solution.bounds import FIELDS, HISTORIES
from solvers.solution.motion import Bends, Joined
from tests.catalog import SCENES

# every kind of motion, and of body
CASES = [
    ("fixed-rod", "waves"), ("fixed-rod", "modal"), ("fixed-rod", "mode-switch"), ("fixed-rod", "fe-nodal"),
    ("fixed-rod", "fe-modal"), ("fixed-rod", "balance"), ("fixed-rod", "quasi-static"), ("split-hopkinson", "waves"),
    ("two-unequal-rods", "waves"), ("hammer-on-cantilever", "modal"), ("bent-rods", "modal"), ("four-bar-moves", None),
]  # fmt: skip


@pytest.fixture(scope="module", params=CASES, ids=lambda case: "-".join(map(str, case)))
def solution(request):
    name, method = request.param
    return solvers.solve(SCENES[name], **({} if method is None else {"method": method}))


def asked(solution, time, x, **how):
    """By name, all that the motion tells of these instants and places."""
    motion = solution.known_motion
    for name in (*HISTORIES, *FIELDS):
        if hasattr(motion, name) and (name not in ("moment", "shear") or solution.scene.target.bends):
            yield name, lambda name=name: getattr(motion, name)(time, *([x] if name in FIELDS else []), **how)


def test_instants_before_and_after_it_are_refused(solution):
    x = np.array([0.5 * solution.scene.target.length])
    for wrong in (-1.0, -1e-3 * solution.duration, 1.001 * solution.duration, np.nan):
        for name, ask in asked(solution, np.array([0.0, wrong]), x):
            with pytest.raises(SceneError, match=r"time: got .*; allowed: a number from 0 to"):
                ask()
                pytest.fail(name)


def test_places_outside_the_bodies_are_refused(solution):
    time, length = np.array([0.5 * solution.duration]), solution.scene.target.length
    for wrong in (1.001 * length, 1e3 * length, -1e3 * length, np.nan):
        for name in FIELDS[: 5 if solution.scene.target.bends else 3]:
            with pytest.raises(SceneError, match=r"x: got .*; allowed: a number from"):
                getattr(solution.known_motion, name)(time, np.array([0.0, wrong]))
                pytest.fail(name)


def test_they_are_nan_where_that_is_asked_for_and_the_others_as_they_are(solution):
    time = np.array([-1.0, 0.4 * solution.duration, 2.0 * solution.duration])
    x = np.array([0.3, 7.0]) * solution.scene.target.length
    plain = dict(asked(solution, time[1:2], x[:1]))
    for name, ask in asked(solution, time, x, outside="nan"):
        found, inside = ask(), plain[name]()
        for part in found if isinstance(found, dict) else [None]:
            values, true = (found, inside) if part is None else (found[part], inside[part])
            known = np.isfinite(values)
            assert known.sum() == 1 and values[known][0] == approx(np.ravel(true)[0]), name


def test_it_stays_what_it_is(solution):
    motion = solution.known_motion
    for other in (copy(motion), pickle.loads(pickle.dumps(solution)).known_motion):
        assert type(other) is type(motion)
        assert isinstance(other, Bends) == isinstance(motion, Bends)
        assert isinstance(other, Joined) == isinstance(motion, Joined)
        with pytest.raises(SceneError, match="time: got"):
            other.force(np.array([2.0 * solution.duration]))


def test_what_is_drawn_and_saved_lies_inside(solution):
    data = solution.dataset()
    assert np.isfinite(data.stress.values).all()
    with pytest.raises(SceneError, match="x: got"):
        solution.dataset(x=[1.5 * solution.scene.target.length])
    with pytest.raises(SceneError, match="outside: got 'nothing'; allowed: 'refuse', 'nan'"):
        solution.known_motion.force(np.zeros(1), outside="nothing")
