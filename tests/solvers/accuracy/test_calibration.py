"""How fast this machine is: what is kept of it, and what is scaled by it."""

import json

import pytest
from pytest import approx

import solvers
from solvers.accuracy import calibration, store
from solvers.accuracy.cost_model import AS_MEASURED, expected_time, kinds, scaled_time, stored_costs
from solvers.accuracy.three_solves import SOLVES
from solvers.accuracy.tradeoff_table import TradeOff
from tests.catalog import struck_rod

THERE = {"python": 1e-3, "kernels": 2e-2, "algebra": 3e-2}


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path


@pytest.fixture
def here(monkeypatch):
    """This machine, where everything takes so many times as long as there."""

    def taking(**times: float):
        monkeypatch.setattr(calibration, "known", lambda: {kind: times[kind] * THERE[kind] for kind in THERE})

    return taking


@pytest.fixture
def costs(monkeypatch):
    """Constants of cost as measured there."""
    monkeypatch.setitem(stored_costs(), "calibration", THERE)


def test_three_solves_are_kept_for_this_machine_and_this_code(own_cache):
    assert calibration.known() is None and calibration.factors(THERE) is None
    found = solvers.calibrate(0.01)
    assert found.keys() == SOLVES.keys() == THERE.keys() and min(found.values()) > 0.0
    (path,) = own_cache.rglob("calibration-*.json")
    assert calibration.known() == found == json.loads(path.read_text())
    calibration._known.clear()  # as in another process
    assert calibration.known() == found
    assert calibration.factors(found) == approx(AS_MEASURED)


@pytest.mark.parametrize(
    "text", ["{half a", "[1.0, 2.0]", '{"python": 1.0}', '{"python": 0.0, "kernels": 1.0, "algebra": 1.0}']
)
def test_what_cannot_be_read_is_as_if_it_were_not_there(own_cache, text):
    (own_cache / "strikewave").mkdir()
    calibration._path().write_text(text)
    assert calibration.known() is None
    assert calibration.factors({"python": 1.0}) is None


def test_a_cache_that_cannot_be_written_costs_nothing_but_time(own_cache, monkeypatch):
    (own_cache / "strikewave").write_text("in the way")
    assert solvers.calibrate(0.01) == calibration.known()


def test_a_factor_beyond_all_machines_is_bounded(here):
    here(python=1e6, kernels=1e-6, algebra=1.0)
    assert calibration.factors(THERE) == {"python": calibration.MOST, "kernels": calibration.LEAST, "algebra": 1.0}


def test_each_part_of_a_cost_goes_by_a_solve_of_its_kind(here, costs, monkeypatch):
    scene, method = struck_rod(), {"name": "modal", "modes": 100}
    monkeypatch.setitem(stored_costs()["seconds"], kinds(method, scene)[0], [2e-3, 1e-7, 1e-9, 4e-9])
    expected = {"python": 2e-3, "kernels": 1000 * (1e-7 + 1e-9 * 100), "algebra": 4e-9 * 100**3}
    assert expected_time(method, 1000, scene) == approx(sum(expected.values()))  # not calibrated: as it was there
    for kind in THERE:
        here(**(dict.fromkeys(THERE, 1.0) | {kind: 3.0}))
        assert expected_time(method, 1000, scene) == approx(sum(expected.values()) + 2.0 * expected[kind])
        # of a time that was measured, what is not known to be of Python or of linear algebra is of kernels
        measured = 9e-3
        parts = expected | {"kernels": measured - expected["python"] - expected["algebra"]}
        assert scaled_time(measured, method, scene, THERE) == approx(measured + 2.0 * parts[kind])
        assert scaled_time(1e-3, method, scene, THERE) == approx(1e-3 * (3.0 if kind == "python" else 1.0))


def test_a_table_that_came_with_the_library_is_scaled_and_says_so(here, costs, monkeypatch):
    scene = solvers.load("bronze-rod-steel-ball")
    shipped = TradeOff.from_table(store.shipped(scene) | {"calibration": THERE})
    monkeypatch.setattr(store, "shipped", lambda scene: shipped.table())
    plain = solvers.stored_tradeoff(scene)
    assert plain.shipped and plain.scale is None and plain.points == shipped.points
    here(python=3.0, kernels=3.0, algebra=3.0)
    scaled = solvers.stored_tradeoff(scene)
    assert scaled.shipped and scaled.scale == approx(dict.fromkeys(THERE, 3.0))
    assert scaled.machine == shipped.machine
    for point, known in zip(scaled.points, shipped.points, strict=True):
        assert point.wall_time == approx(3.0 * known.wall_time)
        assert point.spread is None or point.spread == approx([3.0 * each for each in known.spread])
        assert point.errors == known.errors


def test_a_table_without_a_calibration_is_left_as_it_was_measured(here, monkeypatch):
    scene = solvers.load("bronze-rod-steel-ball")
    known = store.shipped(scene) | {"calibration": None}
    monkeypatch.setattr(store, "shipped", lambda scene: known)
    here(python=3.0, kernels=3.0, algebra=3.0)
    found = solvers.stored_tradeoff(scene)
    assert found.shipped and found.scale is None


def test_what_was_measured_here_is_neither_shipped_nor_scaled(here):
    here(python=3.0, kernels=3.0, algebra=3.0)
    scene = solvers.load("brick-off-centre").replace({"impactor.mass": 2.5})
    measured = solvers.tradeoff(scene)
    found = solvers.stored_tradeoff(scene)
    assert found == measured and not found.shipped and found.scale is None and found.changed == []
    assert measured.code.keys() == {"errors", "rigid"}
