"""Built-in scenes by name, and scene files that can and cannot be used."""

import inspect
import json
import tomllib

import pytest
import xarray
from pytest import approx

import solvers
from solvers import Scene, SceneError
from tests.catalog import SCENES


def test_the_built_in_scenes():
    names = solvers.scene_names()
    plain = [name for name in names if not name.startswith(("figure-", "table-"))]
    assert names[0] == "fixed-rod" and names[: len(plain)] == plain and plain[1:] == sorted(plain[1:])
    assert (
        names.index("figure-4.9") < names.index("figure-4.10") < names.index("table-6.2") < names.index("figure-10.2")
    )
    for scene in SCENES.values():
        assert scene.title and scene.source
    # thesis 4.5 and 5.3: equal masses
    assert SCENES["fixed-rod"].mass_ratio == approx(1.0, rel=1e-15)
    assert SCENES["free-rod"].mass_ratio == approx(1.0, rel=1e-15)
    assert SCENES["fixed-rod"].target.round_trip_time == approx(1.1637378202523601e-4, rel=1e-15)  # (4.10)


@pytest.mark.parametrize("name", ["fixed-rod", "free-rod", "bronze-rod-steel-ball"])
def test_both_methods_for_a_struck_rod_agree(name):
    answers = [solvers.solve(SCENES[name], method=method).impactor_velocity for method in ("waves", "modal")]
    # rigid contact with the default 50 modes: 0.45 %
    assert answers[0] == approx(answers[1], abs=0.005 * SCENES[name].impactor.velocity)


TOML = """
title = "From a file"
[impactor]
mass = 1.0
velocity = 2.0
[target]
length = 1.0
section = { radius = 0.01 }
material = "steel"
"""


def test_load_a_file(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(TOML)
    assert solvers.load(path) == solvers.load(str(path)) == Scene.from_table(tomllib.loads(TOML))


@pytest.mark.parametrize(
    "content",
    [
        TOML[:-3].encode(),  # truncated inside a word
        TOML[:60].encode(),
        b"",
        b"\x00\x01\x02\xff\xfe",
        b"title = 'caf\xe9'",
        b"\x89PNG\r\n\x1a\n" + bytes(range(256)),
        TOML.encode() + b"[impactor]\n",  # a table given twice
        b"a = " + b"[" * 50_000,
        b"a = " + b"[" * 300 + b"]" * 300,
        b"a" + b".a" * 10_000 + b" = 1",  # tables in tables, which the reader of TOML does not refuse
        b"contact" + b".a" * 10_000 + b" = 1",
        b"a = " + b"9" * 5_000,
        b"[impactor]\nmass = 0x" + b"f" * 10_000,
        b"title = '" + b"x" * 200_000 + b"'",
        b"a = 1979-05-27T07:32:00Z",
        TOML.replace("1.0", "nan", 1).encode(),
        TOML.replace("1.0", "1e999", 1).encode(),
    ],
    ids=lambda content: repr(content[:18]),
)
def test_files_that_cannot_be_used(tmp_path, content):
    path = tmp_path / "scene.toml"
    path.write_bytes(content)
    with pytest.raises(SceneError) as refused:
        solvers.load(path)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "name", ["", ".", "..", "no-such-scene", "fixed-rod.toml", "a\0b", "x" * 300, "y/" * 3000, "/", "~"]
)
def test_files_that_do_not_exist(name):
    with pytest.raises(SceneError) as refused:
        solvers.load(name)
    assert refused.value.key == "scene"
    assert "fixed-rod" in refused.value.allowed or "file" in refused.value.allowed


NEEDED = {  # besides the scene
    "sweep": {"values": [1.0], "key": "impactor.mass"},
    "seek": {"key": "impactor.mass", "between": (1.0, 2.0), "such_that": {"peak_force": 1.0}},
    "contour": {
        "between": {"impactor.mass": (1.0, 2.0), "impactor.velocity": (1.0, 2.0)},
        "such_that": {"peak_force": 1.0},
    },
    "study": {"vary": {"impactor.mass": [1.0]}},
    "uncertain": {"tolerances": {"impactor.mass": "5%"}},
    "optimise": {"vary": {"impactor.mass": (1.0, 2.0)}, "minimise": "peak_force"},
    "pareto": {"vary": {"impactor.mass": (1.0, 2.0)}, "goals": {"peak_force": "smallest", "newton": "largest"}},
}
TAKE_SCENES = {
    name: NEEDED.get(name, {})
    for name in solvers.__all__
    if inspect.isfunction(getattr(solvers, name))
    and {"scene", "scenes"} & {next(iter(inspect.signature(getattr(solvers, name)).parameters), "")}
}


@pytest.mark.parametrize("form", [{}, {"format": "NETCDF3_64BIT"}])
@pytest.mark.parametrize("name", ["impact.nc", "impact.toml"])
def test_a_file_of_results_is_no_scene_and_says_where_its_scene_is(tmp_path, form, name):
    scene, path = solvers.load("fixed-rod"), tmp_path / name
    solvers.solve(scene).dataset().to_netcdf(path, engine="scipy", **form)
    with pytest.raises(SceneError) as refused:
        solvers.load(path)
    assert refused.value.reason.code == "allowed.scene-not-results"
    assert str(refused.value).endswith("Scene.from_table(json.loads(xarray.open_dataset(path).scene))")
    with xarray.open_dataset(path) as data:
        assert Scene.from_table(json.loads(data.scene)) == scene


def test_every_function_of_scenes_is_among_them():
    assert {"solve", "solve_many", "plan", "tradeoff", "convergence", "sweep", "ensemble"} < TAKE_SCENES.keys()


@pytest.mark.parametrize("name", TAKE_SCENES)
def test_where_a_scene_is_taken_a_name_is_and_an_unknown_one_is_refused_by_key(name):
    function, given = getattr(solvers, name), TAKE_SCENES[name]
    with pytest.raises(SceneError, match=r"^scene: got 'fixed-rot'; allowed: .* near: .*fixed-rod.*; impact scenes"):
        function("fixed-rot", **given)
    for wrong in (3, None, {"target": {}}):
        with pytest.raises(SceneError, match=r"^scene: got .*; allowed: a scene file, or a built-in one: fixed-rod"):
            function([wrong] if name == "solve_many" else wrong, **given)


def test_a_name_gives_what_its_scene_gives(tmp_path):
    scene, path = solvers.load("fixed-rod"), tmp_path / "scene.toml"
    path.write_text(TOML)
    own = solvers.solve(scene).table()
    for found in (solvers.solve("fixed-rod"), solvers.Waves().solve("fixed-rod")):
        assert found.table()["contacts"] == own["contacts"]
    assert solvers.solve(path).scene == solvers.load(path)
    assert solvers.usual_method("fixed-rod") == "waves"
    assert solvers.read_method({}, "fixed-rod")[0] == solvers.Waves()
    assert solvers.plan("hammer-on-cantilever").table() == solvers.plan(SCENES["hammer-on-cantilever"]).table()
    many = solvers.solve_many("fixed-rod", {"impactor.mass": [1.0, 2.0]})
    assert many.impulse.tolist() == solvers.solve_many(scene, {"impactor.mass": [1.0, 2.0]}).impulse.tolist()
    rows = solvers.sweep("fixed-rod", "impactor.mass", [1.0, 2.0])
    assert [row["impulse"] for row in rows] == many.impulse.tolist()
    both = solvers.solve_many(["fixed-rod", SCENES["free-rod"]])
    assert both.impulse[0] == solvers.solve("fixed-rod").impulse


def test_methods_to_compare_are_refused_by_key():
    with pytest.raises(SceneError, match=r"^methods: got 'waves!'; allowed: .*'modal'"):
        solvers.compare("fixed-rod", ["waves!"])
