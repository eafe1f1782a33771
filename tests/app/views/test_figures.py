"""What figures look like: whole, without code, and of the models that the browser fills."""

import json

import pytest

from app.text.catalogues import page
from app.views.energy import COLOURS
from app.views.figures import drawn
from app.views.registry import FIGURES, VIEWS
from solvers.stability.runs import INTEGRATORS
from solvers.text.catalogue import SOURCE


def objects(tree):
    """Every model in a document."""
    if isinstance(tree, dict):
        if tree.get("type") == "object":
            yield tree["name"], tree.get("attributes", {})
        tree = list(tree.values())
    if isinstance(tree, list):
        for item in tree:
            yield from objects(item)


@pytest.mark.slow
@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_holds_no_code_and_fetches_nothing(name):
    text = drawn(FIGURES[name], page(SOURCE))
    found = json.loads(text)
    kinds = [kind for kind, _ in objects(found["doc"])]
    assert kinds.count("Figure") == len(found["roots"]) > 0
    assert not [kind for kind in kinds if kind.startswith("Custom")]  # the content policy forbids to evaluate it
    assert "http" not in text and "<script" not in text


@pytest.mark.slow
@pytest.mark.parametrize("name", FIGURES)
def test_what_the_browser_fills_and_moves_has_a_name_of_its_own(name):
    models = list(objects(json.loads(drawn(FIGURES[name], page(SOURCE)))["doc"]))
    wanted = ("Figure", "ColumnDataSource", "Range1d", "Span", "HoverTool", "Title")
    names = [attributes["name"] for kind, attributes in models if kind in wanted]
    assert len(names) == len(set(names)) and all(names)
    filled = [attributes for kind, attributes in models if kind == "ColumnDataSource"]
    assert all(not column for each in filled for _, column in each["data"]["entries"])  # data come with the answers


@pytest.mark.parametrize("name", FIGURES)
def test_every_axis_can_be_named_and_every_plot_can_be_zoomed_read_and_saved(name):
    models = list(objects(json.loads(drawn(FIGURES[name], page(SOURCE)))["doc"]))
    plots = [attributes for kind, attributes in models if kind == "Figure"]
    kinds = [kind for kind, _ in models]
    for tool in ("PanTool", "BoxZoomTool", "WheelZoomTool", "ResetTool", "SaveTool"):
        assert kinds.count(tool) == len(plots)
    assert kinds.count("HoverTool") >= len(plots)
    axes = [attributes for kind, attributes in models if kind in ("LinearAxis", "LogAxis")]
    assert len(axes) == 2 * len(plots)
    assert {each["name"] for each in axes} == {f"{plot['name']}-{way}" for plot in plots for way in ("across", "up")}


def test_figures_belong_to_views_and_have_what_their_answers_name():
    assert set(FIGURES) - {view.name for view in VIEWS} == {"stability-linear"}
    for look in ("stability", "stability-linear"):
        assert list(json.loads(drawn(FIGURES[look], page(SOURCE)))["roots"]) == list(INTEGRATORS)
    energy = list(objects(json.loads(drawn(FIGURES["energy"], page(SOURCE)))["doc"]))
    assert [each["name"] for kind, each in energy if kind == "GlyphRenderer" and each.get("name")] == list(COLOURS)
