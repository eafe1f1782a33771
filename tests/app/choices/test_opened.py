"""How scenes are opened: their table `[view]`, with refusals by key."""

import re
from pathlib import Path

import pytest

import app
import solvers
from app.choices.choices import SCENES, Choices
from app.choices.opened import CHARTS, Opening, opening_of
from app.text.catalogues import page
from solvers import SceneError
from solvers.text.catalogue import SOURCE

STATIC = Path(app.__file__).parent / "static"


def test_every_scene_is_opened_by_what_there_is():
    texts = page(SOURCE).texts
    for name in SCENES:
        opening = opening_of(name)
        assert all(f"compare.question.{each.question}" in texts for each in opening.comparisons), name
        assert all(f"opening.what-if.{each.say}" in texts for each in opening.trials), name
    assert opening_of("figure-6.9").charts == ("reactions",) and opening_of("figure-6.9").until == 1e-3
    assert opening_of("figure-8.7").time == 2e-5
    assert opening_of("free-rod").trials == (("fixed", "scene", "fixed-rod"),)
    assert opening_of("no such scene") == Opening()
    assert opening_of("table-6.9").charts == ("coordinates",) and opening_of("table-6.9").table()["charts"] == []


@pytest.mark.parametrize(
    "name, tab",
    [
        ("figure-4.12", "charts"),
        ("table-6.9", "analysis"),
        ("figure-7.5", "numbers"),
        ("bouncing-ball", None),
        ("fixed-rod", None),
    ],
)
def test_the_dock_opens_on_what_a_scene_is_about(name, tab):
    assert opening_of(name).table()["tab"] == tab


def test_charts_have_the_names_of_the_stacks():
    drawn = "".join((STATIC / kind / "view.js").read_text() for kind in ("axial", "beam", "mechanism", "space"))
    for name in CHARTS:
        assert re.search(rf"\b{name}\b", drawn), name


@pytest.mark.parametrize(
    "view, said",
    [
        ({"chart": ["force"]}, r"view\.chart: got .*no such key; the keys are charts"),
        ({"charts": "force"}, r"view\.charts: got 'force'; allowed: a list of at most 20 entries"),
        ({"charts": ["force", "forces"]}, r"view\.charts\[2\]: got 'forces'; allowed: 'waves'"),
        ({"place": -1.0}, r"view\.place: got -1.0; allowed: a number from 0"),
        ({"time": -1e-6}, r"view\.time: got -1e-06; allowed: a number from 0"),
        ({"read": "colour"}, r"view\.read: got 'colour'; allowed: 'stress'"),
        ({"tab": "graphs"}, r"view\.tab: got 'graphs'; allowed: 'picture'"),
        ({"until": "soon"}, r"view\.until: got 'soon'; allowed: a number from 0"),
        ({"vary": {"modes": [1.0], "step": [1.0]}}, r"view\.vary"),
        ({"vary": {"mass": [1.0]}}, r"view\.vary\.mass"),
        ({"compare": [{"question": "across", "first": {"mode": 8}}]}, r"view\.compare\[1\]\.first\.mode"),
        ({"compare": [{"question": "across", "first": {"modes": 0}}]}, r"view\.compare\[1\]\.first\.modes.*got 0"),
        ({"compare": [{"first": {"modes": 8}}]}, r"view\.compare\[1\]\.question"),
        ({"try": [{"say": "free", "choice": "mass", "value": 1.0}]}, r"view\.try\[1\]\.choice: got 'mass'"),
        ({"try": [{"say": "free", "choice": "modes", "value": 0.5}]}, r"view\.try\[1\]\.value"),
        ({"try": [1]}, r"view\.try\[1\]"),
        (
            {"try": [{"say": "free", "choice": "speed", "value": 999.0}]},
            r"got 999.0; allowed: a number from 0.01",
        ),
        ({"try": [{"say": "free", "choice": "law", "value": "glue"}]}, r"got 'glue'; allowed: 'rigid', "),
    ],
)
def test_what_cannot_be_opened_is_refused_by_its_key(view, said):
    scene = solvers.load("fixed-rod").replace({"view": view})
    with pytest.raises(SceneError, match=said):
        Opening.of(scene)


def test_a_view_is_a_part_of_the_scene_and_changes_nothing_else():
    scene = solvers.load("figure-6.9")
    assert scene.view["charts"] == ["reactions"] and scene.replace({"target.links.1.modes": 5}).view == scene.view
    assert "view" not in scene.table()  # which says what happens
    assert scene == scene.replace({"view": {}}) and hash(scene) == hash(scene.replace({"view": {}}))
    with pytest.raises(SceneError, match="view: got 3; allowed: a table"):
        scene.replace({"view": 3})
    assert "view" not in Choices.CHOSEN
