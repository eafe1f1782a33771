"""What the panels beside the solution report, and the long runs behind them."""

import asyncio
import json
import threading

import numpy as np
import pytest

from app.choices.choices import Choices
from app.choices.scene_of import choices_of
from app.jobs import long_run
from app.jobs.long_run import LongRun
from app.page.lab import Lab
from app.page.questions import Questions, accepted
from app.views import stability as stability_view
from app.views.stability import KINDS, kinds_of, stability_data, stability_kernels
from app.views.tolerance import QUESTIONS, auto_data, nearest_choices
from app.views.tradeoff import stored_data, tradeoff_data
from solvers import METHODS, load, stored_tradeoff
from solvers.stability.maps import NOT_RUN, Map
from tests.app.sentences import sentence

from ..jobs.threads import start
from ..socket_client import run as in_a_loop


def asked(scene, **more):
    return Choices(**choices_of(scene) | {"scene": scene}).chosen() | more


def never():
    return False


# --- trade-off --------------------------------------------------------------------------------------------------------


def test_a_built_in_scene_shows_its_table_at_once():
    found, own = json.loads(stored_data(asked("free-rod"))), stored_tradeoff(load("free-rod"))
    assert [point["label"] for point in found["points"]] == [point.label for point in own.points]
    front = {point["label"] for point in found["points"] if "peak-force" in point["best_for"]}
    assert front == {point.label for point in own.front("peak-force")}
    assert all(list(METHODS)[point["rank"]] == point["method"]["name"] for point in found["points"])
    assert found["reference"]["note"] == own.reference.note.table() and found["machine"] == own.machine
    assert json.loads(stored_data(asked("free-rod") | {"mass_ratio": 1.7}))["points"] == []


def test_a_measurement_that_is_stopped_keeps_what_it_found():
    stop, reported = threading.Event(), []

    def report(text):
        reported.append(json.loads(text))
        stop.set()

    found = json.loads(tradeoff_data(asked("two-balls"), stop.is_set, report))
    assert found["stopped"] in ("cancelled", None) and found["points"]
    stop.set()
    nothing = json.loads(tradeoff_data(asked("two-balls"), stop.is_set, report))
    assert nothing["stopped"] == "cancelled" and nothing["points"] == []


# --- a tolerance ------------------------------------------------------------------------------------------------------


def automatic(scene, quantity, tolerance, waves, cancelled=never, **more):
    usual = {name: question.parameter.default for name, question in QUESTIONS.items()}
    own = {"auto_quantity": quantity, "auto_tolerance": tolerance, "auto_waves": waves}
    return json.loads(auto_data(asked(scene, **usual | own | more), cancelled))


def test_what_keeps_to_a_tolerance_is_proved_beside_the_exact_waves():
    found = automatic("bronze-rod-steel-ball", "rebound", 0.01, False)
    assert found["met"] and not found["exact"]
    assert found["true"] <= 0.01
    assert found["estimate"] == pytest.approx(found["true"], rel=2.0)
    assert found["choices"]["method"] == found["label"].split()[0]
    assert found["label"] in [row["label"] for row in found["tried"]]


def test_within_a_time_the_finest_is_given_and_an_impossible_one_says_what_it_would_take():
    enough = automatic("bronze-rod-steel-ball", "rebound", 0.01, False, auto_within="time", auto_budget=5.0)
    assert enough["met"] is None and enough["proof"] is None
    assert enough["true"] < 1e-3 and enough["estimate"] < 1e-3
    least = automatic("bronze-rod-steel-ball", "rebound", 0.01, False, auto_within="time", auto_budget=1e-4)
    why = least["notes"][0]["values"]
    assert why["outcome"] == "over" and why["budget"] == 0.0001 and why["finer"] > 0.0
    assert least["true"] > enough["true"] and len(least["tried"]) == 1


def test_a_search_that_is_cancelled_gives_the_best_by_then():
    found = automatic("bronze-rod-steel-ball", "peak-force", 1e-6, False, lambda: True)
    assert found["cancelled"] and not found["met"] and found["notes"][0]["values"]["cancelled"]
    assert len(found["tried"]) == 1 and found["label"].startswith("modal")


def test_bodies_without_exact_waves_have_no_true_error():
    found = automatic("two-balls", "rebound", 0.01, True)
    assert found["true"] is None and found["met"]


def test_what_is_finer_than_the_sliders_is_not_shown():
    assert nearest_choices({"name": "modal", "modes": 3200, "steps": None}) is None
    assert nearest_choices({"name": "modal", "modes": 12, "steps": None}) == {"method": "modal", "modes": 12}


# --- stability --------------------------------------------------------------------------------------------------------


def test_the_maps_say_what_the_library_found(monkeypatch):
    monkeypatch.setattr(stability_view, "STEPS", 3)
    monkeypatch.setattr(stability_view, "ACROSS", 4)
    reported, asking = [], asked("fixed-rod", stability_axis="contact_stiffness")
    stability_kernels(asking)
    found = json.loads(stability_data(asking, never, reported.append))
    assert json.loads(reported[-1])["done"] == 4 == json.loads(reported[-1])["of"]
    first = found["maps"][0]
    assert first["name"] == "modal" and first["failures"] == 0
    assert len(first["runs"]) == 3 and all(len(row) == 4 for row in first["runs"])
    failed = str(KINDS.index("failed"))
    assert failed not in "".join(first["runs"])
    frozen = next(each for each in found["maps"] if each["name"] == "newmark-frozen")
    assert failed in "".join(frozen["runs"]) and len(frozen["limit"]) == 4
    stopped = json.loads(stability_data(asking, lambda: True, reported.append))
    assert stopped["cancelled"] and stopped["maps"][0]["count"] == 0


@pytest.mark.parametrize("axis", ["mass_ratio", "modes", "speed"])
def test_the_maps_go_over_the_axis_that_is_asked_for(monkeypatch, axis):
    monkeypatch.setattr(stability_view, "STEPS", 3)
    monkeypatch.setattr(stability_view, "ACROSS", 4)
    monkeypatch.setattr(stability_view, "MODES", (1, 10, 40))
    found = json.loads(stability_data(asked("fixed-rod", stability_axis=axis), never, lambda text: None))
    columns = 3 if axis == "modes" else 4
    assert found["across"]["name"] == axis and len(found["across"]["values"]) == columns
    assert found["maps"][0]["failures"] == 0
    for each in found["maps"]:
        for key in ("runs", "errors", "velocities", "chatter", "steps"):
            assert [len(row) for row in each[key]] == [columns] * 3


@pytest.mark.parametrize(
    "asking, said",
    [
        (asked("fixed-rod", law="plastic-linear", stability_axis="restitution"), "allowed: another axis"),
        (asked("brick-off-centre", stability_axis="speed"), "stability: got 'body'"),
        (asked("split-hopkinson", stability_axis="speed"), "stability: got 'rods'"),
    ],
    ids=["axis", "bodies in space", "chain"],
)
def test_why_there_are_no_maps_is_said_before_anything_runs(asking, said):
    reported = []
    assert stability_kernels(asking) is None
    assert said in sentence(json.loads(stability_data(asking, never, reported.append))["error"])
    assert reported == []


def test_the_gravest_of_what_holds_is_shown():
    ending = np.array([[0, 0, 0, 0], [1, 2, 3, NOT_RUN]], np.uint8)
    error = np.array([[1e-12, -1e-4, 0.5, 1e-9], [1e-12, 0.5, np.nan, np.nan]])
    chatter = np.array([[0, 0, 3, 2], [5, 0, 0, 0]])
    each = Map("modal", "", "", ending, error, chatter, error, chatter, error, None)
    named = [[KINDS[kind] for kind in row] for row in kinds_of(each).tolist()]
    assert named == [["ok", "slight", "error", "chatter"], ["stopped", "lasting", "failed", "none"]]


# --- long runs --------------------------------------------------------------------------------------------------------


def ran(work, kernels=lambda asked: None, meanwhile=None):
    """What a long run published, refused and whether it ended."""
    published, refused, ended = [], [], []
    run = LongRun(work, kernels, published.append, refused.append, lambda sentence: None, start=start)

    async def main():
        started = asyncio.ensure_future(run.start("asked", lambda: ended.append(True)))
        if meanwhile is not None:
            await asyncio.sleep(0.05)
            meanwhile(run)
        await started

    in_a_loop(main())
    assert ended == [True] and not run.busy
    return published, refused


def test_a_long_run_reports_parts_and_then_the_whole():
    def work(asked, cancelled, report):
        report("a part")
        return f"all of {asked}"

    assert ran(work) == (["a part", "all of asked"], [])


def test_a_long_run_can_be_stopped_and_keeps_what_it_has():
    def work(asked, cancelled, report):
        done = threading.Event()
        while not cancelled():
            done.wait(0.01)
        return "half"

    assert ran(work, meanwhile=LongRun.stop) == (["half"], [])


def test_what_a_long_run_has_found_is_kept_for_all_who_ask_the_same_unless_it_was_stopped():
    runs = []

    def found_again(asked, cancelled, report):
        runs.append(asked)
        done = threading.Event()
        while asked == "to stop" and not cancelled():
            done.wait(0.01)
        return f"all of {asked}"

    def of_a_visitor(asked, meanwhile=None):
        published = []
        run = LongRun(
            found_again,
            lambda asked: None,
            published.append,
            published.append,
            lambda sentence: None,
            kept=True,
            start=start,
        )

        async def main():
            started = asyncio.ensure_future(run.start(asked, lambda: None))
            await asyncio.sleep(0.05)
            if asked == "to stop":
                run.stop()
            await started

        in_a_loop(main())
        return published

    for asked in ("one", "one", "another", "to stop", "to stop"):
        assert of_a_visitor(asked) == [f"all of {asked}"]
    assert runs == ["one", "another", "to stop", "to stop"]


def test_a_long_run_that_fails_says_so_in_a_sentence(caplog):
    def refuses(asked, cancelled, report):
        raise ValueError("scene: got nothing; allowed: something")

    def breaks(asked, cancelled, report):
        raise ZeroDivisionError

    published, refused = ran(refuses)
    assert published == [] and sentence(refused[0]) == "scene: got nothing; allowed: something"
    published, refused = ran(breaks)
    assert published == [] and "could not" in sentence(refused[0]) and "ZeroDivisionError" in caplog.text


def test_kernels_of_a_long_run_are_compiled_elsewhere(monkeypatch):
    wanted = []

    class Elsewhere:
        @staticmethod
        async def ready(name, asked):
            wanted.append((name, asked))

    def kernels(asked):
        raise long_run.NotCompiled("one")

    monkeypatch.setattr(long_run, "COMPILER", Elsewhere)
    assert ran(lambda asked, cancelled, report: "done", kernels) == (["done"], [])
    assert wanted == [("kernels", "asked")]


@pytest.mark.parametrize(
    "name, value",
    [
        ("auto_tolerance", 0.0),
        ("auto_tolerance", 1.0),
        ("auto_quantity", "energy"),
        ("auto_within", "money"),
        ("auto_budget", 0.0),
        ("auto_budget", 60.0),
        ("auto_waves", 1),
        ("tradeoff_running", "yes"),
        ("stability_running", None),
        ("stability_axis", "step"),
    ],
)
def test_no_other_question_is_taken(name, value):
    assert name in Questions.ASKED and not accepted(name, value)


# --- a question that leads somewhere ----------------------------------------------------------------------------------


class Busy:
    """A runner that takes its time, and remembers what is asked meanwhile, as runners do."""

    def __init__(self):
        self.asked, self.done = [], asyncio.Event()

    async def want(self, choices):
        self.asked.append(choices["body_value"])
        if len(self.asked) == 1:
            await self.done.wait()


def test_a_value_asked_again_while_it_is_answered_is_not_taken_for_answered():
    async def main():
        lab, runner = Lab(), Busy()
        lab._runners["body_value"] = runner
        for value in ("target.length=0.5", "", "target.length=0.5"):
            lab.body_value = value
            await asyncio.sleep(0.01)
        assert lab.body_value == "target.length=0.5" and runner.asked == ["target.length=0.5"]
        lab.body_value = "target.length=0.7"  # another goes to the same runner, which answers both
        await asyncio.sleep(0.01)
        assert lab.body_value == "target.length=0.7" and len(runner.asked) == 2
        runner.done.set()
        await asyncio.sleep(0.01)
        assert lab.body_value == ""

    in_a_loop(main())
