"""Keys of stored trade-offs: of what is given, and so the same on every machine."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import solvers
from solvers.accuracy import store

ULP = np.finfo(float).eps
NAMES = solvers.scene_names()


@pytest.fixture
def other_machine(monkeypatch):
    """Linear algebra and functions of arrays whose last two bits are others."""

    def off(function):
        def found(*given, **options):
            answer = function(*given, **options)
            return type(answer)(*map(moved, answer)) if isinstance(answer, tuple) else moved(answer)

        return found

    def moved(value):
        signs = np.resize([1.0, -1.0, 0.5], np.size(value)).reshape(np.shape(value))
        return value * (1.0 + 2.0 * ULP * signs) if np.ndim(value) else float(value * (1.0 + 2.0 * ULP))

    for name in ("svd", "norm"):
        monkeypatch.setattr(np.linalg, name, off(getattr(np.linalg, name)))
    for name in ("sin", "cos", "hypot"):
        monkeypatch.setattr(np, name, off(getattr(np, name)))


def test_a_scene_has_the_same_key_on_another_machine(request):
    known = {name: store.scene_key(solvers.load(name)) for name in NAMES}
    tilted = np.array(solvers.load("brick-on-floor").impactor.inertia)
    request.getfixturevalue("other_machine")
    assert not np.array_equal(solvers.load("brick-on-floor").impactor.inertia, tilted)  # it is another one
    assert {name: store.scene_key(solvers.load(name)) for name in NAMES} == known


def numbers(part: Any) -> Iterator[float]:
    for each in part.values() if isinstance(part, dict) else part if isinstance(part, (list, tuple)) else ():
        yield from numbers(each)
    if isinstance(part, (int, float)):
        yield float(part)


def moved(part: Any, given: set[float], by: float) -> Any:
    """The same table, the numbers that are not given but follow from what is moved by this relative change."""
    if isinstance(part, dict):
        return {key: moved(each, given, by) for key, each in part.items()}
    if isinstance(part, (list, tuple)):
        return [moved(each, given, by) for each in part]
    return part * (1.0 + by) if isinstance(part, float) and part not in given else part


@pytest.mark.parametrize("by", [4.0 * ULP, -4.0 * ULP])
def test_the_last_bits_of_what_follows_from_the_given_are_not_in_the_key(by, monkeypatch):
    for name in NAMES:
        scene = solvers.load(name).struck
        key, table, given = store.scene_key(scene), scene.table(), set(numbers(scene.given))
        other = moved(table, given, by)
        with monkeypatch.context() as patch:
            patch.setattr(type(scene), "table", lambda self, found=other: found)
            assert store.scene_key(scene) == key, name


@pytest.mark.parametrize("name", ["brick-on-floor", "painleve-rod"])
def test_a_body_gives_back_the_moments_and_axes_that_it_was_given(name):
    scene = solvers.load(name)
    given, written = scene.given["impactor"], scene.table()["impactor"]
    assert (written["inertia"], written["axes"]) == (given["inertia"], given["axes"])
    assert solvers.Scene.from_table(scene.table()).impactor == scene.impactor


def test_a_pulse_gives_back_the_shape_that_it_was_given():
    scene = solvers.load("pressure-bar")
    assert scene.table()["impactor"] == scene.given["impactor"]
    assert solvers.Scene.from_table(scene.table()).impactor == scene.impactor
