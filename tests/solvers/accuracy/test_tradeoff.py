"""Time against error: what is measured, what it is measured by, and how it ends."""

import json
import math
import os

import numpy as np
import pytest
from pytest import approx

import solvers
from bench.tradeoffs import impacts_of, outdated, renew
from solvers import METHODS, ContactPeriod, SceneError, SceneNotSupported, TradeOff, tradeoff
from solvers.accuracy import store
from solvers.accuracy import tradeoff as measuring
from solvers.accuracy.quantities import QUANTITIES, Metrics, Reference
from solvers.accuracy.refinement import ladders, refusals
from solvers.accuracy.tradeoff import _beyond
from solvers.accuracy.tradeoff_table import Point, ReferenceInfo
from solvers.regimes.models import QUESTIONS, errors, figures
from solvers.text.notes import Note, Severity
from tests.catalog import bronze_rod, struck_rod


def until(label: str, seen: list):
    """Cancel once there is this point: what is measured by then does not depend on how busy the machine is."""
    return lambda: bool(seen) and label in [point.label for point in seen[-1].points]


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(measuring, "TIMED", 0.0)  # one repeat is enough here
    return tmp_path


@pytest.fixture(scope="module")
def rod_table(tmp_path_factory):
    os.environ["XDG_CACHE_HOME"], before = str(tmp_path_factory.mktemp("cache")), os.environ.get("XDG_CACHE_HOME")
    seen = []
    found = tradeoff(struck_rod(1.0), progress=seen.append, cancel=until("modal modes=25", seen), seconds=600.0)
    os.environ.pop("XDG_CACHE_HOME") if before is None else os.environ.update(XDG_CACHE_HOME=before)
    return found, seen


def errors_by_label(found: TradeOff) -> dict[str, dict]:
    return {point.label: point.errors for point in found.points}


def test_every_method_that_can_has_points_and_the_others_say_why(rod_table):
    found, _ = rod_table
    assert {point.method["name"] for point in found.points} == set(METHODS)
    assert found.refused == {}
    scene = bronze_rod()
    assert refusals(scene) == {"mode-switch": METHODS["mode-switch"].read({}).refusal(scene)}
    assert {ladder.levels[0].NAME for ladder in ladders(scene)} == set(METHODS) - {"mode-switch"}


def test_errors_are_those_of_the_solutions_themselves(rod_table):
    found, _ = rod_table
    scene = struck_rod(1.0)
    exact, modal = solvers.solve(scene), solvers.solve(scene, "modal", modes=25)
    errors = errors_by_label(found)["modal modes=25"]
    assert errors["rebound"] == approx((modal.impactor_velocity - exact.impactor_velocity) / scene.speed, rel=1e-12)
    assert errors["impulse"] == approx(modal.impulse / exact.impulse - 1.0, rel=1e-9)
    assert errors["peak-force"] == approx(modal.peak_force / exact.peak_force - 1.0, rel=1e-12)
    assert errors["energy"] == modal.diagnostics["energy_error"]
    (row,) = solvers.compare(scene, [solvers.Modal(modes=25)], repeats=1)
    assert errors["force-history"] == approx(row.force_error, rel=0.01)  # the same norm on other samples
    assert errors["resolved-force"] == approx(row.resolved_force_error, rel=0.01)
    point = next(point for point in found.points if point.label == "modal modes=25")
    assert (point.true_contacts, point.true_contacts_found) == (2, row.true_contacts_found)
    assert point.estimated_error == modal.diagnostics["estimated_error"]


def test_the_reference_is_the_exact_one_where_there_is_one(rod_table):
    found, _ = rod_table
    assert found.reference.kind == "exact" and "travelling waves" in found.reference.words
    exact = errors_by_label(found)["waves"]
    assert all(error == 0.0 for name, error in exact.items() if name != "energy")
    assert found.reference.uncertainty["rebound"] <= 1e-14  # rounding: see waves


def test_an_impact_of_no_duration_has_neither_force_nor_peak(rod_table):
    found, _ = rod_table
    errors = errors_by_label(found)["rigid"]
    assert errors["peak-force"] is errors["force-history"] is None
    assert errors["contact-time"] is None
    # a wall of restitution 1 sends the mass back as it came; thesis (4.37): exactly 0.69888 of it
    assert errors["rebound"] == approx(-1.0 + 0.6988755819961635, abs=1e-12)


def test_finer_is_nearer_and_times_are_of_warm_solves(rod_table):
    found, _ = rod_table
    modal = [point for point in found.points if point.ladder == "modal by modes"]
    assert [point.size for point in modal] == [6, 12, 25]
    assert modal[2].errors["resolved-force"] < modal[0].errors["resolved-force"]
    for point in found.points:
        assert point.wall_time > 0.0
        assert point.spread is None or point.spread[0] <= point.wall_time <= point.spread[1]
        assert (point.spread is None) == (point.repeats == 1)


def test_the_table_grows_point_by_point_the_error_of_each_known(rod_table):
    found, seen = rod_table
    assert [len(table.points) for table in seen] == list(range(1, len(seen) + 1))
    assert {table.stopped for table in seen} == {"under way"} and found.stopped == "cancelled"
    count = len(ladders(struck_rod(1.0)))
    assert len({point.ladder for point in seen[count - 1].points}) == count  # the whole field first
    assert len(found.points) == len(seen)


def test_nothing_beats_a_point_of_the_front(rod_table):
    found, _ = rod_table
    for quantity in ("rebound", "peak-force"):
        front = found.front(quantity)
        known = [point for point in found.points if point.errors[quantity] is not None]
        assert front
        for best in front:
            for point in known:
                quicker = point.wall_time < best.wall_time
                assert not (quicker and abs(point.errors[quantity]) <= abs(best.errors[quantity]))


def test_errors_below_the_uncertainty_are_equal():
    def point(wall_time: float, error: float) -> Point:
        return Point(
            {"name": "modal"}, "modal", None, None, wall_time, None, 1, 0.1, None, {"rebound": error}, 1, 1, 1, 0
        )

    points = [point(1.0, 0.1), point(2.0, 0.01), point(3.0, -0.001), point(4.0, 0.05)]
    reference = ReferenceInfo("converged", {}, {"rebound": 0.01}, "")
    found = TradeOff({}, {"rebound": ""}, reference, points, {}, [], {}, "", "", 0.0)
    assert found.front("rebound") == points[:2]


def test_the_table_is_plain_data_and_comes_back(rod_table):
    found, _ = rod_table
    text = json.dumps(found.table(), allow_nan=False)
    again = TradeOff.from_table(json.loads(text))
    assert again == found
    assert json.dumps(again.table()) == text
    assert any("rebound" in row["best_for"] for row in json.loads(text)["points"])


def test_a_converged_reference_says_how_uncertain_it_is():
    scene = solvers.load("two-balls")  # no waves anywhere: refined in steps
    seen = []
    found = tradeoff(scene, progress=seen.append, cancel=until("quasi-static model=local", seen), seconds=600.0)
    assert found.reference.kind == "converged"
    assert found.reference.method["name"] == "modal"
    assert found.reference.method not in [point.method for point in found.points]
    # second order in the steps: of the 0.4 % at 100 a quarter is left at 200, which the reference has at least
    assert 0.0 < found.reference.uncertainty["peak-force"] < 4e-3
    # closed form; the reference is not further from it than it says
    exact = errors_by_label(found)["quasi-static model=local"]["peak-force"]
    assert abs(exact) < found.reference.uncertainty["peak-force"]


def test_a_rougher_method_does_not_make_the_reference_uncertain():
    # they differ by 0.004, of which the rougher one, which moved by 0.08 when last refined, says nothing
    assert _beyond(0.004, 0.08) == 0.0
    assert _beyond(-0.004, 0.001) == 0.004
    assert _beyond(None, 0.1) is None


def test_without_anything_to_refine_the_closed_form_stands_alone():
    found = tradeoff(solvers.load("brick-off-centre"))
    assert found.reference.kind == "closed form"
    (point,) = found.points
    assert point.errors["rebound"] == 0.0 and point.errors["peak-force"] is None
    assert set(found.refused) == set(METHODS) - {"rigid"}


def test_a_peak_that_never_comes_nearer_is_named():
    seen = []
    ringing = tradeoff(
        struck_rod(0.5, "free"), progress=seen.append, cancel=until("modal modes=50", seen), seconds=600.0
    )
    # a truncated series overshoots every jump by 9 % of it, however many terms: Gibbs
    assert any((r.values.get("ladder"), r.values.get("quantity")) == ("modal", "peak-force") for r in ringing.remarks)


def test_cancelling_gives_what_there_is():
    seen = []
    found = tradeoff(struck_rod(1.0, speed=1.5), cancel=lambda: len(seen) >= 3, progress=seen.append)
    assert found.stopped == "cancelled" and len(found.points) == 3
    assert solvers.stored_tradeoff(struck_rod(1.0, speed=1.5)) is None  # half a table is not kept
    assert tradeoff(struck_rod(1.0), cancel=lambda: True).points == []


def test_a_complete_table_is_kept_for_this_scene_only(own_cache):
    brick = solvers.load("brick-off-centre")
    scene = brick.replace({"impactor.mass": 1.5 * brick.impactor.mass})  # another than the shipped one
    first = tradeoff(scene)
    assert tradeoff(scene) == first
    renamed = scene.replace({"title": "The same impact"})
    assert solvers.stored_tradeoff(renamed) == first  # a name changes nothing that happens
    assert solvers.stored_tradeoff(scene.replace({"impactor.mass": 2.0 * scene.impactor.mass})) is None
    assert tradeoff(scene, fresh=True) != first
    for path in own_cache.rglob("*.json"):
        path.write_text("{half a")
    assert solvers.stored_tradeoff(scene) is None


def test_a_hasty_table_does_not_stand_for_later_ones(own_cache):
    brick = solvers.load("brick-off-centre")
    scene = brick.replace({"impactor.mass": 1.5 * brick.impactor.mass})
    tradeoff(scene, seconds=0.1)
    assert solvers.stored_tradeoff(scene) is None


def test_a_cache_that_cannot_be_written_costs_nothing_but_time(monkeypatch, tmp_path):
    file = tmp_path / "in-the-way"
    file.write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(file))
    found = tradeoff(solvers.load("brick-off-centre"))
    assert len(found.points) == 1


def test_an_impulse_with_friction_is_rated_by_its_normal_part(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    found = tradeoff(solvers.load("note-rod-friction").replace({"impactor.velocity": [-3.0, -2.0, 0.9]}))
    (point,) = found.points
    assert point.errors["impulse"] == 0.0


@pytest.mark.parametrize("name", ["fixed-rod", "free-rod", "bronze-rod-steel-ball", "sphere-on-half-space"])
def test_shipped_scenes_bring_their_table(name):
    found = solvers.stored_tradeoff(solvers.load(name))
    assert found.stopped is None and found.machine["processor"] and found.date
    assert found.seconds < 20.0
    scene = solvers.load(name)
    labels = errors_by_label(found)
    assert len(labels) > 8
    if found.reference.kind == "exact":  # measured then, recomputed now: only the machine has changed
        errors = Reference.of(solvers.solve(scene, "waves")).errors(Metrics.of(solvers.solve(scene, "modal", modes=50)))
        assert labels["modal modes=50"]["rebound"] == approx(errors["rebound"], abs=1e-7)


@pytest.mark.slow
def test_every_stored_table_belongs_to_a_scene_that_comes_with_the_library():
    tables = impacts_of(solvers.scene_names())
    for path in store.SHIPPED.glob("*.json"):
        scene, called = tables[path.stem]  # KeyError: of no scene any more
        assert path.stat().st_size < 3_000 + 300 * len(solvers.stored_tradeoff(scene).points)
        for name in called:
            found = solvers.stored_tradeoff(solvers.load(name))
            assert {"processor", "cores", "python"} <= set(found.machine) and found.date and found.stopped is None
            assert found.reference.kind in ("exact", "converged", "closed form") and found.reference.words
            assert found.scene == solvers.load(name).table()
            assert set(found.quantities) == set(QUANTITIES) and found.points
            assert {point.method["name"] for point in found.points} <= {
                ladder.levels[0].NAME for ladder in ladders(scene)
            }


def test_every_scene_that_some_method_can_solve_brings_its_table():
    for scene, called in impacts_of(solvers.scene_names()).values():
        if ladders(scene):
            table = store.shipped(scene)
            assert table is not None, called
            assert table["points"] and table["seconds"] < 20.0


def test_a_table_is_packed_without_losing_what_is_read(rod_table):
    found, _ = rod_table
    scene = struck_rod(1.0)
    packed = json.loads(json.dumps(store.pack(found.table()), allow_nan=False))
    again = TradeOff.from_table(store.unpack(packed, scene))
    for point, kept in zip(found.points, again.points, strict=True):
        assert kept.wall_time == approx(point.wall_time, rel=5e-4)
        for quantity, error in point.errors.items():
            assert kept.errors[quantity] == (None if error is None else approx(error, rel=5e-5))
        exact = ("method", "ladder", "resolution", "size", "contacts", "invented_contacts", "repeats", "label")
        assert [getattr(kept, name) for name in exact] == [getattr(point, name) for name in exact]
        assert_same(kept.notes, point.notes)
    assert again.refused == found.refused
    assert_same(again.remarks, found.remarks)


def assert_same(kept, notes) -> None:
    """Notes of the same codes and values: numbers to the five digits that are kept, of which a sentence shows three."""
    for one, other in zip(kept, notes, strict=True):
        assert (one.code, one.severity) == (other.code, other.severity)
        assert one.values.keys() == other.values.keys()
        for name, value in other.values.items():
            assert one.values[name] == (approx(value, rel=5e-5) if isinstance(value, float) else value)


def test_what_notes_of_a_code_share_is_kept_once():
    notes = [Note("few-steps-in-contact", Severity.WARNING, steps=steps, needed=-3.5e-7).table() for steps in (4, 5)]
    point = {"method": {"name": "rigid"}, "ladder": "rigid", "knob": None, "size": None, "errors": {}}
    packed = store.pack({"points": [point | {"note_codes": notes}], "reference": None})
    assert packed["codes"] == [["few-steps-in-contact", "warning", "steps", "needed"]]
    packed["points"].setdefault("errors", {})
    assert store.unpack(packed, struck_rod(1.0))["points"][0]["note_codes"] == notes


def test_half_a_measurement_of_the_shipped_tables_goes_on_where_it_was(tmp_path, capsys):
    folder = tmp_path / "tables"
    renew(["brick-off-centre"], folder)
    (path,) = folder.iterdir()
    before = path.stat().st_mtime_ns
    scene = solvers.load("brick-off-centre")
    assert outdated(path, scene) == [] and "1 points" in capsys.readouterr().out
    assert json.loads(path.read_text())["calibration"].keys() == {"python", "kernels", "algebra"}
    renew(["brick-off-centre"], folder)  # named: renewed
    assert path.stat().st_mtime_ns > before
    path.write_text(path.read_text().replace('"rigid":"', '"rigid":"older '))
    assert outdated(path, scene) == ["rigid"]
    path.write_text(path.read_text().replace('"rigid":"', '"waves":"'))
    assert outdated(path, scene) == ["rigid", "waves"]  # the one is missing, the other cannot solve it
    path.write_text("{half a")
    assert outdated(path, scene) == ["table"]


def test_a_question_that_does_not_exist_is_refused():
    with pytest.raises(SceneError, match="quantity: got 'speed'; allowed: 'rebound'"):
        tradeoff(struck_rod(1.0), quantities=["speed"])
    with pytest.raises(SceneError, match="seconds"):
        tradeoff(struck_rod(1.0), seconds=math.nan)


def test_a_scene_that_no_method_can_solve_says_why_each_cannot(monkeypatch):
    for method in METHODS.values():
        monkeypatch.setattr(method, "refusal", lambda self, scene: Note("no-impact", Severity.REFUSAL, parts=True))
    with pytest.raises(SceneNotSupported, match="'waves': The bodies move apart"):
        tradeoff(struck_rod(1.0))


def test_only_the_quantities_asked_for_are_shown():
    found = tradeoff(solvers.load("brick-off-centre"), quantities=["impulse"])
    assert found.quantities == {"impulse": QUANTITIES["impulse"]}


@pytest.mark.parametrize(
    "true, found, error",
    [
        ([(0.0, 2.0)], [(0.0, 2.0)], 0.0),
        ([(0.0, 2.0)], [(0.0, 1.0)], -0.5),
        ([(0.0, 2.0), (3.0, 5.0)], [(0.0, 2.0)], -0.6),  # a missed contact
        ([(0.0, 2.0)], [(0.0, 2.0), (4.0, 5.0)], 1.5),  # an invented one
        ([(0.0, 2.0), (3.0, 5.0)], [(0.0, 4.0), (4.5, 5.0)], 0.0),  # how long they really touch is another question
        ([(0.0, 2.0)], [(0.0, 0.0)], None),
        ([(0.0, 0.0)], [(0.0, 1.0)], None),
    ],
)
def test_contact_times(true, found, error):
    """From first touch to last parting, unknown of an impact of no duration."""
    answers = [
        Metrics(
            np.ones(1), 1.0, 1.0, tuple(ContactPeriod(*pair, 1.0, 1.0) for pair in pairs), 0.0, np.ones(1), None, None
        )
        for pairs in (true, found)
    ]
    reported = Reference(struck_rod(), None, answers[0]).errors(answers[1])["contact-time"]
    assert reported == (None if error is None else approx(error))


@pytest.mark.parametrize("name", ["fixed-rod", "bronze-rod-steel-ball", "table-8.4"])
def test_contact_times_mean_the_same_to_the_planner_and_to_a_tolerance(name):
    scene = solvers.load(name)
    fine, coarse = (solvers.Modal(modes=modes, estimate=False).solve(scene) for modes in (20, 6))
    reported = Reference.of(fine, False).errors(Metrics.of(coarse, False))["contact-time"]
    foretold = errors(figures(coarse), figures(fine))[QUESTIONS.index("contact-times")]
    assert abs(reported) == approx(foretold, rel=1e-12) and foretold > 1e-6
    apparent = [solvers.contact_times(solution).apparent for solution in (coarse, fine)]
    assert reported == approx(apparent[0] / apparent[1] - 1.0, rel=1e-9)


def test_the_key_of_a_scene_is_what_happens_in_it():
    scene = solvers.load("fixed-rod")
    key = store.scene_key(scene)
    assert store.scene_key(scene.replace({"method": {"name": "modal"}, "note": "x"})) == key
    assert store.scene_key(scene.replace({"impactor.velocity": 2.0})) != key
