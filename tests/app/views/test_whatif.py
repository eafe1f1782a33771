"""Points of the page's map: the figures of its own frames, and what a stranger may ask."""

import json
import math
import tomllib

import numpy as np
import pytest

import solvers
from app.choices.body_value import with_body_value
from app.choices.choices import Choices
from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.messages.encoding import read_header
from app.messages.solve import solve_frame
from app.messages.transverse import main_solution
from app.page.address import ASKED, PANELS
from app.page.questions import Questions, accepted
from app.serving.limits import MAX_MESSAGE
from app.views import whatif
from app.views.whatif import COLUMNS, EXAMPLE, LONGEST, MOST_NAMES, MOST_ROWS, POINTS, id_of, whatif_data
from solvers.accuracy.reference import exact_solution
from solvers.solution.peaks import PEAKS
from tests.app.sentences import sentence

SAME = 1e-9  # relative: modes take flights without contact at once, all else is worked out alike


def never():
    return False


def found(scene, names, rows, cancelled=never, chosen=None, **more):
    text = json.dumps({"id": 7, "names": names, "rows": rows} | more)
    return json.loads(whatif_data(own_choices(scene) | (chosen or {}) | {POINTS: text}, cancelled))


def point(answer, row=0):
    assert not answer["why"]
    return dict(zip(COLUMNS, answer["rows"][row], strict=True))


def close(value, known):
    assert (value is None) == (known is None)
    assert value is None or value == pytest.approx(known, rel=SAME, abs=1e-12)


# --- the figures of a frame -------------------------------------------------------------------------------------------


def compare_figures(row, figures, final, target_final):
    energy = figures["energy"]
    close(row["impactor_velocity"], final)
    close(row["target_velocity"], target_final)
    close(row["peak_force"], figures["peakForce"])
    close(row["peak_indentation"], figures["peakIndentation"])
    close(row["newton"], figures["restitution"]["newton"])
    close(row["vibration"], energy["target_vibration"] / energy["initial"])
    close(row["dissipated"], energy["dissipated"] / energy["initial"])


@pytest.mark.parametrize(
    ("scene", "values"),
    [
        ("fixed-rod", {"mass_ratio": 2.3, "speed": 1.7}),
        ("bronze-rod-steel-ball", {"mass_ratio": 0.7}),
        ("bouncing-ball", {"speed": 2.0, "restitution": 0.6}),
        ("drop-test", {"mass_ratio": 3.0}),
        ("rigid-pendulum", {"speed": 1.5}),
    ],
)
def test_on_an_axis_they_are_of_the_exact_solution(scene, values):
    row = point(found(scene, list(values), [list(values.values())]))
    frame = read_header(solve_frame(own_choices(scene) | values))
    exact, speed = frame["exact"], frame["speed"]
    compare_figures(row, exact, exact["final"] * speed, exact["targetFinal"] * speed)
    assert row["contacts"] == len(exact["contacts"])
    lasts = sum(end - start for start, end, *_ in exact["contacts"]) * frame["trip"]
    close(row["contact_time"], lasts)


@pytest.mark.parametrize(
    ("scene", "values"),
    [
        ("xylophone-bar", {"mass_ratio": 1.4}),
        ("hammer-on-cantilever", {"place": 0.6}),
        ("four-bar", {"speed": 1.3}),
        ("slider-crank", {"speed": 0.8}),
        ("compound-pendulum", {"restitution": 0.3}),
    ],
)
def test_of_what_bends_or_is_linked_they_are_of_the_chosen_method(scene, values):
    row = point(found(scene, list(values), [list(values.values())]))
    main = read_header(solve_frame(own_choices(scene) | values))["main"]
    compare_figures(row, main, main["final"], main["targetFinal"])
    assert row["contacts"] == main["contacts"]


def test_other_resolutions_and_methods_are_the_map_s_too():
    few = point(found("xylophone-bar", ["modes"], [[3]]))
    by_elements = point(found("xylophone-bar", ["elements"], [[6]], set={"method": "fe-modal"}))
    for row, changes in ((few, {"modes": 3}), (by_elements, {"method": "fe-modal", "elements": 6})):
        main = read_header(solve_frame(own_choices("xylophone-bar") | changes))["main"]
        compare_figures(row, main, main["final"], main["targetFinal"])
    assert few["impactor_velocity"] != pytest.approx(by_elements["impactor_velocity"], rel=1e-6)


def test_of_bodies_in_space_velocities_are_along_the_normal():
    row = point(found("brick-on-floor", ["friction", "restitution"], [[0.2, 0.4]]))
    frame = read_header(solve_frame(own_choices("brick-on-floor") | {"friction": 0.2, "restitution": 0.4}))
    figures = {name: value for name, value, _ in frame["figures"]}
    close(row["impactor_velocity"], float(np.dot(figures["impactor-velocity-after"], frame["normal"])))
    close(row["dissipated"], figures["energy-lost"] / figures["energy-before"])
    assert row["target_velocity"] == 0.0 and row["peak_force"] is None


def test_a_value_of_a_body_moves_what_it_moves_on_the_page():
    """A longer rod keeps its hammer, so that the mass ratio grows, unless that is chosen itself."""
    own = own_choices("fixed-rod")
    longer = with_body_value(own | {"body_value": "target.length=0.5"})
    assert longer.keys() >= {"bodies", "mass_ratio"}
    both = {"target.length": 0.5, "mass_ratio": 2.0}
    for names, changes in ((["target.length"], longer), (list(both), longer | {"mass_ratio": 2.0})):
        row = point(found("fixed-rod", names, [[both[name] for name in names]]))
        frame = read_header(solve_frame(own | changes))
        exact, speed = frame["exact"], frame["speed"]
        compare_figures(row, exact, exact["final"] * speed, exact["targetFinal"] * speed)


def test_points_with_the_same_bodies_are_as_if_each_were_asked_alone():
    names, rows = ["target.length", "speed"], [[0.3, 1.0], [0.3, 2.0], [0.4, 1.0]]
    together = found("fixed-rod", names, rows)["rows"]
    assert together == [found("fixed-rod", names, [row])["rows"][0] for row in rows]
    assert together[0] != together[2]


def test_choices_that_the_server_does_not_know_yet_come_with_the_question():
    changes = {"law": "hertz", "hertz_stiffness": 3e10, "speed": 2.0}
    answer = found("fixed-rod", ["mass_ratio"], [[1.5]], set=changes)
    frame = read_header(solve_frame(own_choices("fixed-rod") | changes | {"mass_ratio": 1.5}))
    close(point(answer)["peak_indentation"], frame["exact"]["peakIndentation"])
    assert answer["chosen"] == own_choices("fixed-rod") | changes and answer["id"] == 7


@pytest.mark.parametrize(
    ("scene", "known"),
    [("fixed-rod", True), ("xylophone-bar", True), ("two-balls", False), ("brick-on-floor", False)],
)
def test_the_peak_stress_is_looked_for_where_it_is_asked(scene, known):
    assert point(found(scene, ["speed"], [[1.5]]))["peak_stress"] is None
    stress = point(found(scene, ["speed"], [[1.5]], stress=True))["peak_stress"]
    if not known:
        assert stress is None
        return
    request = Request.of(own_choices(scene) | {"speed": 1.5})
    solution = exact_solution(request.scene, request.restitution) if request.exact else main_solution(request)[0]
    close(stress, abs(PEAKS["stress"].find(solution).value))


def test_what_cannot_be_is_said_of_its_row_alone():
    answer = found("fixed-rod", ["mass_ratio"], [[1.0], [1e9], [2.0]])
    assert [row[0] for row in answer["rows"]] == [0, 1, 0] and answer["rows"][1][1:] == [None] * (len(COLUMNS) - 1)
    assert list(answer["why"]) == ["1"] and "Choose" in sentence(answer["why"]["1"])
    answer = found("four-bar", ["target.joints.2.x", "modes"], [[1e9, 3.0], [0.0, 2.5]])
    assert [row[0] for row in answer["rows"]] == [1, 1]
    assert "joint 2" in sentence(answer["why"]["0"]) and "whole" in sentence(answer["why"]["1"])
    answer = found("two-balls", ["target.length"], [[1.0]])
    assert "no such value" in sentence(answer["why"]["0"])


def test_a_point_that_fails_ends_no_other(monkeypatch):
    solve = whatif.exact_solution

    def failing(scene, restitution):
        if scene.speed > 1.5:
            raise ZeroDivisionError
        return solve(scene, restitution)

    monkeypatch.setattr(whatif, "exact_solution", failing)
    answer = found("fixed-rod", ["speed"], [[1.0], [2.0], [1.2]])
    assert [row[0] for row in answer["rows"]] == [0, 1, 0] and sentence(answer["why"]["1"])


# --- within bounds ----------------------------------------------------------------------------------------------------


def test_an_answer_goes_out_with_what_is_found_in_time(monkeypatch):
    rows = [[0.5], [1.0], [2.0]]
    whole = found("xylophone-bar", ["mass_ratio"], rows)["rows"]
    monkeypatch.setattr(whatif, "SECONDS", 0.0)
    assert found("xylophone-bar", ["mass_ratio"], rows)["rows"] == whole[:1]
    assert found("xylophone-bar", ["mass_ratio"], rows[1:])["rows"] == whole[1:2]
    monkeypatch.setattr(whatif, "SECONDS", math.inf)
    assert found("xylophone-bar", ["mass_ratio"], rows, lambda: True)["rows"] == whole[:1]
    assert found("xylophone-bar", ["mass_ratio"], rows)["rows"] == whole


NESTED = "[" * 5_000 + "]" * 5_000


@pytest.mark.parametrize(
    "text",
    [
        "",
        "null",
        "nonsense",
        "[]",
        NESTED,
        '{"id": 1, "names": ["speed"], "rows": ' + NESTED + "}",
        '{"id": 1, "names": "speed", "rows": [[1.0]]}',
        '{"id": 1, "names": [], "rows": [[]]}',
        '{"id": 1, "names": [["speed"]], "rows": [[1.0]]}',
        '{"id": 1, "names": ["speed", "speed"], "rows": [[1.0, 1.0]]}',
        '{"id": 1, "names": ["speed"]}',
        '{"id": 1, "names": ["speed"], "rows": []}',
        '{"id": 1, "names": ["speed"], "rows": [1.0]}',
        '{"id": 1, "names": ["speed"], "rows": [[1.0, 2.0]]}',
        '{"id": 1, "names": ["speed"], "rows": [[null]]}',
        '{"id": 1, "names": ["speed"], "rows": [["1"]]}',
        '{"id": 1, "names": ["speed"], "rows": [[true]]}',
        '{"id": 1, "names": ["speed"], "rows": [[NaN]]}',
        '{"id": 1, "names": ["speed"], "rows": [[-Infinity]]}',
        '{"id": 1, "names": ["speed"], "rows": [[1e999]]}',
        '{"id": 1, "names": ["speed"], "rows": [[1' + 8_000 * "0" + "]]}",
        '{"id": 1, "names": ["speed"], "rows": [[1.0]], "set": []}',
        json.dumps({"id": 1, "names": ["speed"], "rows": (MOST_ROWS + 1) * [[1.0]]}),
        json.dumps({"id": 1, "names": (MOST_NAMES + 1) * ["speed"], "rows": [(MOST_NAMES + 1) * [1.0]]}),
    ],
    ids=range(24),
)
def test_what_is_no_question_is_refused_by_one_sentence(text):
    answer = json.loads(whatif_data(own_choices("fixed-rod") | {POINTS: text}))
    assert answer["error"]["code"] == "refused.points" and sentence(answer["error"])
    assert "rows" not in answer and answer["id"] == id_of(text)


@pytest.mark.parametrize(
    "name",
    ["law", "scene", "bodies", "target.material", "target.rods.99.length", "__class__", "impactor", "a" * 500, "<b>"],
)
def test_a_name_that_is_no_number_of_the_page_is_refused(name):
    answer = found("fixed-rod", [name], [[1.0]])
    assert answer["error"]["code"] == "refused.points-name"
    said = sentence(answer["error"])
    assert "cannot be varied" in said and len(said) < 200 and "<" not in said


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("law", "soft"),
        ("law", ["hertz"]),
        ("law", {}),
        ("speed", "fast"),
        ("speed", 1e9),
        ("speed", True),
        ("speed", float("nan")),
        ("modes", 2.5),
        ("bodies", "target.length=x"),
        ("bodies", "a" * 900),
        ("scene", "free-rod"),
        ("no-choice", 1.0),
        ("_TRIAL", 1.0),
    ],
)
def test_choices_in_a_question_meet_the_bounds_of_sliders(name, value):
    answer = found("fixed-rod", ["mass_ratio"], [[1.0]], set={name: value})
    assert "rows" not in answer and len(sentence(answer["error"])) < 400


def test_a_question_is_bounded_text_that_no_address_and_no_panel_has():
    assert accepted(POINTS, EXAMPLE) and accepted(POINTS, "") and accepted(POINTS, "\n" * LONGEST)
    assert not accepted(POINTS, (LONGEST + 1) * "1") and not accepted(POINTS, 1.0) and not accepted(POINTS, None)
    assert LONGEST + 1_000 < MAX_MESSAGE
    assert POINTS in Questions.ASKED and POINTS not in Choices.CHOSEN and POINTS not in Questions.FOLLOWED
    assert "whatif" not in PANELS and not {name for name, *_ in ASKED.values()} & {POINTS, "whatif"}


def test_the_number_of_a_question_stands_first():
    assert id_of(EXAMPLE) == 0 and id_of('{"id":12,"names"') == 12
    assert id_of('{"names": [], "id": 1}') is None and id_of('{"id": 1234567890, ') is None and id_of("") is None


# --- the scene file, and the keys that axes stand for -----------------------------------------------------------------


def varied(scene, names, rows, **chosen):
    answer = found(scene, names, rows, chosen=chosen, file=True)
    return answer["scene"], answer["keys"]


@pytest.mark.parametrize(
    ("scene", "names", "rows", "keys"),
    [
        (
            "fixed-rod",
            ["mass_ratio", "speed"],
            [[1.0, 1.0], [2.0, 1.0], [1.0, 3.0]],
            ["impactor.mass", "impactor.velocity"],
        ),
        ("fixed-rod", ["target.length", "speed"], [[0.3, 1.0], [0.2, 1.0]], ["target.length"]),
        (
            "hammer-on-cantilever",
            ["slenderness", "place"],
            [[10.0, 1.0], [20.0, 1.0]],
            ["impactor.mass", "target.length"],
        ),
        ("hammer-on-cantilever", ["modes", "speed"], [[20.0, 1.0], [12.0, 1.0]], ["method.modes"]),
        ("four-bar", ["speed", "mass_ratio"], [[1.0, 1.0], [2.0, 1.0]], ["impactor.velocity"]),
    ],
)
def test_axes_are_keys_of_the_scene_file(scene, names, rows, keys):
    text, values = varied(scene, names, rows)
    assert sorted(values) == keys
    read = solvers.Scene.from_table(tomllib.loads(text))
    figures = [point(found(scene, names, rows), row) for row in range(len(rows))]
    for number, each in enumerate(figures[1:]):
        solution = solvers.solve(read.replace({key: column[number] for key, column in values.items()}))
        close(each["peak_force"], solution.peak_force)
        close(each["contact_time"], solution.contact_time)
    close(figures[0]["peak_force"], solvers.solve(read).peak_force)


def test_what_is_no_value_of_a_scene_file_has_no_key():
    assert varied("brick-on-floor", ["speed", "friction"], [[1.0, 0.2], [2.0, 0.2]])[1] is None
    law = {"law": "power"}
    _, keys = varied("fixed-rod", ["exponent", "speed"], [[1.5, 1.0], [2.0, 1.0]], **law)
    assert sorted(keys) == ["contact.exponent", "contact.stiffness"]


def test_refused_points_have_no_values_and_a_refused_scene_is_said():
    place = ["place", "speed"]
    _, keys = varied("hammer-on-cantilever", place, [[1.0, 1.0], [0.5, 1.0], [0.0, 1.0]])
    assert keys == {"target.at": [0.5, None]}
    assert found("hammer-on-cantilever", place, [[0.0, 1.0]], file=True)["error"]
