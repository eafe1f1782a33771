"""A scene turned round: all values of a key for which a figure is as wanted, and jumps over that value."""

import json
import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers.studies.crossings import Crossings
from solvers.text.notes import Note, Severity

MASS, SPEED = 2.0, 3.0


@pytest.fixture(scope="module")
def stop():
    """A mass on a linear spring: its peak force is v √(k m)."""
    return solvers.Scene.from_table(
        {
            "impactor": {"kind": "mass", "mass": MASS, "velocity": SPEED},
            "target": {"kind": "stop"},
            "contact": {"law": "linear", "stiffness": 1e5},
            "method": {"name": "quasi-static"},
        }
    )


@pytest.fixture(scope="module")
def drop():
    """A mass that fell 0.75 m on the middle of a steel beam through a pad."""
    return solvers.Scene.from_table(
        {
            "impactor": {"kind": "mass", "mass": 2.0, "velocity": 3.836},
            "target": {
                "kind": "beam",
                "length": 1.2,
                "section": {"width": 0.06, "height": 0.01},
                "material": "steel",
                "support": "pinned-pinned",
                "at": 0.5,
            },
            "contact": {"law": "linear", "stiffness": 1e6},
            "method": {"name": "modal", "modes": 10},
        }
    )


def crossings(function, wanted: float, low: float, high: float, count: int = 60) -> Crossings:
    found = Crossings(function, wanted)
    found.search(np.linspace(low, high, count).tolist())
    return found


def values(found: solvers.Sought) -> list[float]:
    return [root.value for root in found.roots]


def peak(scene: solvers.Scene, stiffness: float) -> float:
    return solvers.solve(scene.replace({"contact.stiffness": stiffness})).peak_force


@pytest.mark.parametrize("force, between", [(2e3, (1e4, 9e5)), (700.0, (2e4, 5e4)), (150.0, (1.0, 1e8))])
def test_the_spring_for_a_peak_force_is_exact(stop, force, between):
    found = solvers.seek(stop, "contact.stiffness", between, {"peak_force": force})
    (root,), exact = found.roots, (force / SPEED) ** 2 / MASS
    assert root.value == approx(exact, rel=1e-9)
    assert root.slope == approx(0.5 * force / exact, rel=1e-4) and root.elasticity == approx(0.5, rel=1e-4)
    assert (found.stretches, found.jumps, found.nearest, found.refused) == ([], [], None, 0)
    assert found.notes[0].values["by_factor"] == (between[1] >= 100.0 * between[0])


def test_all_springs_under_a_beam_for_a_peak_force(drop):
    """The peak is not monotone: between 6e5 and 6.4e5 N/m it falls."""
    assert (peak(drop, 6e5), peak(drop, 6.4e5)) == (approx(2831, abs=1), approx(2752, abs=1))
    (one,) = solvers.seek(drop, "contact.stiffness", (2e5, 2e6), {"peak_force": 3e3}).roots
    assert one.value == approx(792_301, rel=1e-5) and peak(drop, one.value) == approx(3e3, rel=1e-9)
    three = solvers.seek(drop, "contact.stiffness", (2e5, 2e6), {"peak_force": 2.8e3})
    assert [peak(drop, value) for value in values(three)] == approx([2.8e3] * 3, rel=1e-9)
    assert [math.copysign(1.0, root.slope) for root in three.roots] == [1.0, -1.0, 1.0]


def test_two_values_between_two_samples_are_found(drop):
    found = solvers.seek(drop, "contact.stiffness", (2e5, 2e6), {"peak_force": 2757.0})
    assert [peak(drop, value) for value in values(found)] == approx([2757.0] * 3, rel=1e-9)
    assert 0.0 < values(found)[2] - values(found)[1] < found.notes[0].values["step"]


def test_a_count_of_contacts_holds_over_stretches_and_jumps_past_a_half():
    whole = solvers.seek("fixed-rod", "impactor.mass", (0.2, 20.0), {"contacts": 2})
    half = solvers.seek("fixed-rod", "impactor.mass", (0.2, 20.0), {"contacts": 1.5})
    assert whole.roots == half.roots == half.stretches == whole.jumps == []
    ends = [end for stretch in whole.stretches for end in stretch]
    assert [jump.value for jump in half.jumps] == approx(ends, rel=1e-8) and len(ends) == 6
    assert [(jump.below, jump.above) for jump in half.jumps] == [(1, 2), (2, 1)] * 3
    counts = [
        len(solvers.solve(solvers.load("fixed-rod").replace({"impactor.mass": m})).contacts) for m in (2.11, 2.111)
    ]
    assert counts == [1, 2] and 2.11 < ends[0] < 2.111
    assert whole.nearest is None and half.nearest is not None and half.nearest[1] in (1.0, 2.0)
    assert "3 ranges of values" in str(whole) and "jump at 2.110416 kg, from 1 to 2" in str(half)


def test_the_nearest_is_named_where_no_value_will_do(stop):
    found = solvers.seek(stop, "contact.stiffness", (1e4, 1e5), {"peak_force": 1e4})
    assert found.roots == [] and found.nearest == (1e5, approx(SPEED * math.sqrt(1e5 * MASS)))
    assert "no value" in str(found) and "nearest: peak_force = 1341.6408 N" in str(found)


def test_refused_values_are_holes_that_notes_count(stop):
    found = solvers.seek(stop, "impactor.mass", (-1.0, 3.0), {"peak_force": 300.0})
    assert values(found) == approx([0.1], rel=1e-9) and found.refused == 15
    (note,) = (note for note in found.notes if note.code == "sought-with-holes")
    assert (
        note.severity is Severity.WARNING
        and "15 of the 60 values" in str(note)
        and "impactor.mass = -1; allowed: a number" in str(note)
    )
    edge = solvers.seek(stop, "impactor.mass", (-1.0, 3.0), {"peak_force": 3.0 * math.sqrt(1e5 * 1e-3)})
    assert values(edge) == approx([1e-3], rel=1e-8)  # between the hole and the first sample


def test_warnings_on_the_solution_stand_beside_its_value(drop):
    far = solvers.seek(drop, "contact.stiffness", (2e5, 2e6), {"peak_force": 3e3})
    alone = solvers.solve(drop.replace({"contact.stiffness": far.roots[0].value})).notes
    grave = [note.code for note in alone if note.severity in (Severity.WARNING, Severity.INVALID)]
    assert [note.code for note in far.roots[0].notes] == grave != []
    assert str(far).splitlines()[4].endswith(" ".join(grave))


def test_values_at_which_the_figure_is_chaotic_are_not_firm(drop):
    """Modes in rigid contact chatter: the rebound follows the mass in leaps."""
    scene = drop.replace({"contact": {"law": "rigid"}, "target.length": 0.5, "impactor.velocity": 1.0})
    scene = scene.replace({"target.section": {"width": 0.03, "height": 0.02}})
    found = solvers.seek(scene, "impactor.mass", (0.5, 5.0), {"impactor_velocity": -0.5})
    steep = [root for root in found.roots if abs(root.elasticity) > 100.0]
    (note,) = (note for note in found.notes if note.code == "sought-where-steep")
    assert note.values["steep"] == len(steep) > 2


def test_what_auto_chooses_once_solves_all(stop):
    scene = stop.replace({"method": {"name": "auto", "quantity": "peak-force", "tolerance": 1e-3}})
    found = solvers.seek(scene, "contact.stiffness", (1e5, 4e5), {"peak_force": 2e3}, samples=5)
    assert values(found) == approx([(2e3 / SPEED) ** 2 / MASS], rel=4e-3)
    assert found.method in solvers.METHODS and found.notes[-1].code == "sought-by-one-method"


def test_an_answer_is_data_a_table_and_a_card(stop):
    found = solvers.seek(stop, "contact.stiffness", (1e4, 9e5), {"peak_force": 2e3})
    table = json.loads(json.dumps(found.table(), allow_nan=False))
    assert set(table) == {
        "method", "key", "unit", "low", "high", "figure", "figure_unit", "wanted", "roots", "stretches", "jumps",
        "nearest", "samples", "refused", "notes", "note_codes",
    }  # fmt: skip
    assert table["roots"] == [found.roots[0].table()] and table["unit"] == "N/m"
    assert [Note.from_table(code) for code in table["note_codes"]] == found.notes
    assert "contact.stiffness [N/m]" in str(found) and "slope [N/(N/m)]" in found._repr_html_()
    assert repr(found) == "<Sought: contact.stiffness such that peak_force = 2000: 1 roots, 0 stretches, 0 jumps>"


@pytest.mark.parametrize(
    "key, between, such_that, said",
    [
        ("contact.stiff", (1.0, 2.0), {"peak_force": 1.0}, "contact.stiff: got 1.0; allowed: no such key"),
        ("contact.stiffness", (2.0, 1.0), {"peak_force": 1.0}, "between: got (2.0, 1.0); allowed: two finite numbers"),
        ("contact.stiffness", (1.0, math.inf), {"peak_force": 1.0}, "between: got inf; allowed: a finite number"),
        ("contact.stiffness", 7.0, {"peak_force": 1.0}, "between: got 7.0; allowed: two finite numbers"),
        ("contact.stiffness", (1.0, 2.0), {"peak": 1.0}, "such_that: got 'peak'; allowed: 'contacts', "),
        ("contact.stiffness", (1.0, 2.0), {"peak_force": math.nan}, "such_that.peak_force: got nan; allowed: a finite"),
        ("contact.stiffness", (1.0, 2.0), {}, "such_that: got {}; allowed: one figure with the value"),
        (
            "contact.stiffness",
            (1.0, 2.0),
            {"peak_moment": 1.0},
            "peak_moment: got nothing; allowed: a figure that this",
        ),
        ("impactor.mass", (-2.0, -1.0), {"peak_force": 1.0}, "impactor.mass: got -2.0; allowed: a number from"),
    ],
)
def test_refusals_name_what_is_allowed(stop, key, between, such_that, said):
    with pytest.raises(solvers.SceneError) as refused:
        solvers.seek(stop, key, between, such_that)
    assert str(refused.value).startswith(said)


def test_whole_numbers_and_bodies_in_space_are_refused(drop):
    with pytest.raises(solvers.SceneError, match=r"^key: got 'method\.modes'; allowed"):
        solvers.seek(drop, "method.modes", (1, 20), {"peak_force": 3e3})
    with pytest.raises(solvers.SceneError, match="bodies on an axis"):
        solvers.seek("note-rod", "method.restitution", (0.0, 1.0), {"impulse": 1.0})


# --- functions that are known ---


def test_a_pair_between_two_samples_and_one_that_touches():
    pair = crossings(lambda x: (x - 1.2345) ** 2, 1e-7, 0.0, 3.0).roots
    assert pair == approx([1.2345 - 1e-7**0.5, 1.2345 + 1e-7**0.5], rel=1e-9)
    assert crossings(lambda x: 1.0 + (x - 1.2345) ** 2, 1.0, 0.0, 3.0).roots == approx([1.2345], rel=1e-6)
    assert crossings(lambda x: 1.1 + (x - 1.2345) ** 2, 1.0, 0.0, 3.0).roots == []


def test_a_jump_between_two_roots_is_no_root():
    found = crossings(lambda x: x - 5.0 * (x > math.pi), 2.0, 0.0, 10.0)
    ((at, below, above),) = found.jumps
    assert found.roots == approx([2.0, 7.0]) and at == approx(math.pi, rel=1e-9)
    assert (below, above) == (approx(math.pi), approx(math.pi - 5.0))


def test_a_steep_root_is_no_jump_and_a_slope_crosses_none():
    assert crossings(lambda x: math.cbrt(x - 5.0), 0.0, 0.0, 10.1).jumps == []
    found = crossings(lambda x: 3.0 * x + 100.0 * (x > 2.00001), 6.0, 0.0, 10.0)
    assert found.roots == approx([2.0]) and found.slope(2.0, 10.0 / 59.0, 0.0, 10.0) == approx(3.0)


def test_a_hole_within_the_samples_hides_no_root_beside_it():
    found = crossings(lambda x: math.nan if 5.03 < x < 5.07 else x, 5.0, 0.0, 10.0)
    assert found.roots == approx([5.0])
    assert crossings(lambda x: math.nan if 2.0 < x < 4.0 else x, 1.99999, 0.0, 10.0).roots == approx([1.99999])
    assert crossings(lambda x: math.nan if 2.0 < x < 4.0 else x, 3.0, 0.0, 10.0).roots == []


def test_a_stretch_narrower_than_the_samples_and_one_over_all():
    assert crossings(lambda x: math.floor(100.0 * x), 250.0, 0.0, 10.0).stretches == [approx((2.5, 2.51), rel=1e-8)]
    assert crossings(lambda x: 1.0, 1.0, 0.0, 10.0).stretches == [(0.0, 10.0)]
