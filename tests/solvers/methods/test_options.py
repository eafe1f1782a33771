"""Options of methods in scenes: which there are, and what becomes of them when the method changes."""

import pytest

import solvers
from solvers import METHODS, SceneError
from solvers.methods.options import options_of
from tests.catalog import SCENES


def test_every_method_takes_the_options_among_its_fields_and_no_other():
    for name, method in {**METHODS, "auto": solvers.Auto}.items():
        known = set(method.read({}).table()) - {"name"}
        assert known == set(options_of(method))
        with pytest.raises(SceneError) as said:
            solvers.read_method({"name": name, "mode": 5}, SCENES["fixed-rod"])
        assert said.value.key == "method.mode"
        assert said.value.allowed == f"no such key; the keys are {', '.join(options_of(method))}"


def test_another_method_leaves_the_options_of_the_one_before():
    scene = SCENES["figure-8.1"]
    assert dict(scene.replace({"method.name": "modal"}).method) == {"name": "modal", "duration": 0.0003}
    named = scene.replace({"method.name": "modal", "method.modes": 7}).method
    assert dict(named) == {"name": "modal", "modes": 7, "duration": 0.0003}
    assert scene.replace({"method.name": "fe-nodal"}).method == scene.method
    assert scene.replace({"impactor.mass": 1.0}).method == scene.method
