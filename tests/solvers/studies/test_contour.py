"""A scene turned round over two keys: lines on which a figure is as wanted, jumps kept apart, holes that end a line."""

import json
import math

import holoviews as hv
import numpy as np
import pytest
from pytest import approx

import solvers
from solvers.studies.squares import Squares
from solvers.text.notes import Note, Severity

MASS, SPEED, FORCE = 2.0, 3.0, 2e3
RATIO = 2.110416001 / 0.3  # of mass and length of `fixed-rod`, at which a second contact comes
KEYS = {"contact.stiffness": (1e4, 9e5), "impactor.velocity": (1.0, 6.0)}


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
def known(stop):
    return solvers.contour(stop, KEYS, {"peak_force": FORCE}, samples=(12, 9))


def on_grid(function, wanted: float, alike=lambda x, y: 0, count: int = 12, low: float = -1.05, high: float = 1.0):
    samples = np.linspace(low, high, count).tolist()
    return Squares(function, alike, wanted, samples, samples, map)


def ends(line) -> list[tuple[float, float]]:
    return [line.vertices[0], line.vertices[-1]]


def test_springs_and_speeds_for_a_peak_force_are_exact(known):
    """All of F² = k m v², from where the speed is largest to where the spring is stiffest."""
    (line,), wanted = known.lines, FORCE**2 / MASS
    stiffness, speed = np.array(line.vertices).T
    assert stiffness * speed**2 == approx(wanted, rel=1e-8) and not line.closed and known.jumps == []
    assert ends(line) == [(approx(wanted / 36.0), 6.0), (9e5, approx(math.sqrt(wanted / 9e5)))]
    assert (np.diff(stiffness) > 0.0).all() and (np.diff(speed) < 0.0).all()
    assert (known.nearest, known.refused, known.samples, known.warnings) == (None, 0, (12, 9), [])


def test_each_vertex_is_on_a_line_of_the_grid_and_each_of_these_that_it_crosses_has_one(known):
    across, up = np.linspace(1e4, 9e5, 12), np.linspace(1.0, 6.0, 9)
    (line,), wanted = known.lines, FORCE**2 / MASS
    on = [bool(np.isin(x, across)) + 2 * bool(np.isin(y, up)) for x, y in line.vertices]
    assert set(on) == {1, 2}
    speeds, stiffnesses = np.sqrt(wanted / across), wanted / up**2
    within = ((speeds > 1.0) & (speeds < 6.0)).sum() + ((stiffnesses > 1e4) & (stiffnesses < 9e5)).sum()
    assert len(on) == within


def test_two_masses_in_linear_contact(stop):
    """Two masses: v √(k m M / (m + M)), over both masses by powers."""
    scene = stop.replace({"target": {"kind": "mass", "mass": 3.0}})
    keys = {"impactor.mass": (0.1, 10.0), "target.mass": (0.1, 10.0)}
    found = solvers.contour(scene, keys, {"peak_force": 900.0}, samples=10)
    (line,), (one, other) = found.lines, np.array(found.lines[0].vertices).T
    assert SPEED * np.sqrt(1e5 * one * other / (one + other)) == approx(900.0, rel=1e-8)
    assert ends(line) == [(approx(0.9 / 0.91, rel=1e-8), 10.0), (10.0, approx(0.9 / 0.91, rel=1e-8))]


def test_where_a_contact_is_lost_is_a_jump_and_no_line():
    keys = {"impactor.mass": (1.8, 2.7), "target.length": (0.24, 0.4)}
    found = solvers.contour("fixed-rod", keys, {"contacts": 1.5}, samples=6)
    scene = solvers.load("fixed-rod")
    assert found.lines == [] and found.nearest is not None and found.nearest[1] in (1.0, 2.0)
    (jump,) = found.jumps
    assert set(jump.sides) == {(1.0, 2.0)} and len(jump.sides) == len(jump.vertices) > 3
    ratios = [mass / length for mass, length in jump.vertices]
    assert ratios == approx([RATIO] * len(ratios), rel=1e-7)  # that of the masses decides
    mass, length = jump.vertices[1]
    sides = [scene.replace({"impactor.mass": mass * part, "target.length": length}) for part in (1 - 1e-6, 1 + 1e-6)]
    assert [len(solvers.solve(side).contacts) for side in sides] == [1, 2]
    assert "no line, one jump" in str(found) and "jump 1, open, from 1 to 2" in str(found)


def test_no_line_goes_on_over_a_jump():
    """The time up to the last parting is L g(m / L): where it leaps over the wanted one the line ends, others begin."""
    keys = {"impactor.mass": (1.6, 3.0), "target.length": (0.22, 0.4)}
    found = solvers.contour("fixed-rod", keys, {"duration": 3.3e-4}, samples=12)
    scene = solvers.load("fixed-rod")
    (jump,) = found.jumps
    below, above = np.array(jump.sides).T
    assert [mass / length for mass, length in jump.vertices] == approx([RATIO] * len(below), rel=1e-7)
    assert (below < 3.3e-4).all() and (above > 3.3e-4).all() and len(below) > 4
    assert len(found.lines) == 2
    for line in found.lines:
        assert len({mass / length > RATIO for mass, length in line.vertices}) == 1
        for mass, length in line.vertices:
            solution = solvers.solve(scene.replace({"impactor.mass": mass, "target.length": length}))
            assert solution.duration == approx(3.3e-4, rel=1e-8)


def test_a_line_goes_on_where_a_contact_comes_without_a_jump():
    keys = {"impactor.mass": (1.0, 4.0), "impactor.velocity": (0.5, 1.5)}
    found = solvers.contour("fixed-rod", keys, {"impactor_velocity": -0.85}, samples=10)
    (line,), scene = found.lines, solvers.load("fixed-rod")
    solved = [solvers.solve(scene.replace(dict(zip(keys, vertex, strict=True)))) for vertex in line.vertices]
    assert [each.impactor_velocity for each in solved] == approx([-0.85] * len(solved), rel=1e-8)
    assert {len(each.contacts) for each in solved} == {1, 2} and found.jumps == []


def test_areas_that_have_the_value_are_noted_and_bounds_towards_less_are_jumps():
    keys = {"impactor.mass": (1.0, 3.0), "target.length": (0.2, 1.0)}
    found = solvers.contour("fixed-rod", keys, {"contacts": 2}, samples=12)
    assert found.lines == [] and len(found.jumps) > 1
    assert {side for jump in found.jumps for side in jump.sides} == {(1.0, 2.0)}
    (note,) = (note for note in found.notes if note.code == "contour-over-areas")
    assert note.severity is Severity.WARNING and note.values["cells"] > 0


def test_refused_points_end_a_line_and_are_counted(stop):
    keys = {"impactor.mass": (-1.0, 3.0), "impactor.velocity": (1.0, 6.0)}
    found = solvers.contour(stop, keys, {"peak_force": FORCE}, samples=(11, 6))
    (line,) = found.lines
    mass, speed = np.array(line.vertices).T
    assert mass * speed**2 == approx(FORCE**2 / 1e5, rel=1e-8) and (mass >= 0.2).all()
    (note,) = (note for note in found.notes if note.code == "contour-with-holes")
    assert found.refused == 18 and "18 of the 66 points" in str(note)
    assert "impactor.mass = -1, impactor.velocity = 1; allowed: a number" in str(note)


def test_the_nearest_is_named_where_there_is_no_line(stop):
    found = solvers.contour(stop, KEYS, {"peak_force": 1e5}, samples=5)
    assert found.lines == found.jumps == [] and found.nearest == ((9e5, 6.0), approx(6.0 * math.sqrt(9e5 * MASS)))
    assert "no line" in str(found) and "nearest: peak_force = 8049.8447 N at contact.stiffness = 900000 N/m" in str(
        found
    )


def test_warnings_on_the_vertices_are_counted():
    slender = {"target.length": 1.2, "target.section": {"width": 0.06, "height": 0.01}}
    scene = solvers.load("docs/hammer.toml").replace(slender)
    keys = {"contact.stiffness": (2e5, 2e6), "impactor.velocity": (3.0, 6.0)}
    found = solvers.contour(scene, keys, {"peak_force": 4e3}, samples=4)
    (vertices,) = (line.vertices for line in found.lines)
    codes: dict[str, int] = {}
    for stiffness, speed in vertices:
        solution = solvers.solve(scene.replace({"contact.stiffness": stiffness, "impactor.velocity": speed}))
        for code in {n.code for n in solution.notes if n.severity in (Severity.WARNING, Severity.INVALID)}:
            codes[code] = codes.get(code, 0) + 1
    assert {warning.code: warning.count for warning in found.warnings} == codes != {}
    assert f"with the note {found.warnings[0].code}, as the first: {found.warnings[0].first}" in str(found)


def test_what_auto_chooses_once_solves_all(stop):
    scene = stop.replace({"method": {"name": "auto", "quantity": "peak-force", "tolerance": 1e-3}})
    found = solvers.contour(scene, {**KEYS, "contact.stiffness": (1e5, 4e5)}, {"peak_force": FORCE}, samples=3)
    stiffness, speed = np.array(found.lines[0].vertices).T
    assert stiffness * speed**2 == approx(FORCE**2 / MASS, rel=4e-3)
    assert found.method in solvers.METHODS and found.notes[-1].code == "contour-by-one-method"


def test_no_number_of_workers_makes_another_answer(stop):
    tables = [
        solvers.contour("fixed-rod", {"impactor.mass": (1, 3), "target.length": (0.3, 1)}, {"newton": 0.9}, 6, None, n)
        for n in (1, 4)
    ]
    assert tables[0].table() == tables[1].table()


def test_an_answer_is_data_and_a_picture(known):
    table = json.loads(json.dumps(known.table(), allow_nan=False))
    assert set(table) == {
        "method", "keys", "figure", "figure_unit", "wanted", "lines", "jumps", "nearest", "refused", "solves",
        "warnings", "notes", "note_codes",
    }  # fmt: skip
    assert table["keys"][0] == {"key": "contact.stiffness", "unit": "N/m", "low": 1e4, "high": 9e5, "samples": 12}
    assert [tuple(vertex) for vertex in table["lines"][0]["vertices"]] == known.lines[0].vertices
    assert [Note.from_table(code) for code in table["note_codes"]] == known.notes
    count = len(known.lines[0].vertices)
    assert f"line 1, open: {count} vertices" in str(known) and len(str(known).splitlines()) == 14
    assert repr(known).endswith("peak_force = 2000: 1 lines, 0 jumps>")
    card = known._repr_html_()
    assert "line 1, open" in card and card.count("<tr>") == 8 and "Contour" in card
    (curve, _) = known.plot()
    assert curve.array()[:-1].tolist() == table["lines"][0]["vertices"]
    assert hv.render(known.plot(), backend="bokeh").xaxis[0].axis_label == "contact.stiffness (N/m)"


@pytest.mark.parametrize(
    "changes, said",
    [
        (
            {"between": {"contact.stiffness": (1.0, 2.0)}},
            "between: got {'contact.stiffness': (1.0, 2.0)}; allowed: two",
        ),
        ({"between": KEYS | {"impactor.mass": (1.0, 2.0)}}, "between: got {"),
        ({"between": 3}, "between: got 3; allowed: two keys"),
        ({"between": KEYS | {"impactor.velocity": (2.0, 1.0)}}, "between.impactor.velocity: got (2.0, 1.0); allowed"),
        ({"between": KEYS | {"impactor.velocity": 7}}, "between.impactor.velocity: got 7; allowed: two finite"),
        ({"between": {"contact.stiff": (1, 2), "impactor.mass": (1, 2)}}, "contact.stiff: got 1.0; allowed: no such"),
        ({"such_that": {"peak": 1.0}}, "such_that: got 'peak'; allowed: 'contacts', "),
        ({"such_that": {}}, "such_that: got {}; allowed: one figure"),
        ({"such_that": {"peak_moment": 1.0}}, "peak_moment: got nothing; allowed: a figure that this"),
        ({"samples": 2}, "samples: got 2; allowed: a whole number from 3 to 500"),
        ({"samples": (5, 5, 5)}, "samples: got (5, 5, 5); allowed: one for both keys, or two"),
        ({"spacing": ("log",)}, "spacing: got ('log',); allowed: one for both keys, or two"),
        ({"spacing": "odd"}, "spacing: got 'odd'; allowed"),
        ({"workers": 0}, "workers: got 0; allowed: a whole number from 1"),
    ],
)
def test_refusals_name_what_is_allowed(stop, changes, said):
    with pytest.raises(solvers.SceneError) as refused:
        solvers.contour(stop, **({"between": KEYS, "such_that": {"peak_force": 1.0}, "samples": 3} | changes))
    assert str(refused.value).startswith(said)


def test_whole_numbers_and_bodies_in_space_are_refused():
    keys = {"method.modes": (1, 20), "impactor.mass": (1.0, 2.0)}
    scene = solvers.load("docs/hammer.toml").replace({"method": {"name": "modal", "modes": 10}})
    with pytest.raises(solvers.SceneError, match=r"^key: got 'method\.modes'; allowed"):
        solvers.contour(scene, keys, {"peak_force": 3e3}, samples=3)
    with pytest.raises(solvers.SceneError, match="bodies on an axis"):
        solvers.contour("note-rod", {"method.restitution": (0.0, 1.0), "impactor.mass": (1, 2)}, {"impulse": 1.0})


# --- functions that are known ---


def test_a_circle_is_closed_and_one_within_a_cell_is_missed():
    (line,), jumps = on_grid(lambda x, y: x * x + y * y, 0.5).search()
    radius = np.hypot(*np.array(line.vertices).T)
    assert line.closed and radius == approx(math.sqrt(0.5), rel=1e-9) and jumps == []
    angles = np.unwrap(np.arctan2(*np.array(line.vertices).T))
    assert abs(angles[-1] - angles[0]) > 6.0 and len({*map(np.sign, np.diff(angles))}) == 1  # once round
    assert on_grid(lambda x, y: x * x + y * y, 1e-4).search() == ([], [])


@pytest.mark.parametrize("wanted", [1e-4, -1e-4])
def test_a_saddle_is_joined_as_its_middle_says(wanted):
    """x y = c has two branches, which meet nowhere."""
    lines, _ = on_grid(lambda x, y: (x + 0.025) * (y + 0.025), wanted).search()
    assert len(lines) == 2
    for line in lines:
        sides = {(x > -0.025, y > -0.025) for x, y in line.vertices}
        assert len(sides) == 1 and len(line.vertices) > 8


def test_a_corner_that_has_the_value_is_one_vertex():
    samples = [0.0, 1.0, 2.0, 3.0]
    (line,), _ = Squares(lambda x, y: x + y, lambda x, y: 0, 3.0, samples, samples, map).search()
    assert line.vertices == [(0.0, 3.0), (1.0, 2.0), (2.0, 1.0), (3.0, 0.0)]


@pytest.mark.parametrize("seen", [True, False])
def test_a_line_is_torn_by_a_jump_across_it(seen):
    """y = x to the left of 0.02, y = x + 0.4, or with a small step that another kind shows, to the right."""
    step = 0.03 if seen else 0.4

    def function(x, y):
        return y - x - step * (x > 0.02)

    lines, jumps = on_grid(function, 0.0, (lambda x, y: float(x > 0.02)) if seen else lambda x, y: 0).search()
    assert len(lines) == 2 and len(jumps) > 0
    assert [x for jump in jumps for x, _ in jump.vertices] == approx([0.02] * sum(len(j.vertices) for j in jumps))
    for line, right in zip(lines, (False, True), strict=True):
        for x, y in line.vertices:
            assert (x > 0.02) == right and y == approx(x + step * right, abs=1e-9)
    assert all(above - below == approx(step, rel=1e-6) for jump in jumps for below, above in jump.sides)


def test_another_kind_without_a_jump_tears_nothing():
    (line,), jumps = on_grid(lambda x, y: y - x, 0.0, lambda x, y: float(x > 0.02)).search()
    assert jumps == [] and len(line.vertices) > 10


def test_a_jump_over_all_is_a_line_of_jumps_that_a_root_does_not_join():
    """Above y = x² it is 1 + x: on its left end, where that is 0.5, the line of the value ends there."""

    def function(x, y):
        return (1.0 + x) * (y > x * x)

    lines, jumps = on_grid(function, 0.5, count=25).search()
    (line,), (jump,) = lines, jumps
    assert all(x == approx(-0.5, abs=1e-9) and y > 0.25 for x, y in line.vertices)
    assert all(y == approx(x * x, abs=1e-8) and x > -0.5 for x, y in jump.vertices)
    assert all(side == (0.0, approx(1.0 + x)) for side, (x, _) in zip(jump.sides, jump.vertices, strict=True))


def test_three_roots_on_one_side_of_a_cell():
    """A line that goes back and forth between two samples."""
    samples, tall = [0.0, 1.0, 2.0], [-1.0, 1.0]

    def function(x, y):
        return y - 5.0 * (y**3 - 0.25 * y) - x + 1.0

    lines, _ = Squares(function, lambda x, y: 0, 0.0, samples, tall, map).search()
    found = [vertex for line in lines for vertex in line.vertices]
    assert [function(*vertex) for vertex in found] == approx([0.0] * len(found), abs=1e-9)
    assert sorted(y for x, y in found if x == 1.0) == approx([-math.sqrt(0.45), 0.0, math.sqrt(0.45)], abs=1e-9)


def test_a_hole_ends_a_line():
    def function(x, y):
        return math.nan if math.hypot(x, y) < 0.3 else y - 0.013 * x

    lines, _ = on_grid(function, 0.0).search()
    assert len(lines) == 2 and all(math.hypot(*vertex) >= 0.3 for line in lines for vertex in line.vertices)
