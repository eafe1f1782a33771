"""One line in the registry is all that the page, its address, its guard and its compiler need to know of a view."""

import json
import subprocess
import sys
from contextlib import suppress

import panel
import pytest

from app.choices.choices import SCENES, Choices
from app.choices.kinds import kind_of
from app.choices.scene_of import choices_of
from app.jobs.compiler import usual
from app.page.lab import Lab
from app.text.refusals import note
from app.views.bounces import bounces_data
from app.views.registry import KINDS, VIEWS, View, any_method

from ...patience import SECONDS

REGISTERED = """
import param
from app.choices.questions import Question
from app.views import registry

def weather_data(asked): return asked["rain"]
def season_data(asked): return ""
def storm_data(asked, cancelled, report): return ""
def storm_kernels(asked): pass

asked = {"rain": Question(param.Number(default=0.5, bounds=(0.0, 1.0)), "wet")}
weather = registry.View("weather", weather_data, {"season": season_data}, asked=asked, address="sky",
                        kinds=frozenset(("beam",)))
storm = registry.View("storm", run=storm_data, kernels=storm_kernels)
registry.VIEWS = *registry.VIEWS, weather, storm

from app.choices.choices import SCENES
from app.jobs.compiler import usual, works
from app.page.address import opened_from_address
from app.page.lab import Lab
from app.serving.door import KNOWN
from app.serving.guard import SETTABLE
from app.text.refusals import note

assert opened_from_address({"panel": [b"sky,storm"], "wet": [b"0.25"]}) == (
    {"weather_shown": True, "storm_shown": True, "rain": 0.25}, [])
_, (sentence,) = opened_from_address({"wet": [b"2"]})
assert str(sentence) == "wet: 2.0 is not possible. Choose a number from 0 to 1.", sentence
assert "wet" in KNOWN
assert SETTABLE >= {"weather_shown", "rain", "storm_shown", "storm_running"}
assert not SETTABLE & {"weather", "season", "storm", "weather_running"}

assert {"weather_data", "season_data", "storm_kernels"} <= set(works()) and "storm_data" not in works()
pieces = {name: asked for name, asked in usual()}
assert SCENES[pieces["weather_data"]["scene"]].target.kind == "beam" and pieces["weather_data"]["rain"] == 0.5
assert SCENES[pieces["storm_kernels"]["scene"]].target.kind == "rod"

lab = Lab(rain=0.75)
assert lab.shared["panels"]["sky"] == "weather_shown" and lab.shared["asked"]["wet"] == ("rain", "sky", "")
assert (lab.weather, lab.season, lab.storm, lab.storm_running) == ("", "", "", False)
assert {"weather_shown", "rain", "storm_running"} <= set(lab._linked_properties) & set(lab._priority_changes)
assert {"weather", "season"} <= set(lab._runners) and "storm" in lab._long
"""


@pytest.mark.slow
def test_a_view_that_is_registered_is_known_everywhere():
    done = subprocess.run([sys.executable, "-c", REGISTERED], capture_output=True, text=True, timeout=SECONDS)
    assert done.returncode == 0, done.stderr


def test_names_are_taken_once():
    given = [name for view in VIEWS for name in (view.opener, view.running, *view.answers, *view.asked)]
    given += [view.name for view in VIEWS if not view.work]
    assert len(given) == len(set(given)) and not set(given) & set(Choices.param)
    keys = [view.key for view in VIEWS]
    assert len(keys) == len(set(keys))


WITHOUT_WORK = "record", "code"  # whose answers come by another door, or with the impact itself


def test_every_view_can_answer_and_what_runs_long_says_what_it_needs():
    for view in VIEWS:
        assert (view.work or view.run or view.name in WITHOUT_WORK) and view.kinds and view.kinds <= KINDS, view.name
        assert bool(view.run) == bool(view.kernels), view.name
        assert set(view.examples) >= set(view.sent), view.name
        for question in view.asked.values():
            assert question.needs is None or question.needs[0] in view.asked


def test_every_kind_of_scene_is_one_that_views_name():
    assert {kind_of(scene).NAME for scene in SCENES.values()} == KINDS


# --- what is asked, and when ------------------------------------------------------------------------------------------


class Requests:
    """In place of a runner: what it is asked."""

    def __init__(self):
        self.asked = []

    async def want(self, asked):
        self.asked.append(asked)

    def stop(self):
        pass


@pytest.fixture
def page(monkeypatch):
    """A laboratory that solves nothing, and does at once what else would wait for a loop."""

    def at_once(act):
        with suppress(StopIteration):
            act().send(None)

    async def report(act, *given):
        act(*given)

    monkeypatch.setattr(panel.state, "execute", at_once)
    lab = Lab()
    lab._report, lab._runner = report, Requests()
    lab._runners = {name: Requests() for name in lab._runners}
    return lab


def wishes(page, name):
    return page._runners[name].asked


def choose(page, scene, **more):
    page.param.update(**choices_of(scene) | {"scene": scene} | more)
    page.ask_panels()


def test_an_open_view_is_asked_once_about_the_same(page):
    page.plan_shown = True
    page.ask_panels()
    assert len(wishes(page, "plan")) == len(wishes(page, "regimes")) == 1
    page.plan_tolerance = 0.2
    assert [asked["plan_tolerance"] for asked in wishes(page, "plan")] == [0.05, 0.2]
    page.plan_shown = False
    page.plan_tolerance = 0.3
    assert len(wishes(page, "plan")) == 2 and wishes(page, "energy") == []


def test_a_view_is_asked_about_scenes_of_its_kind_only(page):
    page.param.update(trust_shown=True, methods_shown=True, energy_shown=True)
    assert (len(wishes(page, "trust")), len(wishes(page, "methods")), len(wishes(page, "energy"))) == (0, 1, 1)
    choose(page, next(name for name, scene in SCENES.items() if kind_of(scene).NAME == "beam"))
    assert (len(wishes(page, "trust")), len(wishes(page, "methods")), len(wishes(page, "energy"))) == (1, 1, 2)
    choose(page, "brick-off-centre")
    assert (len(wishes(page, "trust")), len(wishes(page, "methods")), len(wishes(page, "energy"))) == (1, 1, 2)


def test_one_figure_serves_all_mass_ratios_of_a_support(page):
    page.ratios_shown = True
    for ratio in (2.0, 3.0):
        choose(page, "fixed-rod", mass_ratio=ratio)
    assert len(wishes(page, "ratios")) == 1
    choose(page, "free-rod")
    assert len(wishes(page, "ratios")) == 2


def test_what_was_refused_is_asked_again(page):
    page.methods_shown = True
    page._refuse_view(next(view for view in VIEWS if view.name == "methods"), note("serving.not-solved").table())
    assert json.loads(page.refused)[0]["code"] == "serving.not-solved"
    page.ask_panels()
    assert len(wishes(page, "methods")) == 2


def test_a_search_that_may_be_stopped_says_that_it_is_under_way(page):
    page.auto_shown = True
    assert len(wishes(page, "auto")) == 1 and not page.auto_running  # it was answered at once
    page.param.update(modes=7)
    page.ask_panels()
    assert len(wishes(page, "auto")) == 1  # whose answer depends on no method
    page.auto_running = True
    assert len(wishes(page, "auto")) == 2


def test_what_an_answer_depends_on_leaves_the_method_out():
    chosen = Choices().chosen()
    assert any_method(chosen) == any_method(chosen | {"modes": 3, "method": "modal"})
    assert any_method(chosen) != any_method(chosen | {"speed": 3.0})


def test_a_view_with_a_scene_of_its_own_is_compiled_with_that():
    pieces = [asked["scene"] for name, asked in usual() if name == bounces_data.__name__]
    assert pieces == ["bouncing-ball"]


def test_a_view_for_all_scenes_is_compiled_on_an_axis():
    assert View("weather").compiled_kinds == {"axial"}
