"""Built-in scenes by name, and scene files that can and cannot be used."""

import tomllib

import pytest
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
