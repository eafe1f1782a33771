"""The message to the browser: small, exact to float32, jumps kept."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import solvers
from app.choices.choices import Choices
from app.choices.opened import opening_of
from app.choices.scene_of import choices_of, chosen_scene, own_choices
from app.messages.axial import rigid_prediction
from app.messages.encoding import read_header
from app.messages.solve import solve_frame
from solvers import SceneError
from solvers.methods.validity import TWICE

from .own import arrays


def test_histories_match_the_solution_and_keep_the_jump():
    found = arrays(solve_frame(Choices().chosen()))
    scene = solvers.load("fixed-rod")
    unit = scene.target.impedance
    motion = solvers.solve(scene).motion
    trip = scene.target.round_trip_time
    smooth = np.abs(found["exactTime"][:, None] - np.arange(5)).min(axis=1) > 1e-3
    expected = motion.force(found["exactTime"][smooth].astype(float) * trip) / unit
    assert np.median(np.abs(found["exactForce"][smooth] - expected)) < 1e-6
    at_jump = np.flatnonzero(found["exactTime"] == 1.0)
    assert found["exactForce"][at_jump] == pytest.approx([np.exp(-2.0), 2.0 + np.exp(-2.0)], rel=1e-6)  # (4.17)


@settings(max_examples=25, deadline=None)
@given(
    scene=st.sampled_from(Choices.param.scene.objects),
    force_at_depth=st.floats(-1, 9).map(lambda x: 10.0**x),
    exponent=st.floats(1, 3),
    yield_indentation=st.floats(-9, -2).map(lambda x: 10.0**x),
    elements=st.integers(1, 60),
    place=st.floats(0, 1),
    support=st.sampled_from(Choices.param.support.objects),
    theory=st.sampled_from(Choices.param.theory.objects),
    slenderness=st.floats(0, 3).map(lambda x: 10.0**x),
    damping=st.floats(0, 0.2),
    method=st.sampled_from(Choices.param.method.objects),
    law=st.sampled_from(Choices.param.law.objects),
    mass_ratio=st.floats(-3, 3).map(lambda x: min(max(10.0**x, 1e-3), 1e3)),
    speed=st.floats(-2, 2).map(lambda x: min(max(10.0**x, 1e-2), 1e2)),
    linear_stiffness=st.floats(2, 14).map(lambda x: 10.0**x),
    hertz_stiffness=st.floats(6, 14).map(lambda x: 10.0**x),
    restitution=st.floats(0, 1),
    modes=st.integers(1, 200),
)
def test_whatever_the_sliders_say_is_answered_in_a_small_finite_message(**chosen):
    try:
        message = solve_frame(Choices(**chosen).chosen())
    except SceneError as refusal:  # a beam struck where it is held
        assert refusal.key == "target.at"
        return
    assert len(message) <= 100_000
    for name, values in arrays(message).items():
        assert np.isfinite(values).all(), name
    header = read_header(message)
    json.dumps(header, allow_nan=False)
    if header["kind"] == "axial":
        assert abs(header["exact"]["diagnostics"]["energy_error"]) < 1e-6
    if header["kind"] == "axial" and header["other"] and header["other"]["name"] == "modal":
        assert abs(header["other"]["diagnostics"]["energy_error"]) < 1e-10


@pytest.mark.parametrize("scene", ["free-rod", "hammer-on-cantilever"])
@pytest.mark.parametrize("law, exponent", [("rigid", 1.0), ("linear", 1.0), ("power", 2.5), ("lee-wang", 2.5)])
def test_the_power_with_which_the_force_begins_is_told(scene, law, exponent):
    header = read_header(solve_frame({**own_choices(scene), "law": law, "exponent": 2.5}))
    assert header.get("law", header)["exponent"] == exponent


@pytest.mark.parametrize("name", Choices.param.scene.objects)
def test_a_scene_by_its_own_values_is_the_scene(name):
    chosen = Choices(scene=name, **choices_of(name)).chosen()
    base, scene = solvers.load(name).struck, chosen_scene(chosen)
    assert scene.contact == base.contact
    assert scene.impactor.mass == pytest.approx(base.impactor.mass, rel=1e-11)  # 12 digits of the ratio are kept
    assert scene.target.mass == base.target.mass


def test_balances_at_step_ends_are_drawn_as_the_circles_of_figure_6_5():
    chosen = Choices().chosen() | choices_of("figure-6.5") | {"scene": "figure-6.5"}
    message = solve_frame(chosen)
    header, found = read_header(message), arrays(message)
    solution = solvers.solve(solvers.load("figure-6.5"))
    time, impulse = solution.motion.impulses
    assert found["balanceTime"] * header["trip"] == pytest.approx(time, rel=1e-6, abs=1e-12)
    assert found["balanceForce"] * header["forceUnit"] == pytest.approx(impulse / solution.method["step"], rel=1e-6)
    located = chosen | {"scene": "fixed-rod", "method": "balance"}
    assert "balanceForce" not in arrays(solve_frame(located))  # at no step's end


@pytest.mark.parametrize("scene", ["bronze-rod-steel-ball", "table-8.4"])
def test_the_page_says_where_waves_are_counted_twice(scene):
    header = read_header(solve_frame(Choices().chosen() | choices_of(scene) | {"scene": scene, "law": "hunt-crossley"}))
    (note,) = (n for n in header["exact" if "exact" in header else "main"]["notes"] if n["code"] == TWICE)
    assert note["values"]["compared"] and note["values"]["elastic"] != note["values"]["velocity"]
    assert not any(n["code"] == TWICE for n in (header.get("other") or {"notes": []})["notes"])  # it is said once


def test_the_rigid_prediction_is_the_classical_answer():
    fixed, free = solvers.load("fixed-rod"), solvers.load("free-rod")
    assert rigid_prediction(fixed, 0.8) == {"impactor": -0.8, "target": 0.0}
    after = rigid_prediction(free, 0.6)
    assert after["target"] - after["impactor"] == pytest.approx(0.6)
    assert after["impactor"] + free.mass_ratio * after["target"] == pytest.approx(1.0)  # momentum, (9.1)


def test_figure_10_3_tells_how_far_the_rod_has_come_as_a_whole():
    """By momentum: the mass centre goes on evenly, (10.7), where the struck end, the reference coordinate, rests."""
    message = solve_frame(own_choices("figure-10.3"))
    header, found = read_header(message), arrays(message)
    time = np.linspace(0.0, header["duration"], found["exactMass"].size)
    expected = (time - found["exactMass"]) / own_choices("figure-10.3")["mass_ratio"]
    assert found["exactWhole"] == pytest.approx(expected, abs=1e-4 * expected[-1])
    last = time > 0.5
    speeds = np.diff(found["exactWhole"][last]) / np.diff(time[last]) * header["speed"]
    assert speeds == pytest.approx(0.1525, abs=1e-4)
    rests = (time > 0.4) & (time < 0.9)
    assert np.ptp(found["otherEnd"][rests]) < 0.02 * expected[-1] < np.ptp(found["exactWhole"][rests])
    assert opening_of("figure-10.3").charts == ("moved",)
    assert "exactWhole" not in arrays(solve_frame(own_choices("fixed-rod")))


def test_a_row_of_balls_is_drawn_as_it_moves():
    """Where each ball is at the end follows from when it left; no rigid-body theory of two bodies is shown."""
    message = solve_frame(Choices(scene="newtons-cradle", **choices_of("newtons-cradle")).chosen())
    header, row = read_header(message), arrays(message)["exactRow"]
    assert header["target"]["row"] == [0.02] * 4 and header["prediction"] is None
    assert "restitution" not in header["acting"]
    known = solvers.solve(solvers.load("newtons-cradle"))
    steps = header["duration"] / (len(row) - 1)
    assert (row[-1] - row[-2]) / steps == pytest.approx(known.ball_velocities, abs=1e-4)
    assert header["lastBall"][1] == pytest.approx(0.9888, abs=1e-4)
    assert known.duration > header["lastBall"][0] * known.scene.time_unit > known.contacts[0].end
    assert np.all(np.diff(row[-1]) > 0.0)
    found = arrays(message)
    assert found["exactRowVelocity"][-1, 1:] == pytest.approx(known.ball_velocities, abs=1e-6)
    step = header["duration"] / (len(row) - 1)
    given = step * found["exactRowForce"].sum(axis=0)  # each ball's momentum is what its contacts have given it
    before, after = found["exactRowVelocity"][[0, -1], 1:]
    unit = header["forceUnit"] * header["trip"] / (known.scene.target.balls[0].mass * header["speed"])
    assert (given - np.append(given[1:], 0.0)) * unit == pytest.approx(after - before, abs=1e-3)


def test_what_rod_theory_leaves_out_is_said_of_the_exact_solution_alone():
    chosen = Choices().chosen() | choices_of("fixed-rod") | {"speed": 8.0, "mass_ratio": 30.0}
    frame = read_header(solve_frame(chosen))
    codes = [[note["code"] for note in frame[name]["notes"]] for name in ("exact", "other")]
    assert {"strain-large", "pulse-short"} <= {*codes[0]} and not {"strain-large", "pulse-short"} & {*codes[1]}


def test_it_is_told_when_a_gap_between_rods_is_closed():
    [[rod, closes, opens]] = read_header(
        solve_frame(Choices(scene="rod-with-gap", **choices_of("rod-with-gap")).chosen())
    )["gaps"]
    assert rod == 2 and 0.25 < closes < 0.28 and opens == pytest.approx(1.406, abs=1e-3)


def test_contacts_of_the_method_beside_are_seen_to_their_end():
    """One mode lets go long after the waves have: its contact was told to last as long as what was solved."""
    wished = Choices().chosen() | {"modes": 1}
    found = read_header(solve_frame(wished))
    assert not found["other"]["stillTouching"]
    assert found["other"]["contacts"][-1][1] < 0.9 * found["duration"]


@pytest.mark.parametrize("law", ["linear", "kelvin-voigt", "hunt-crossley", "plastic-linear"])
@pytest.mark.parametrize("speed", [0.05, 0.5, 3.0])
def test_a_drop_that_stays_is_drawn_to_its_end(law, speed):
    """One that never leaves is solved for so long only, in its contact: no force is asked of a step beyond."""
    slow = choices_of("drop-test") | {"law": law, "linear_stiffness": 1e3, "restitution": 0.2, "speed": speed}
    found = read_header(solve_frame(Choices(scene="drop-test", **slow).chosen()))
    assert found["exact"]["contacts"] and found["duration"] > 0.0
