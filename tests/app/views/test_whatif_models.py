"""Which model is enough at points of the page's map."""

import numpy as np
import pytest

import solvers
from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.views import whatif
from tests.app.sentences import sentence

from .test_whatif import found

pytestmark = pytest.mark.usefixtures("patient")
BOUNDS = [0.1, 0.05, 0.01, 0.001]
OF_QUESTIONS = {"peak_force": "peak-force", "impactor_velocity": "final-velocities"}


@pytest.fixture
def patient(monkeypatch):
    """All rows are answered at once, however busy the machine is."""
    monkeypatch.setattr(whatif, "SECONDS", 1e9)


def models(scene, figure, names, rows, bounds=BOUNDS, chosen=None):
    """By row, by bound, what the smallest model is called."""
    answer = found(scene, names, rows, chosen=chosen, models={"figure": figure, "bounds": bounds})
    assert not answer["why"]
    called = [each["name"] + (f" {each['modes']}" if "modes" in each else "") for each in answer["models"]]
    return [[called[row[1 + k] - 1] for k in range(len(bounds))] for row in answer["rows"]]


@pytest.mark.parametrize("figure", OF_QUESTIONS)
@pytest.mark.parametrize("scene", ["bronze-rod-steel-ball", "hammer-on-cantilever", "four-bar"])
def test_the_smallest_model_is_that_of_the_library_s_plan(scene, figure):
    """Which measures by twice as many modes where there are no waves: none of these is that near a bound."""
    [row] = models(scene, figure, ["speed"], [[1.3]])
    request = Request.of(own_choices(scene) | {"speed": 1.3})
    candidates = solvers.plan(request.scene, OF_QUESTIONS[figure], solve=True).candidates
    for bound, name in zip(BOUNDS, row, strict=True):
        good = [each for each in candidates if each.expected_error <= bound]
        smallest = next((each for each in good if each.modes or each.name == "waves"), None)
        if smallest is None or (smallest.modes or 0) > 20:
            assert name == "waves" or name.startswith("more-than")
        elif smallest.modes in (1, 2, 3, 5, 8, 12, 20):
            assert name == f"modal {smallest.modes}" or (smallest.modes == 1 and name in [each.name for each in good])


def test_a_soft_contact_needs_nothing_that_rings():
    soft, hard = models(
        "bronze-rod-steel-ball", "peak_force", ["hertz_stiffness"], [[1e6], [1e11]], chosen={"law": "hertz"}
    )
    assert soft[0] == "local-quasi-static" and "modal" in hard[0]


def test_what_is_right_by_chance_is_not_enough():
    """Over the stiffness the quasi-static structure passes through the right force, where one mode is wrong."""
    at, chances = {"law": "hertz", "mass_ratio": 0.5}, 0
    rows = [[10.0**exponent] for exponent in np.linspace(10.7, 11.1, 25)]
    found_there = models("fixed-rod", "peak_force", ["hertz_stiffness"], rows, [0.01], at)
    for [stiffness], [name] in zip(rows, found_there, strict=True):
        scene = Request.of(own_choices("fixed-rod") | at | {"hertz_stiffness": stiffness}).scene
        errors = {each.model: each.expected_error for each in solvers.plan(scene, "peak-force", solve=True).candidates}
        if errors["structural-quasi-static"] <= 0.01 < errors["modal, 1 modes"]:
            chances += 1
            assert name.startswith("modal")
    assert chances


@pytest.mark.parametrize("scene", ["two-balls", "drop-test", "brick-off-centre"])
def test_where_nothing_rings_no_model_leaves_anything_out(scene):
    answer = found(scene, ["speed"], [[1.0]], models={"figure": "peak_force", "bounds": BOUNDS})
    assert answer["why"]["0"]["code"] == "refused.no-models" and answer["rows"][0][0] == whatif.FAILED


@pytest.mark.parametrize(
    "asked",
    [
        True,
        {},
        {"figure": "peak_force"},
        {"figure": "peak_force", "bounds": []},
        {"figure": "peak_force", "bounds": [0.0]},
        {"figure": "peak_force", "bounds": [2]},
        {"figure": "peak_force", "bounds": [0.1] * 7},
        {"figure": "status", "bounds": [0.1]},
        {"figure": ["peak_force"], "bounds": [0.1]},
    ],
)
def test_models_are_asked_for_by_figure_and_bounds(asked):
    answer = found("fixed-rod", ["speed"], [[1.0]], models=asked)
    assert answer["error"]["code"] == "refused.points-models" and sentence(answer["error"])


@pytest.mark.parametrize(
    "scene, chosen, name",
    [
        ("hammer-on-cantilever", {"modes": 5}, "modal 5"),
        ("hammer-on-cantilever", {"modes": 6}, "modal 5"),
        ("hammer-on-cantilever", {"modes": 60}, "more-than 20"),
        ("hammer-on-cantilever", {"method": "quasi-static"}, "structural-quasi-static"),
        ("fixed-rod", {}, "waves"),
        ("four-bar", {}, "modal 12"),  # which are measured by 20 modes: there is no 20 to be enough
    ],
)
def test_it_says_what_the_page_shows_is_as_good_as(scene, chosen, name):
    answer = found(scene, ["speed"], [[1.0]], chosen=chosen, models={"figure": "peak_force", "bounds": BOUNDS})
    model = answer["models"][answer["shown"] - 1]
    assert " ".join(str(each) for each in model.values()) == name
