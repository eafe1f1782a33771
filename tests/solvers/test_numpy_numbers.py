"""NumPy's numbers are numbers wherever Python's are, and what is written back holds Python's."""

import json

import numpy as np
import pytest

import solvers
from solvers import Scene, SceneError
from solvers.accuracy.auto import Auto
from solvers.bodies import Pulse
from solvers.contact import Linear
from solvers.studies.sweep import spaced
from solvers.validation import flag, number, whole_number
from tests.catalog import STEEL_ROD, contact_table
from tests.solvers.plain_scene import PLAIN, with_value

WHOLE = [np.int64(2), np.uint8(2), np.int32(2), np.array(2), np.arange(5)[2]]
REALS = [*WHOLE, np.float64(2.0), np.float32(2.0), np.float16(2.0), np.longdouble(2.0), np.array(2.0)]


def name(value):
    return f"{type(value).__name__}-{value.dtype}"


def python_only(value) -> bool:
    """Whether nothing in tables within tables and lists is NumPy's."""
    if isinstance(value, dict):
        return all(python_only(each) for each in (*value, *value.values()))
    if isinstance(value, list | tuple):
        return all(python_only(each) for each in value)
    return value is None or type(value) in (bool, int, float, str)


@pytest.mark.parametrize("value", REALS, ids=name)
def test_numbers(value):
    found = number("key", value, 0.0, 10.0)
    assert type(found) is float and found == 2.0


@pytest.mark.parametrize("value", WHOLE, ids=name)
def test_whole_numbers(value):
    found = whole_number("key", value, 0, 10)
    assert type(found) is int and found == 2


@pytest.mark.parametrize("value", [True, np.bool_(True), np.array(True)])
def test_flags(value):
    assert flag("key", value) is True


@pytest.mark.parametrize("value", [np.bool_(True), np.array([2.0]), np.complex128(2.0), np.str_("2"), np.nan, np.inf])
def test_what_is_no_number_is_refused_all_the_same(value):
    with pytest.raises(SceneError):
        number("key", value, 0.0, 10.0)
    with pytest.raises(SceneError):
        whole_number("key", value, 0, 10)


def test_a_fraction_is_no_whole_number_and_a_number_no_flag():
    for value in (np.float64(2.0), np.float32(2.0), np.array(2.0)):
        with pytest.raises(SceneError):
            whole_number("key", value, 0, 10)
    for value in (np.int64(1), np.array(0), np.str_("true")):
        with pytest.raises(SceneError):
            flag("key", value)


@pytest.mark.parametrize("value", REALS, ids=name)
@pytest.mark.parametrize("key", ["impactor.mass", "impactor.velocity", "target.length", "target.section.width"])
def test_a_scene_of_them_is_that_of_pythons(key, value):
    section = {"width": 3.0, "height": 3.0}
    plain = with_value("target", STEEL_ROD | {"section": section})
    scene = Scene.from_table(plain).replace({key: value})
    expected = Scene.from_table(plain).replace({key: 2.0})
    assert scene == expected
    for table in (scene.table(), dict(scene.given)):
        assert python_only(table)
        assert json.loads(json.dumps(table)) == table


def test_a_refusal_shows_a_plain_number():
    with pytest.raises(SceneError, match=r"impactor.mass: got -1.0; allowed"):
        Scene.from_table(with_value("impactor.mass", np.float64(-1.0)))


def test_lists_may_be_arrays():
    mechanism = solvers.load("four-bar")
    table = mechanism.table()
    table["target"]["links"] = [
        {key: np.array(value) if isinstance(value, list) else value for key, value in link.items()}
        for link in table["target"]["links"]
    ]
    assert Scene.from_table(table) == Scene.from_table(mechanism.table())
    points = np.array([[0.0, 1e3], [1e-5, 2e3]])
    pulse = Scene.from_table({"impactor": {"kind": "pulse", "points": points}, "target": STEEL_ROD}).impactor
    assert isinstance(pulse, Pulse) and pulse.table()["points"] == points.tolist() and python_only(pulse.table())


def test_options_of_methods():
    scene = Scene.from_table(PLAIN | {"contact": contact_table("linear")})
    for options in ({"modes": np.int64(20)}, {"modes": np.array(20), "residual": np.bool_(False)}):
        plain = {key: value.item() for key, value in options.items()}
        found = solvers.solve(scene, "modal", **options)
        assert found.method == solvers.solve(scene, "modal", **plain).method and python_only(found.method)
    assert python_only(solvers.Modal(modes=np.int64(20)).table())
    assert Auto.read({"tolerance": np.float32(0.5)}).tolerance == 0.5
    within = scene.replace({"method.name": "modal", "method.modes": np.int64(7)})
    assert python_only(within.table()) and solvers.solve(within).method["modes"] == 7


def test_a_duration():
    scene = Scene.from_table(PLAIN)
    assert solvers.solve(scene, duration=np.float64(1e-4)).duration == solvers.solve(scene, duration=1e-4).duration


def test_bodies_and_laws_made_of_them():
    """What is built without a table says of itself in Python's numbers, and its numbers are not cut to whole ones."""
    rod = Scene.from_table(PLAIN).target
    scenes = [Scene(solvers.RigidMass(kind(2.5), kind(1.5)), rod, Linear(kind(1.5e8))) for kind in (float, np.float32)]
    assert scenes[1].table() == scenes[0].table() and python_only(scenes[1].table())
    ours, theirs = (solvers.solve(scene, "waves").table() for scene in scenes)
    assert json.loads(json.dumps(theirs)) == theirs
    assert theirs["impulse"] == pytest.approx(ours["impulse"], rel=1e-6)


def test_loops_over_ranges_of_them():
    scene = Scene.from_table(PLAIN)
    rows = solvers.sweep(scene, "impactor.mass", np.array([1, 2], np.int32))
    assert rows == solvers.sweep(scene, "impactor.mass", [1.0, 2.0])
    few = solvers.sweep(scene.replace({"method.name": "modal"}), "method.modes", np.arange(2, 5))
    assert [type(row["value"]) for row in few] == [int] * 3
    figures = solvers.solve_many(scene, {"impactor.mass": np.float32([1.0, 2.0])})
    assert figures.impulse.tolist() == solvers.solve_many(scene, {"impactor.mass": [1.0, 2.0]}).impulse.tolist()
    assert spaced(1.0, 2.0, np.int64(3)).tolist() == [1.0, 1.5, 2.0]


def test_studies_and_plans():
    scene = Scene.from_table(PLAIN)
    found = solvers.convergence(scene, modes=np.arange(3, 6)).table()
    assert json.loads(json.dumps(found)) == found and found["counts"] == [3, 4, 5]
    planned = solvers.plan(scene, "peak-force", np.float32(0.25))
    assert planned.table() == solvers.plan(scene, "peak-force", 0.25).table() and python_only(planned.table())
    runs = [
        solvers.ensemble(scene, runs=count, spread=spread, seed=seed)
        for count, spread, seed in ((20, 1e-3, 1), (np.int64(20), np.float64(1e-3), np.int64(1)))
    ]
    assert python_only(runs[1].table()) and (runs[0].perturbations == runs[1].perturbations).all()
    with_law = Scene.from_table(PLAIN | {"contact": contact_table("linear")})
    charts = [
        solvers.stability(with_law, ["newmark"], grid=(three, 2), modes=modes)
        for three, modes in ((3, 4), (np.int64(3), np.int64(4)))
    ]
    assert charts[0].table()["axes"] == charts[1].table()["axes"]
    steps = np.array([58.9e-8, 29.5e-8, 9.82e-8])
    assert solvers.convergence("table-6.4", method="balance", steps=steps).counts.tolist() == steps.tolist()
