"""Plots: the values of the motion on axes with units, drawn by Bokeh without complaint."""

import doctest

import holoviews as hv
import numpy as np
import pytest
from bokeh.models import ColorBar

import solvers
from solvers.notebook import plots

WORDS = ("force", "motion", "waves", "energy")


@pytest.fixture(scope="module", params=["fixed-rod", "timoshenko-1913-long", "pressure-bar", "two-equal-rods"])
def solution(request):
    return solvers.solve(solvers.load(request.param))


def labels(figure) -> set[str]:
    return {axis.axis_label for axis in (*figure.xaxis, *figure.yaxis)}


@pytest.mark.parametrize(
    "what, named",
    [
        ("force", {"time (s)", "contact force (N)"}),
        ("energy", {"time (s)", "energy (J)"}),
    ],
)
def test_axes_have_units(solution, what, named):
    figure = hv.render(solution.plot(what), backend="bokeh")
    assert labels(figure) == named
    assert (figure.width, figure.height) == (plots.WIDTH, plots.HEIGHT)


def test_both_axes_of_the_waves_have_units(solution):
    named = labels(hv.render(solution.plot("waves"), backend="bokeh"))
    origin = "the first support" if solution.scene.target.kind == "beam" else "the struck end"
    assert named == {f"place from {origin} (m)", "time (s)"}


def test_the_force_is_that_of_the_motion_with_every_jump():
    solution = solvers.solve(solvers.load("fixed-rod"))
    drawn = solution.plot("force")
    time, force = solution.motion.force_history()
    time, force = time[time <= solution.duration], force[time <= solution.duration]
    np.testing.assert_array_equal(drawn.Curve.I["time"], time)
    np.testing.assert_array_equal(drawn.Curve.I["contact_force"], force)
    assert (np.diff(time) == 0.0).any()
    shaded = [element for element in drawn if isinstance(element, hv.VSpans)]
    starts, ends = shaded[0].dimension_values(0), shaded[0].dimension_values(1)
    assert list(zip(starts, ends, strict=True)) == [(contact.start, contact.end) for contact in solution.contacts]


def test_a_raw_force_has_what_its_modes_can_resolve_beside_it():
    solution = solvers.solve(solvers.load("timoshenko-1913-long"))
    resolved = solution.plot("force").Curve.Resolved
    expected = solution.motion.resolved_force(resolved["time"])
    np.testing.assert_array_equal(resolved["contact_force"], expected)


def test_motion_shows_impactor_and_struck_face():
    solution = solvers.solve(solvers.load("fixed-rod"))
    positions, velocities = solution.plot("motion")
    time = positions.Curve.Impactor["time"]
    np.testing.assert_array_equal(positions.Curve.Impactor["displacement"], solution.motion.impactor_position(time))
    np.testing.assert_array_equal(velocities.Curve.Struck_face["velocity"], solution.motion.end_velocity(time))
    assert labels(hv.render(velocities, backend="bokeh")) == {"time (s)", "velocity (m/s)"}


def test_a_prescribed_force_has_no_impactor():
    positions, _ = solvers.solve(solvers.load("pressure-bar")).plot("motion")
    assert [curve.label for curve in positions] == ["struck face"]


def test_waves_are_the_stress_of_the_motion():
    solution = solvers.solve(solvers.load("fixed-rod"))
    image = solution.plot("waves")
    x, time = image.dimension_values("x", expanded=False), image.dimension_values("time", expanded=False)
    stress = image.dimension_values("stress", flat=False)
    assert x[0] == pytest.approx(0.0, abs=1e-12)
    assert x[-1] == pytest.approx(solution.scene.target.length)
    np.testing.assert_array_equal(stress, solution.motion.stress(plots._instants(solution), np.linspace(0, 0.3, 401)))
    assert time[-1] == pytest.approx(solution.duration)


def test_the_top_of_the_energies_is_the_total(solution):
    stacked = list(solution.plot("energy"))
    time = stacked[-1].dimension_values("time")
    total = sum(solution.motion.energies(time).values())
    np.testing.assert_allclose(stacked[-1].dimension_values("energy"), total, rtol=1e-12)


def test_the_title_names_scene_and_method(solution):
    for what in WORDS:
        assert solution.plot(what).label == f"{solution.scene.title}, {solution.method['name']}"


@pytest.mark.parametrize("what", WORDS)
def test_a_long_title_is_whole_on_lines_that_fit(what):
    named = "A drop hammer of {steel} on the end of a bar, a pad of rubber between them, as measured in 1986"
    solution = solvers.solve(solvers.load("fixed-rod").replace({"title": named}))
    drawn = solution.plot(what)
    for each in drawn if what == "motion" else [drawn]:
        figure = hv.render(each, backend="bokeh")
        lines = figure.title.text.split("\n")
        assert " ".join(lines) == f"{named}, {solution.method['name']}"
        # letters of DejaVu Sans Bold, the widest of the usual fonts, are 0.7 of their height wide on average
        assert max(map(len, lines)) * 0.7 * float(figure.title.text_font_size[:-2]) * 4.0 / 3.0 < plots.WIDTH - 100
        assert all(bar.title_standoff >= 8 for bar in figure.select(type=ColorBar))


def test_what_cannot_be_drawn_is_refused():
    balls = solvers.solve(solvers.load("two-balls"))
    with pytest.raises(solvers.SceneError, match="nothing here has a length"):
        balls.plot("waves")
    with pytest.raises(solvers.SceneError, match=r"what: got 'heat'; allowed: .*'force'"):
        balls.plot("heat")


def test_the_examples_run():
    assert doctest.testmod(plots) == (0, 3)
