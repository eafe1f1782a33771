"""The ripple of a sum of modes or elements behind a front: told with its size wherever rigid faces of a rod meet."""

import pytest
from pytest import approx

import solvers
from solvers import Scene
from solvers.accuracy.auto import Auto
from solvers.methods.fronts import LEAST_RIPPLE, OF_LAW, OF_RIGID, RIPPLES, front_force, ripple

ROD = {"kind": "rod", "length": 0.1, "section": {"area": 1e-3}, "material": "steel"}
FREE = ROD | {"support": "free"}
MASS = {"kind": "mass", "mass": 100.0}
BEAM = {"kind": "beam", "length": 0.6, "section": {"radius": 0.01}, "material": "steel", "support": "pinned-pinned"}
PAIRS = {
    "rod on a stop": (ROD, {"kind": "stop"}),
    "rod on a mass": (ROD, MASS),
    "rod on a longer one": (ROD, FREE | {"length": 0.3}),
    "mass on a free rod": (MASS, FREE),
    "mass on a fixed rod": (MASS, ROD),
    "rod on a mass on a spring": (ROD, {"kind": "spring-mass", "mass": 100.0, "stiffness": 1e8}),
}
TRUNCATED = ("modal", "fe-modal", "fe-nodal", "balance")


def scene(pair: tuple[dict, dict], contact: dict | None = None) -> Scene:
    tables = {"impactor": pair[0] | {"velocity": 4.0}, "target": pair[1], "contact": contact or {"law": "rigid"}}
    return Scene.from_table(tables)


@pytest.mark.parametrize("method", TRUNCATED)
@pytest.mark.parametrize("pair", [pair for pair in PAIRS if pair != "mass on a fixed rod"])
def test_a_ripple_is_told_as_large_as_it_is(pair, method):
    """Nothing that comes back makes a larger force than that of the first front here: the peak is the ripple."""
    exact = solvers.solve(scene(PAIRS[pair]), method="waves")
    assert exact.peak_force == approx(front_force(exact.scene), rel=1e-9)
    assert not RIPPLES & {note.code for note in exact.notes}
    found = solvers.solve(scene(PAIRS[pair]), method=method)
    off = found.peak_force / exact.peak_force - 1.0
    told = [note.values for note in found.notes if note.code == OF_RIGID]
    assert abs(off) < LEAST_RIPPLE or len(told) == 1
    if told:
        # of a ripple as short as a step the instants looked at miss some
        assert told[0]["share"] == approx(100.0 * abs(off), rel=0.1, abs=3.0) and told[0]["over"] == (off > 0.0)


@pytest.mark.parametrize("method", TRUNCATED[:3])
def test_a_front_is_told_where_later_ones_are_larger(method):
    found = solvers.solve(scene(PAIRS["mass on a fixed rod"]), method=method)
    assert OF_RIGID in [note.code for note in found.notes]


def test_a_rod_that_meets_a_beam_presses_with_no_more_than_its_front():
    found = solvers.solve(scene((ROD, BEAM | {"at": 0.5})), method="modal")
    assert front_force(found.scene) == approx(found.scene.impactor.impedance * 4.0, rel=1e-12)


@pytest.mark.parametrize("law", [{"law": "linear"}, {"law": "power", "exponent": 1.1}, {"law": "hertz"}], ids=str)
@pytest.mark.parametrize("method", TRUNCATED[:3])
@pytest.mark.parametrize("pair", ["rod on a stop", "rod on a longer one"])
def test_a_law_is_told_of_where_it_ripples_and_only_there(pair, method, law):
    """A stiff one is nearly rigid; one that is soft has no front."""
    exponent = law.get("exponent", 1.5 if law["law"] == "hertz" else 1.0)
    for stiffness, ripples in ((1e12, True), (1e7, False)):
        law_scene = scene(PAIRS[pair], law | {"stiffness": stiffness * 1e5 ** (exponent - 1.0)})
        exact = solvers.solve(law_scene, method="waves")
        assert exact.peak_force <= front_force(law_scene) * (1.0 + 1e-6)
        found = solvers.solve(law_scene, method=method)
        told = [note.values for note in found.notes if note.code == OF_LAW]
        assert bool(told) == ripples
        if told:
            off = 100.0 * (found.peak_force / front_force(law_scene) - 1.0)
            assert told[0]["share"] == approx(off, rel=1e-9)


@pytest.mark.parametrize("rigid", [True, False])
def test_weight_adds_to_a_front_what_it_adds_to_the_speed(rigid):
    """A slow drop is three times as fast when its front is back: no ripple of the exact force, and none added."""
    contact = {"law": "rigid"} if rigid else {"law": "linear", "stiffness": 1e9}
    table = {"impactor": ROD | {"length": 20.0, "height": 1e-4}, "target": {"kind": "stop"}, "contact": contact}
    exact = solvers.solve(Scene.from_table(table), method="waves")
    assert exact.peak_force > 3.0 * front_force(exact.scene) and ripple(exact) == approx(0.0, abs=1e-9)
    found = solvers.solve(exact.scene, method="fe-modal")
    assert ripple(found) < 0.25


@pytest.mark.parametrize("among", [("modal", "fe-modal"), ("fe-modal", "fe-nodal"), ("modal", "balance")])
def test_two_that_ripple_alike_prove_nothing(among):
    true = scene(PAIRS["rod on a stop"])
    found = Auto(quantity="peak-force", tolerance=0.1, among=among, budget=1.5).solve(true)
    chosen = next(note.values for note in found.notes if note.code == "chosen")
    off = abs(found.peak_force / front_force(true) - 1.0)
    assert chosen["error"] is None or chosen["error"] >= 0.98 * off


def test_the_peak_is_found_by_waves_where_rods_strike():
    found = Auto(quantity="peak-force", tolerance=0.01).solve(scene(PAIRS["rod on a stop"]))
    assert found.method["name"] == "waves" and found.peak_force == approx(front_force(found.scene), rel=1e-9)


def test_others_are_not_measured_by_one_that_ripples():
    rows = solvers.compare(scene((ROD, BEAM)), ["modal", "fe-modal"], repeats=1)
    assert OF_RIGID in [note.code for note in rows.exact.notes]
    assert all(row.force_error is None and row.resolved_force_error is None for row in rows)
    rows = solvers.compare(scene(PAIRS["rod on a stop"]), ["waves", "fe-modal"], repeats=1)
    assert rows.exact.method["name"] == "waves" and rows[0].force_error == approx(0.0, abs=1e-9)
    assert rows[1].force_error > 0.01
