"""Derivatives: closed forms, independent differences of random impacts, events, refusals."""

import json
import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import METHODS, Modal, Scene, SceneError, SceneNotSupported, gradient
from solvers.studies.differences import judged, narrower, slopes
from solvers.studies.figures import figures_of
from solvers.studies.gradient import unit_of_slope
from tests.catalog import STEEL_ROD_MASS, struck_rod

MASS, SPEED, STIFFNESS = 2.0, 3.0, 1e6
ELASTIC = METHODS["rigid"].read({"restitution": 1.0})
OF = ("peak_force", "impactor_velocity", "contact_time", "impulse")


def struck(target: dict, contact: dict, mass: float = MASS) -> Scene:
    return Scene.from_table({"impactor": {"mass": mass, "velocity": SPEED}, "target": target, "contact": contact})


def on_stop() -> Scene:
    return struck({"kind": "stop"}, {"law": "linear", "stiffness": STIFFNESS})


def test_a_mass_on_a_linear_contact_follows_closed_forms():
    keys = ["impactor.mass", "contact.stiffness", "impactor.velocity"]
    found = gradient(on_stop(), OF, keys)
    root, unit = math.sqrt(STIFFNESS * MASS), math.sqrt(STIFFNESS / MASS)
    time = math.pi / unit
    expected = {
        "peak_force": (0.5 * SPEED * unit, 0.5 * SPEED / unit, root),
        "contact_time": (0.5 * time / MASS, -0.5 * time / STIFFNESS, 0.0),
        "impactor_velocity": (0.0, 0.0, -1.0),
        "impulse": (2.0 * SPEED, 0.0, 2.0 * MASS),
    }
    for figure, slopes_of_it in expected.items():
        for key, exact in zip(keys, slopes_of_it, strict=True):
            scale = abs(found.figures[figure]) / found.at[key]
            assert found.value[figure][key] == approx(exact, rel=1e-9, abs=1e-10 * scale), (figure, key)
            assert abs(found.value[figure][key] - exact) <= 2.0 * found.error[figure][key] + 1e-14 * scale
    powers = [found.elasticity["peak_force"][key] for key in keys]
    assert powers == approx([0.5, 0.5, 1.0], rel=1e-9)
    assert found.unit["peak_force"] == dict(zip(keys, ("N/kg", "N/(N/m)", "N/(m/s)"), strict=True))
    assert found.unit["impactor_velocity"]["impactor.velocity"] == ""
    assert found.solves <= 2 + 6 * len(keys)


def test_equal_masses_hand_their_speed_on():
    keys = ["impactor.velocity", "target.velocity"]
    for contact, method in (({"law": "linear", "stiffness": STIFFNESS}, None), ({"law": "rigid"}, ELASTIC)):
        scene = struck({"kind": "mass", "mass": MASS}, contact)
        found = gradient(scene, ("impactor_velocity", "target_velocity"), keys, method)
        velocities = [found.value[name][key] for name in found.value for key in keys]
        assert velocities == approx([0.0, 1.0, 1.0, 0.0], abs=1e-9)
        assert math.isnan(found.elasticity["impactor_velocity"]["impactor.velocity"])  # 0 over 3 m/s


def test_equal_balls_hand_their_speed_on():
    ball = {"radius": 0.02, "material": "steel"}
    target = {"kind": "balls", "balls": [ball]}
    tables = {"impactor": ball | {"kind": "sphere", "velocity": 1.5}, "target": target, "contact": {"law": "hertz"}}
    found = gradient(Scene.from_table(tables), ("impactor_velocity", "target_velocity"), "impactor.velocity")
    assert found.value["impactor_velocity"]["impactor.velocity"] == approx(0.0, abs=1e-9)
    assert found.value["target_velocity"]["impactor.velocity"] == approx(1.0, abs=1e-9)


def random_impact(seed: int) -> tuple[Scene, str]:
    """A mass on a rod, free or fixed, without a law or with one; and a key of it."""
    chance = np.random.default_rng([seed, 4])
    ratio, support = math.exp(chance.uniform(-3.0, 3.0)), str(chance.choice(["free", "fixed"]))
    law = str(chance.choice(["rigid", "rigid", "linear", "hertz"]))
    contact = {"law": law}
    if law != "rigid":
        stiffness = 210e9 * 9e-4 / 0.3 / math.exp(chance.uniform(-1.0, 3.0))
        contact["stiffness"] = stiffness if law == "linear" else stiffness / 1e-4**0.5
    keys = ["impactor.mass", "impactor.velocity", "target.length", *(["contact.stiffness"] if law != "rigid" else [])]
    return struck_rod(ratio, support, contact, math.exp(chance.uniform(-2.0, 2.0))), str(chance.choice(keys))


def independent(scene: Scene, key: str, at: float, method) -> tuple[np.ndarray, bool]:
    """Slopes by five points, closer together than those of the library; and whether the contacts are the same there."""
    step = 3e-5 * at
    solved = [method.solve(scene.replace({key: at + i * step})) for i in (-2, -1, 1, 2)]
    far = [method.solve(scene.replace({key: at * (1.0 + i)})) for i in (-0.012, 0.0, 0.012)]
    rows = np.array([figures_of(each, OF) for each in solved])
    same = len({len(each.contacts) for each in (*solved, *far)}) == 1
    return (8.0 * (rows[2] - rows[1]) - (rows[3] - rows[0])) / (12.0 * step), same


def test_random_impacts_of_exact_waves_agree_with_independent_differences():
    seen, method = 0, METHODS["waves"].read({})
    for seed in range(120):
        scene, key = random_impact(seed)
        found = gradient(scene, OF, key, method, workers=1)
        expected, away = independent(scene, key, found.at[key], method)
        if not away:
            continue
        seen += 1
        for name, slope in zip(OF, expected.tolist(), strict=True):
            scale = max(abs(found.figures[name]), scene.speed if "velocity" in name else 0.0) / found.at[key]
            assert found.why[name][key] is None, (seed, name, key)
            assert abs(found.value[name][key] - slope) < 1e-7 * scale, (seed, name, key)
    assert seen >= 90


def last_ratio(low: float, high: float, contacts: int) -> float:
    """The mass ratio up to which the fixed rod is touched so many times, to rounding, from `low` to `high`."""
    for _ in range(50):
        middle = 0.5 * (low + high)
        same = len(solvers.solve(struck_rod(middle)).contacts) == contacts
        low, high = (middle, high) if same else (low, middle)
    return 0.5 * (low + high)


def test_there_is_none_where_a_contact_is_lost():
    ratio = last_ratio(1.0, 1.02, 2)
    found = gradient(struck_rod(ratio * (1.0 - 1e-6)), OF)
    mass = STEEL_ROD_MASS / ratio
    for name in OF:
        assert math.isnan(found.value[name]["impactor.mass"])
        assert found.why[name]["impactor.mass"].code == "contacts-change-here"
    within, beyond = found.nearest["impactor.mass"]
    assert within == 0.0
    assert 1e-6 * mass < beyond < 1e-4 * mass
    assert "contacts change within" in str(found)


def test_a_lost_contact_farther_off_makes_the_step_smaller():
    ratio = last_ratio(1.0, 1.02, 2)
    mass = STEEL_ROD_MASS / ratio
    distance = 3e-3 * mass
    scene = struck_rod(STEEL_ROD_MASS / (mass + distance))
    found = gradient(scene, OF)
    within, beyond = found.nearest["impactor.mass"]
    assert within < distance < beyond
    assert [note.code for note in found.notes] == ["contacts-change-beside"]
    closer = independent_close(scene, found.at["impactor.mass"])
    for name, slope in zip(OF, closer.tolist(), strict=True):
        assert found.why[name]["impactor.mass"] is None
        assert found.reach[name]["impactor.mass"] <= within
        off = abs(found.value[name]["impactor.mass"] - slope)
        assert off <= 2.0 * found.error[name]["impactor.mass"] + 1e-7 * abs(slope), name
    assert found.solves <= 2 + 18


def independent_close(scene: Scene, mass: float) -> np.ndarray:
    rows = [figures_of(solvers.solve(scene.replace({"impactor.mass": mass * (1.0 + i)})), OF) for i in (-1e-6, 1e-6)]
    return (np.array(rows[1]) - np.array(rows[0])) / (2e-6 * mass)


def test_there_is_none_where_the_peak_goes_from_one_front_to_another():
    """Near a mass ratio of 0.369 the front after the next becomes the larger one; the number of contacts stays."""
    ratios = np.linspace(0.36, 0.38, 2001)
    peaks = solvers.solve_many(struck_rod(), {"impactor.mass": STEEL_ROD_MASS / ratios}, figures=("peak_force",))
    bend = np.abs(np.diff(peaks.peak_force, 2))
    ratio = float(ratios[1 + np.argmax(bend)])
    one, other = (gradient(struck_rod(ratio * (1.0 + i)), "peak_force") for i in (-2e-3, 2e-3))
    slopes_of_it = [each.value["peak_force"]["impactor.mass"] for each in (one, other)]
    gap = abs(slopes_of_it[1] - slopes_of_it[0])
    found = gradient(struck_rod(ratio), ("peak_force", "impactor_velocity"))
    assert gap > 0.1 * abs(slopes_of_it[0])
    assert found.why["impactor_velocity"]["impactor.mass"] is None
    told = found.why["peak_force"]["impactor.mass"]
    known = found.error["peak_force"]["impactor.mass"] > 0.2 * gap  # a corner close by, not here
    assert known if told is None else told.code in ("figure-has-corner", "differences-scatter")


@pytest.mark.parametrize("at", [1.0, 1.0 + 1e-9])
def test_corners_jumps_and_noise_are_told_apart(at):
    chance = np.random.default_rng(0)

    def figures(x: float) -> np.ndarray:
        noise = 1e-6 * chance.standard_normal()
        return np.array([x**3, abs(x - 1.0), float(x > 1.0) + x, 5.0, math.sin(300.0 * x), x + noise, x + 1e4 * noise])

    looks = [slopes(figures, at, step) for step in (1e-2, 1e-2 / 16.0)]
    best, why = judged(looks, np.ones(7), 1e-5)
    assert why == ["", "corner", "jump", "", "", "", "unsettled"]
    exact = np.array([3.0 * at**2, math.nan, math.nan, 0.0, 300.0 * math.cos(300.0 * at), 1.0, math.nan])
    known = np.isfinite(exact)
    assert (np.abs(best.value - exact)[known] <= 2.0 * best.error[known] + 1e-12).all()
    assert best.error[[0, 3]] == approx(0.0, abs=1e-10)
    assert best.error[5] > 1e-6


def test_the_next_step_is_within_what_is_alike():
    assert narrower([True, True, True], 1.6) == 0.8
    assert narrower([False, True, True], 1.6) == 0.8
    assert narrower([True, False, True], 1.6) == 0.4
    assert narrower([False, True, False], 1.6) == 0.1


@pytest.mark.parametrize("method", ["modal", "fe-nodal"])
def test_what_steps_miss_is_in_the_error(method):
    """Against eight times the steps; a peak is known at steps alone, so its slope is first order in them."""
    scene = struck_rod(0.7, contact={"law": "hertz", "stiffness": 2.4e10})
    bare = METHODS[method].read({}).without_estimate()
    found = gradient(scene, OF, "impactor.mass", bare)
    steps = 8 * found.method["steps"]
    fine = gradient(scene, OF, "impactor.mass", METHODS[method].read({"steps": steps}))
    assert found.solves <= 3 + 8
    for name in OF:
        value, error = found.value[name]["impactor.mass"], found.error[name]["impactor.mass"]
        assert abs(value - fine.value[name]["impactor.mass"]) <= 2.0 * error + 1e-5 * abs(value), name
        assert error < 0.02 * abs(value), name


def test_steps_and_duration_that_are_given_are_kept():
    scene = struck_rod(0.7, contact={"law": "hertz", "stiffness": 2.4e10})
    found = gradient(scene, "impulse", "impactor.mass", Modal(modes=10, steps=4000))
    assert found.method["steps"] == 4000
    assert found.method["modes"] == 10


def test_the_figures_that_there_are_not_are_said_to_be_missing():
    found = gradient(on_stop(), ("peak_stress", "peak_force"))
    assert found.why["peak_stress"]["impactor.mass"].code == "no-such-figure-here"
    assert found.why["peak_force"]["impactor.mass"] is None


def test_a_number_at_its_bound_has_none():
    law = {"law": "hunt-crossley", "stiffness": 1e8, "restitution": 1.0}
    found = gradient(struck({"kind": "stop"}, law), "peak_force", ("contact.restitution", "impactor.mass"))
    assert found.why["peak_force"]["contact.restitution"].code == "one-side-allowed"
    assert math.isfinite(found.value["peak_force"]["impactor.mass"])


def test_an_estimated_error_is_worked_out_where_it_is_asked_for():
    scene = struck_rod(0.7, contact={"law": "hertz", "stiffness": 2.4e10})
    found = gradient(scene, "estimated_error", "impactor.mass", Modal(modes=10))
    assert found.figures["estimated_error"] > 0.0


def test_it_prints_as_a_table_as_a_card_and_as_json(monkeypatch):
    found = gradient(on_stop(), ("peak_force", "peak_stress"), ["impactor.mass", "contact.stiffness"])
    lines = str(found).splitlines()
    assert lines[3].split() == ["figure", "by", "derivative", "unit", "error", "elasticity"]
    assert lines[4].split()[:5] == ["peak", "force", "impactor.mass", "1060.66", "N/kg"]
    assert "this impact has no such figure" in str(found)
    assert "<td>contact.stiffness</td>" in found._repr_html_()
    assert "peak_force" in repr(found)
    tables = json.loads(json.dumps(found.table()))
    assert tables["value"]["peak_force"]["impactor.mass"] == approx(1060.660172)
    assert tables["value"]["peak_stress"]["impactor.mass"] is None
    assert tables["why"]["peak_stress"]["impactor.mass"]["code"] == "no-such-figure-here"
    monkeypatch.setenv("IMPACT_LANGUAGE", "es")
    assert "derivada" in str(found)


@pytest.mark.parametrize(
    "of, to, key",
    [
        ("peak_farce", "impactor.mass", "figures"),
        ((), "impactor.mass", "figures"),
        ("peak_force", "impactor.weight", "impactor.weight"),
        ("peak_force", "contact.law", "contact.law"),
        ("peak_force", "method.modes", "to"),
        ("peak_force", "target.velocity", "target.velocity"),
        ("peak_force", [], "number of keys"),
        ("peak_force", 7, "to"),
        ("peak_force", "impactor", "impactor"),
    ],
)
def test_what_cannot_be_is_refused(of, to, key):
    with pytest.raises(SceneError) as refused:
        gradient(on_stop(), of, to)
    assert refused.value.key == key


def test_whole_numbers_and_bodies_in_space_are_refused():
    with pytest.raises(SceneError, match="whole number"):
        gradient("four-bar", "impulse", "target.links.1.modes")
    space = next(name for name in solvers.scene_names() if solvers.load(name).normal is not None)
    with pytest.raises(SceneError, match="on an axis"):
        gradient(space, "impulse", "impactor.mass")
    with pytest.raises(SceneNotSupported):
        gradient(on_stop(), "impulse", "impactor.mass", "waves")


def test_units_of_derivatives():
    assert unit_of_slope("N", "kg") == "N/kg"
    assert unit_of_slope("N", "N/m^1.5") == "N/(N/m^1.5)"
    assert unit_of_slope("", "kg") == "1/kg"
    assert unit_of_slope("s", "") == "s"
    assert unit_of_slope("m/s", "m/s") == ""
