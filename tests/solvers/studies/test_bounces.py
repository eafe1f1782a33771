"""Dropped bodies and their bounces: free fall, the series of Zeno, laws that lose less the slower it falls."""

import json
import math

import pytest
from pytest import approx

import solvers
from solvers import Scene, SceneError
from solvers.bodies.drop import STANDARD_GRAVITY
from tests.catalog import STEEL_BEAM, STEEL_ROD

BALL = solvers.load("bouncing-ball")
DROP = solvers.load("drop-test")


def dropped(height: float = 2.0, **impactor) -> Scene:
    falling = {"mass": 0.3, "height": height} | impactor
    return Scene.from_table({"impactor": falling, "target": {"kind": "stop"}})


# --- the height in a scene --------------------------------------------------------------------------------------------


def test_a_height_is_the_speed_that_the_fall_gives():
    assert dropped().impactor.velocity == approx(math.sqrt(2.0 * 9.80665 * 2.0), rel=1e-15)
    assert dropped(gravity=1.62).impactor.velocity == approx(math.sqrt(2.0 * 1.62 * 2.0), rel=1e-15)
    rod = Scene.from_table({"impactor": {"kind": "rod", **{k: STEEL_ROD[k] for k in ("length", "section", "material")},
                                         "height": 0.1}, "target": STEEL_ROD})  # fmt: skip
    assert rod.impactor.velocity == approx(math.sqrt(0.2 * STANDARD_GRAVITY), rel=1e-15)


@pytest.mark.parametrize("scene", [BALL, DROP, dropped(gravity=3.7)])
def test_a_scene_with_a_height_is_written_back(scene):
    written = scene.table()
    assert "velocity" not in written["impactor"]
    assert Scene.from_table(written) == scene
    assert Scene.from_table(written).table() == written


def test_height_and_velocity_replace_each_other():
    faster = BALL.replace({"impactor.velocity": 7.0})
    assert faster.impactor.velocity == 7.0 and "height" not in faster.table()["impactor"]
    assert faster.replace({"impactor.height": 1.0}) == BALL
    assert BALL.replace({"impactor.gravity": 1.62}).speed == approx(math.sqrt(2.0 * 1.62))


@pytest.mark.parametrize(
    "impactor, key, said",
    [
        ({"mass": 1.0, "height": 1.0, "velocity": 2.0}, "impactor.velocity", "beside a height"),
        ({"mass": 1.0, "height": -1.0}, "impactor.height", "1e-12 to 1e+06"),
        ({"mass": 1.0, "height": "high"}, "impactor.height", "1e-12 to 1e+06"),
        ({"mass": 1.0, "height": 1.0, "gravity": 0.0}, "impactor.gravity", "m/s2"),
        ({"mass": 1.0, "gravity": 9.81}, "impactor.velocity", "the key is missing"),
        ({"kind": "body", "mass": 1.0, "height": 1.0}, "impactor.height", "mass, sphere, rod, rods, beam"),
    ],
)
def test_what_cannot_fall_is_refused(impactor, key, said):
    with pytest.raises(SceneError) as refused:
        Scene.from_table({"impactor": impactor, "target": {"kind": "stop"}})
    assert refused.value.key == key and said in refused.value.allowed


# --- bounces ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("restitution", [0.1, 0.5, 0.9, 0.99])
@pytest.mark.parametrize("cut", [1e-2, 1e-8])
def test_with_one_restitution_rest_is_that_of_the_series(restitution, cut):
    """sqrt(2 h / g) (1 + e) / (1 - e) and h (1 + e^2) / (1 - e^2), wherever it is cut."""
    found = solvers.bounces(BALL.replace({"method.restitution": restitution}), cut=cut, count=2_000)
    assert (
        found.ended == "cut"
        and found.bounces[-1].height < cut <= found.bounces[-2 if len(found.bounces) > 1 else 0].height / restitution**2
    )
    fall = math.sqrt(2.0 / STANDARD_GRAVITY)
    assert found.rest_time == approx(fall * (1.0 + restitution) / (1.0 - restitution), rel=1e-12)
    assert found.path == approx((1.0 + restitution**2) / (1.0 - restitution**2), rel=1e-12)
    for number, bounce in enumerate(found.bounces[:20], 1):
        assert bounce.height == approx(restitution ** (2 * number), rel=1e-12)
        since = fall * (1.0 + 2.0 * sum(restitution**k for k in range(1, number)))
        assert bounce.time == approx(since, rel=1e-12)


def test_it_stays_where_nothing_is_restored_and_goes_on_where_nothing_is_lost():
    plastic = solvers.bounces(BALL.replace({"method.restitution": 0.0}))
    assert (plastic.ended, len(plastic.bounces), plastic.path) == ("stays", 1, 1.0)
    assert plastic.rest_time == approx(math.sqrt(2.0 / STANDARD_GRAVITY), rel=1e-14)
    elastic = solvers.bounces(BALL.replace({"method.restitution": 1.0}), count=5)
    assert (elastic.ended, elastic.rest_time, len(elastic.bounces)) == ("count", None, 5)
    assert elastic.bounces[-1].height == approx(1.0, rel=1e-12)
    assert [note.code for note in elastic.notes] == ["bounces-go-on"]


def test_steel_that_yields_gives_back_more_the_slower_it_is_struck():
    found = solvers.bounces(DROP, count=6)
    restitutions = [bounce.restitution for bounce in found.bounces]
    assert restitutions == sorted(restitutions) and restitutions[0] < 0.85 < restitutions[-1]
    for before, after in zip(found.bounces, found.bounces[1:], strict=False):
        alone = solvers.solve(DROP.replace({"impactor.height": before.height}))
        assert -alone.impactor_velocity == approx(after.rebound, rel=1e-12)
        flight = (before.rebound + after.speed) / STANDARD_GRAVITY
        assert after.time == approx(before.time + before.contact_time + flight)
    json.dumps(found.table(), allow_nan=False)


def test_a_dent_of_the_bounce_before_is_left_out_and_said():
    assert [note.code for note in solvers.bounces(DROP, count=2).notes] == ["bounces-on-fresh-spots", "bounces-go-on"]
    assert solvers.bounces(DROP, count=1).notes[0].code == "bounces-go-on"


def test_a_duration_of_the_scene_cuts_no_bounce_short():
    """Of a rod of the same mass, fixed at its end: e = 0.69888 (4.37), once the bodies have parted."""
    rod = solvers.load("fixed-rod")
    short = rod.replace({"method.duration": 0.2 * rod.time_unit})
    assert solvers.solve(short).impactor_velocity > 0.0  # by then they still touch
    found, whole = (solvers.bounces(scene, count=3) for scene in (short, rod))
    assert found.bounces == whole.bounces
    weight = 2.0 * 9.80665 * rod.time_unit / found.bounces[-1].speed  # over the slowest impact, in its speed
    assert [bounce.restitution for bounce in found.bounces] == approx([0.6988755819961637] * 3, abs=weight)


def test_each_solution_can_be_looked_at():
    seen = []
    found = solvers.bounces(DROP, count=3, solved=lambda solution: seen.append(solution.peak_force))
    assert seen == [bounce.peak_force for bounce in found.bounces]


def test_one_impact_is_solved_whenever_it_is_cancelled():
    assert len(solvers.bounces(BALL, cancelled=lambda: True).bounces) == 1


SOFT = Scene.from_table(
    {
        "impactor": {"mass": 1.0, "height": 1e-3},
        "target": {"kind": "stop"},
        "contact": {"law": "kelvin-voigt", "stiffness": 1e5, "restitution": 0.5},
    }
)


def test_a_soft_ball_comes_to_rest_by_its_weight():
    """In the end it does not leave: there is no series of ever smaller bounces."""
    found = solvers.bounces(SOFT)
    assert found.ended == "stays" and 2 <= len(found.bounces) < 10 and found.bounces[-1].rebound == 0.0
    assert found.rest_time == approx(found.bounces[-1].time + found.bounces[-1].contact_time)
    restitutions = [bounce.restitution for bounce in found.bounces]
    assert restitutions == sorted(restitutions, reverse=True) and restitutions[0] < 0.5


def test_heights_hang_on_the_stiffness():
    """Without weight the same damping ratio gives the same restitution at any stiffness."""
    heights = [
        solvers.bounces(SOFT.replace({"contact.stiffness": stiffness}), count=1).bounces[0].height
        for stiffness in (1e4, 1e5, 1e6, 1e12)
    ]
    assert heights == sorted(heights) and heights[0] == 0.0 and 0.0 < heights[1] < 0.5 * heights[3]
    assert heights[3] == approx(0.25e-3, rel=1e-3)


def test_what_still_vibrates_is_left_out_and_said():
    beam = Scene.from_table(
        {
            "impactor": {"mass": 0.05, "height": 0.05, "radius": 0.01},
            "target": STEEL_BEAM | {"support": "clamped-clamped", "at": 0.5},
            "contact": {"law": "hertz"},
        }
    )
    found = solvers.bounces(beam, "rigid", count=2)
    assert [note.code for note in found.notes] == ["bounces-on-rest", "bounces-go-on"]


@pytest.mark.parametrize("name", ["free-rod", "note-rod", "two-equal-rods", "pressure-bar", "slider-crank"])
def test_what_does_not_bounce_is_refused(name):
    with pytest.raises(SceneError, match="strikes what is held"):
        solvers.bounces(solvers.load(name))


@pytest.mark.parametrize(
    "option, value", [("cut", 0.0), ("cut", math.nan), ("count", 0), ("count", 1.5), ("gravity", -1)]
)
def test_options_out_of_range(option, value):
    with pytest.raises(SceneError):
        solvers.bounces(BALL, **{option: value})
