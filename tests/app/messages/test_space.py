"""The message for bodies in space, the place along a struck rod, and the stage that draws them in a real browser."""

import base64
import json
from pathlib import Path

import numpy as np
import pytest
from pytest import approx

import app
import solvers
from app.choices.space import equivalent_box, leaning, own_frame, struck_at, struck_place
from app.messages.encoding import read_header
from app.messages.space import bodies_frame
from app.text.catalogues import script
from solvers.numerics.rigid.impulses import principal
from solvers.text.catalogue import SOURCE
from tests.catalog import SCENES

from .own import arrays

NAMES = [name for name, scene in SCENES.items() if scene.normal is not None]
STATIC = Path(app.__file__).parent / "static"
NOTE = solvers.load("note-rod")
MEETINGS = {name: SCENES[name] for name in NAMES} | {
    "apart": NOTE.replace({"impactor.velocity": [3.0, 0.0, 0.0]}),
    "at rest": NOTE.replace({"impactor.velocity": [0.0, 0.0, 0.0]}),
    "against a stop": NOTE.replace(
        {"impactor": NOTE.target.table() | {"velocity": [-1.0, 0, 0]}, "target": {"kind": "stop"}}
    ),
    "a plate": NOTE.replace({"target.inertia": [0.12, 0.12, 0.24]}),
    "points": NOTE.replace({"target": {"kind": "body", "mass": 1.0}}),
    "tiny": NOTE.replace({"impactor.mass": 1e-9, "target.mass": 1e-9, "target.inertia": [1e-30, 0, 1e-30]}),
}


@pytest.mark.parametrize("name", MEETINGS)
def test_the_message_is_small_and_finite(name):
    message = bodies_frame(solvers.solve(MEETINGS[name]))
    assert len(message) < 25_000
    header = read_header(message)
    assert header["kind"] == "bodies"
    json.dumps(header, allow_nan=False)
    assert all(np.isfinite(values).all() for values in arrays(message).values())
    across, up, normal = (np.array(header[key]) for key in ("across", "up", "normal"))
    assert (across @ across, up @ up, across @ up) == approx((1.0, 1.0, 0.0), abs=1e-12)
    assert normal @ np.cross(across, up) == approx(0.0, abs=1e-12)  # the normal is not foreshortened


def test_the_movement_is_that_of_the_solution():
    solution = solvers.solve(NOTE)
    message = bodies_frame(solution)
    header, found = read_header(message), arrays(message)
    path, turn = found["targetPath"], found["targetTurn"]
    middle, duration = len(path) // 2, header["duration"]
    assert path[middle] == approx([0.0, -0.6, 0.0])
    assert path[0] == approx([0.0, -0.6, 0.0])  # at rest before
    assert path[-1] == approx([-0.6 * duration, -0.6, 0.0])
    assert turn[middle] == approx(np.eye(3)) and turn[0] == approx(np.eye(3))
    angle = 3.0 * duration
    assert turn[-1][:2, :2] == approx(
        np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]), abs=1e-6
    )
    assert (header["across"], header["up"]) == ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    impactor = found["impactorPath"]
    assert impactor[0] == approx([3.0 * duration, 0.0, 0.0], rel=1e-6)
    figures = {name: value for name, value, _ in header["figures"]}
    assert figures["effective-mass"] == solution.effective_mass
    assert figures["target-felt-mass"] == approx(0.25 * figures["target-mass"], rel=1e-12)  # a rod, on its end
    assert figures["impactor-felt-mass"] == approx(figures["impactor-mass"], rel=1e-12)  # a point
    assert figures["target-spin-after"] == list(solution.target_spin)
    assert figures["energy-lost"] == solution.energy["dissipated"]


def test_the_course_of_sliding_is_that_of_the_solution():
    """From the first touch to the parting; the hodograph lies in the tangents, seen as the picture is."""
    solution = solvers.solve(solvers.load("brick-on-floor"))
    message = bodies_frame(solution)
    header, found = read_header(message), arrays(message)
    body, normal = solution.scene.impactor, np.array(solution.scene.normal)
    pressed = float(np.dot(solution.impulse, normal))
    assert found["slidePress"][[0, -1]] == approx([0.0, pressed], rel=1e-6)
    assert header["sliding"] == [{"kind": "slip", "until": pressed}]
    for k, velocity, spin in ((0, body.velocity, body.spin), (-1, solution.impactor_velocity, solution.impactor_spin)):
        point = np.add(velocity, np.cross(body.centre, spin))
        assert found["slideParting"][k] == approx(-point @ normal, rel=1e-6)
        assert found["slideAlong"][k] == approx(point @ header["across"], abs=1e-6)  # the picture stands upright
        assert found["slideAside"][k] == approx(point @ np.cross(header["across"], header["up"]), abs=1e-6)
    assert header["push"] == list(solution.impulse)
    assert "slidePress" not in arrays(bodies_frame(solvers.solve(NOTE)))


def test_a_normal_leans_as_it_is_told():
    frame = own_frame(NOTE)
    assert frame @ frame.T == approx(np.eye(3), abs=1e-15)
    assert leaning(NOTE, 0.0, 77.0) is NOTE
    for way, leans in ((0.0, frame[1]), (90.0, frame[2])):
        leant = np.array(leaning(NOTE, 30.0, way).normal)
        assert (leant @ frame[0], leant @ leans) == approx((np.cos(np.pi / 6), 0.5), abs=1e-15)


@pytest.mark.parametrize("signs", [(1.0, 1.0, 1.0), (-1.0, 1.0, -1.0), (1.0, -1.0, -1.0)])
def test_the_box_does_not_hang_on_the_signs_of_a_library(monkeypatch, signs):
    body = solvers.load("brick-on-floor").impactor
    sides, axes = equivalent_box(body)
    moments, found = principal(np.array(body.inertia))
    monkeypatch.setattr("app.choices.space.principal", lambda _: (moments, found * signs))
    again = equivalent_box(body)
    assert np.array_equal(again[0], sides) and np.array_equal(again[1], axes)


def test_the_equivalent_box_of_a_brick_is_the_brick():
    brick = solvers.load("brick-off-centre").target
    sides, _ = equivalent_box(brick)
    assert np.sort(sides) == approx([0.071, 0.115, 0.240], rel=1e-6)  # the moments are given in nine decimals
    rod, axes = equivalent_box(NOTE.target)
    assert sorted(rod) == approx([0.0, 0.0, 1.2], rel=1e-15)
    assert np.abs(axes[:, np.argmax(rod)]) == approx([0.0, 1.0, 0.0])


@pytest.mark.parametrize("place", [0.0, 0.3, 0.5, 2 / 3, 1.0])
def test_where_along_the_rod_it_is_struck(place):
    """1/mu = 1/m2 + 1/m1 (1 + 12 s^2) at s lengths from the middle."""
    scene = struck_at(NOTE, place)
    assert struck_place(scene) == approx(place, abs=1e-15)
    inverse = 1.0 / 0.5 + (1.0 + 12.0 * (place - 0.5) ** 2) / 2.0
    assert solvers.solve(scene).effective_mass == approx(1.0 / inverse, rel=1e-14)


def test_moving_the_impact_along_a_brick_keeps_it_on_the_face():
    brick = solvers.load("brick-off-centre")
    moved = struck_at(brick, 0.5)
    shift = np.array(moved.target.centre) - np.array(brick.target.centre)
    assert shift @ np.array(brick.normal) == approx(0.0, abs=1e-12)
    assert np.linalg.norm(shift) == approx(0.07, rel=1e-6)


@pytest.mark.parametrize("place", [-0.1, 1.1, float("nan"), "middle", None])
def test_a_place_off_the_rod_is_refused(place):
    with pytest.raises(ValueError, match="from 0 to 1"):
        struck_at(NOTE, place)


def test_point_masses_have_no_length():
    with pytest.raises(ValueError, match="no length"):
        struck_at(MEETINGS["points"], 0.5)


STAGE = """<!doctype html><div id="place" style="width:600px;height:400px"></div><script src="texts.js"></script>
<script type="module">
import { BodiesStage } from './space/stage.js';
import { decode } from './wire/message.js';
window.stage = new BodiesStage();
stage.root.style.cssText = 'width:600px;height:400px';
document.getElementById('place').append(stage.root);
window.show = (text, t) => {
  stage.load(decode(Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0)).buffer));
  stage.draw(t);
  const { data } = stage.canvas.getContext('2d').getImageData(0, 0, stage.canvas.width, stage.canvas.height);
  let inked = 0, red = 0;
  for (let k = 0; k < data.length; k += 4) {
    if (data[k + 3] > 128) inked++;
    if (data[k + 3] > 128 && data[k] > 180 && data[k + 1] < 80) red++;
  }
  return [inked, red];
};
</script>"""


@pytest.fixture(scope="module")
def stage(browser):
    tab = browser.new_page()
    errors = []
    tab.on("pageerror", lambda error: errors.append(str(error)))

    def served(route):
        name = route.request.url.removeprefix("http://stage.test/")
        if not name:
            route.fulfill(body=STAGE, content_type="text/html")
            return
        body = script(SOURCE) if name == "texts.js" else (STATIC / name).read_text()
        route.fulfill(body=body, content_type="text/javascript")

    tab.route("http://stage.test/**", served)
    tab.goto("http://stage.test/")
    tab.wait_for_function("() => window.show")
    yield tab
    tab.close()
    assert errors == []


@pytest.mark.parametrize("name", MEETINGS)
def test_the_stage_draws(stage, name):
    solution = solvers.solve(MEETINGS[name])
    text = base64.b64encode(bodies_frame(solution)).decode()
    for t in (-1.0, -0.3, 0.0, 0.4, 1.0):
        inked, red = stage.evaluate("([text, t]) => show(text, t)", [text, t])
        assert inked > 300
        # the impulse is drawn from the impact on, if there is one
        assert (red > 50) == (t >= 0.0 and np.any(solution.impulse))


@pytest.mark.parametrize("name", [name for name in NAMES if SCENES[name].friction])
def test_friction_gives_the_impulse_and_the_spins_that_are_solved(name):
    message = bodies_frame(solvers.solve(SCENES[name]))
    header, found = read_header(message), arrays(message)
    push, normal = np.array(header["push"]), np.array(header["normal"])
    size = np.linalg.norm(push)
    assert found["slidePush"][-1] == approx(np.linalg.norm(push - (push @ normal) * normal), rel=1e-4, abs=1e-6 * size)
    for k, name in enumerate(("impactor", "target")):
        spins = [header["bodies"][name][when]["spin"] for when in ("before", "after")]
        assert found["slideSpins"][[0, -1], k] == approx(np.array(spins), rel=1e-4, abs=1e-5)
    cone = header["friction"] * found["slidePress"]
    assert np.all(found["slidePush"] <= cone + 1e-5 * size)


@pytest.mark.parametrize("name", [name for name in NAMES if SCENES[name].friction])
@pytest.mark.parametrize("model", ["stronge", "poisson", "newton"])
def test_the_impulse_grows_along_the_cone_of_friction_while_it_slides_and_inside_while_it_sticks(name, model):
    solution = solvers.solve(SCENES[name].replace({"method.model": model}))
    message = bodies_frame(solution)
    header, found = read_header(message), arrays(message)
    grown, pressed, normal = found["slideImpulse"], found["slidePress"], np.array(header["normal"])
    most = float(pressed[-1])
    assert grown[0] == approx(np.zeros(3)) and grown[-1] == approx(header["push"], rel=1e-4, abs=1e-5 * most)
    added = np.diff(grown, axis=0)
    along = added @ normal
    aside = np.linalg.norm(added - np.outer(along, normal), axis=1)
    assert np.all(aside <= header["friction"] * along + 1e-5 * most)
    if model == "newton":  # which knows no course
        return
    until = header["sliding"][0]["until"] if header["sliding"][0]["kind"] == "slip" else 0.0
    slides = pressed[1:] <= until * (1 + 1e-6)
    assert aside[slides] == approx(header["friction"] * along[slides], abs=1e-4 * most)
