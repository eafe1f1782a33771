"""Maps of stability: limits by theory, orders of convergence, and the default kernel over the whole box of extremes."""

import itertools
import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

import solvers
from solvers import Scene, SceneError, SceneNotSupported, stability
from solvers.methods import Modal
from solvers.stability import integrators
from solvers.stability.integrators import BOUND, DIVERGED, ENDED, LASTING
from solvers.stability.maps import NOT_RUN
from solvers.stability.runs import INTEGRATORS, bound, problem_of, run
from tests.catalog import LAWS, ROD, T, contact_table, observed_order, struck_beam, struck_rod

BOX = {  # corners of it, and hypothesis inside
    "contact_stiffness": (1e-3, 1e6),
    "mass_ratio": (1e-6, 1e6),
    "modes": (1, 1000),
    "speed": (1e-6, 1e3),
}
RESTITUTION = (0.01, 1.0)
SHARES = (0.03, 30.0)  # of the default kernel's own step
KEPT = 1e-10  # of the energy


# --- the default kernel -----------------------------------------------------------------------------------------------


def nothing_fails(law: str, support: str, values: dict, share: float, most_steps: int) -> None:
    problem = problem_of(struck_rod(1.0, support, contact_table(law)), values, 20)
    found = run("modal", problem, share * problem.usual_step, most_steps)
    assert abs(found.energy_error) <= KEPT
    assert math.isfinite(found.velocity) and abs(found.velocity) <= problem.scene.speed * (1.0 + KEPT)
    assert found.ending in (ENDED, BOUND)  # none grows, none fails to part in the time it could need
    if found.ending == BOUND:
        assert found.steps == most_steps  # and where it is stopped it says so


@pytest.mark.slow
@pytest.mark.parametrize("support", ["fixed", "free"])
@pytest.mark.parametrize("law", ["rigid", "hertz", "plastic-power", "kelvin-voigt"])
def test_the_default_kernel_fails_at_no_corner_of_the_box(law, support):
    for corner in itertools.product(*BOX.values()):
        values = dict(zip(BOX, corner, strict=True))
        damped = [{"restitution": e} for e in RESTITUTION] if law == "kelvin-voigt" else [{}]
        for more, share in itertools.product(damped, SHARES):
            nothing_fails(law, support, values | more, share, 2_000 if values["modes"] == 1000 else 10_000)


@pytest.mark.parametrize("name", ["figure-8.14", "two-equal-rods"])
def test_nor_with_beams_and_rods_on_rods(name):
    box = {key: BOX[key] for key in ("contact_stiffness", "speed")} | {"modes": (1, 100)}
    for corner in itertools.product(*box.values()):
        problem = problem_of(solvers.load(name), dict(zip(box, corner, strict=True)), 20)
        for share in SHARES:
            found = run("modal", problem, share * problem.usual_step, 10_000)
            assert abs(found.energy_error) <= KEPT and found.ending in (ENDED, BOUND)


def logarithmic(low: float, high: float):
    return st.floats(math.log(low), math.log(high)).map(math.exp).map(lambda x: min(max(x, low), high))


@settings(max_examples=60)
@given(
    st.sampled_from(["rigid", "hertz", "plastic-power", "kelvin-voigt"]),
    st.sampled_from(["fixed", "free"]),
    st.fixed_dictionaries({name: logarithmic(*ends) for name, ends in BOX.items()}),
    st.floats(*RESTITUTION),
    logarithmic(1e-2, 1e3),
)
def test_the_default_kernel_fails_nowhere_inside_the_box(law, support, values, restitution, share):
    more = {"restitution": restitution} if law == "kelvin-voigt" else {}
    nothing_fails(law, support, values | more, share, max(1_000, int(4e6 / values["modes"])) if share < 1 else 100_000)


def test_the_default_kernel_ends_by_itself_on_the_map_of_the_page():
    found = stability(struck_rod(), ["modal"], grid=(8, 8)).maps["modal"]
    assert np.all(found.ending == ENDED) and found.failures == found.stopped == 0
    assert found.worst_energy_error <= KEPT
    for axes in (("step", "mass_ratio"), ("step", "modes"), ("mass_ratio", "speed"), ("contact_stiffness", "modes")):
        found = stability(struck_rod(), ["modal"], axes, (4, 4)).maps["modal"]
        assert found.failures == 0 and found.worst_energy_error <= KEPT


WHERE = ("fixed", "free", "cantilever", "free-free", "pinned-pinned, timoshenko")


def struck(where: str, law: str) -> Scene:
    """The rod or the beam by its support, struck by its own mass."""
    if where in ("fixed", "free"):
        return struck_rod(1.0, where, contact_table(law))
    support, _, theory = where.partition(", ")
    place = {"cantilever": 1.0}.get(support, 0.37)
    return struck_beam(1.0, contact_table(law), support=support, at=place, theory=theory or "euler-bernoulli")


@settings(max_examples=40)
@given(
    st.sampled_from(["rigid", "hertz", "plastic-power", "kelvin-voigt"]),
    st.sampled_from(WHERE[2:]),
    st.fixed_dictionaries({name: logarithmic(*ends) for name, ends in (BOX | {"modes": (1, 200)}).items()}),
    st.floats(*RESTITUTION),
    logarithmic(1e-2, 1e3),
)
def test_nor_anywhere_inside_it_on_beams(law, where, values, restitution, share):
    values = values | ({"restitution": restitution} if law == "kelvin-voigt" else {})
    problem = problem_of(struck(where, law), values, 20)
    found = run("modal", problem, share * problem.usual_step, 5_000)
    assert abs(found.energy_error) <= KEPT and found.ending in (ENDED, BOUND)
    assert abs(found.velocity) <= problem.scene.speed * (1.0 + KEPT)


@settings(max_examples=50)
@given(
    st.sampled_from(list(LAWS)),
    st.sampled_from(WHERE),
    st.fixed_dictionaries({name: logarithmic(*ends) for name, ends in (BOX | {"modes": (1, 300)}).items()}),
    st.floats(*RESTITUTION),
    logarithmic(1e-2, 1e2),
)
def test_every_law_keeps_its_energy_on_rods_and_beams_as_they_are_solved(law, where, values, restitution, share):
    values = values | ({"restitution": restitution} if LAWS[law].LOSSY else {})
    problem = problem_of(struck(where, law), values, 20)
    method, steps = Modal(modes=int(values["modes"]), steps=300, estimate=False), 300
    found = method.solve(problem.scene, min(steps * share * problem.usual_step, 1e4 * problem.scene.time_unit))
    assert abs(found.diagnostics["energy_error"]) <= KEPT
    assert math.isfinite(found.impulse) and abs(found.impactor_velocity) <= problem.scene.speed * (1.0 + KEPT)
    assert found.diagnostics["steps"] == steps
    reported = any("still in contact" in str(note) for note in found.notes)
    assert reported == (found.contacts[-1].end >= found.duration * (1.0 - 1e-12))


# --- limits by theory -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("stiffness", [1e6, 1e9, 1e13])
def test_the_highest_frequency_is_that_of_the_modes_with_the_contact_spring(stiffness):
    modes = ROD.modes(12)
    bodies = integrators.rows(modes.frequencies, modes.at_contact, 2.0, math.inf)
    shape = np.sqrt(bodies.mobility)
    whole = np.diag(bodies.squares) + stiffness * np.outer(shape, shape)
    assert integrators.highest_frequency(bodies, stiffness) == approx(
        math.sqrt(np.linalg.eigvalsh(whole)[-1]), rel=1e-9
    )


def first_failure(name: str, problem, shares: np.ndarray) -> float:
    """The smallest of these shares of the limit at which a run grows past reason."""
    limit = INTEGRATORS[name].limit(problem)
    return next((s for s in shares.tolist() if run(name, problem, s * limit).ending == DIVERGED), math.nan)


@pytest.mark.parametrize("mass_ratio, stiffness", [(1e-3, 0.01), (1e-3, 1.0), (0.03, 1.0), (1.0, 0.01), (1.0, 1.0)])
def test_a_closed_contact_fails_where_theory_says(mass_ratio, stiffness):
    problem = problem_of(struck_rod(), {"mass_ratio": mass_ratio, "contact_stiffness": stiffness}, 10)
    for name in ("central-difference", "rk4"):
        assert first_failure(name, problem, np.geomspace(0.8, 1.25, 46)) == approx(1.0, abs=0.03)


@pytest.mark.parametrize("stiffness", [100.0, 1000.0, 3000.0])
def test_a_frozen_status_fails_where_it_was_measured(stiffness):
    problem = problem_of(struck_rod(1.0, "free"), {"contact_stiffness": stiffness}, 10)
    assert first_failure("newmark-frozen", problem, np.geomspace(0.5, 2.0, 71)) == approx(1.0, abs=0.07)
    for name in ("newmark", "modal", "moreau-jean"):
        steps = np.geomspace(0.01, 1e3, 12) * problem.step_unit
        assert not any(run(name, problem, step).ending == DIVERGED for step in steps.tolist())


def test_failures_below_a_limit_are_reported():
    scene = struck_rod(0.03)
    problem = problem_of(scene, {"contact_stiffness": 100.0}, 10)
    limit = INTEGRATORS["central-difference"].limit(problem) / problem.step_unit
    box = ((np.geomspace(0.45, 0.95, 40) * limit).tolist(), [100.0])
    found = stability(scene, ["central-difference"], grid=box, modes=10)
    each = found.maps["central-difference"]
    assert np.any(each.ending[each.limit_share < 0.9] == DIVERGED)
    assert not np.any(each.ending[each.limit_share < 0.5] == DIVERGED)
    assert any("below the limit drawn" in str(note) for note in found.notes)
    soft = stability(struck_rod(0.03), ["central-difference"], grid=(6, [0.01, 1.0]), modes=10)
    assert not any("below the limit drawn" in str(note) for note in soft.notes)


def test_explicit_rules_are_stable_below_their_limit_and_not_beyond():
    # a contact that opens and closes feeds the motion next to the limit, and may part before it has grown
    found = stability(struck_rod(), ["central-difference", "rk4"], grid=(16, 16))
    for each, sure in zip(found.maps.values(), (1.25, 2.0), strict=True):
        assert not np.any(each.ending[each.limit_share < 0.7] == DIVERGED)
        assert np.all(each.ending[each.limit_share > sure] == DIVERGED)
        assert each.limit.shape == (16,) and np.all(np.diff(each.limit) < 0.0)
        assert each.limit_share == approx(found.axes[0].values[:, None] / each.limit)
        assert np.any(each.ending == ENDED) and np.any(each.ending == DIVERGED)
    # soft contacts: 2 and 2 sqrt(2) over the highest kept frequency
    limits = [each.limit[0] for each in found.maps.values()]
    assert limits == approx([2.0, 2.0 * math.sqrt(2.0)], rel=1e-3)


def test_a_frozen_status_grows_with_the_step_on_the_contact_spring_never_with_stiffness_alone():
    """Differs: thesis 8.2 lets a contact a hundred times as stiff as the element diverge; steps of 1 us do."""
    scene = solvers.load("stiff-contact")
    unit = problem_of(scene, {}, 20).step_unit
    found = stability(
        scene, ["newmark-frozen", "newmark", "modal"], grid=([1e-8 / unit, 1e-7 / unit, 1e-6 / unit], [1, 100])
    )
    frozen = found.maps["newmark-frozen"]
    assert (frozen.ending == DIVERGED).tolist() == [[False, False], [False, False], [False, True]]
    assert (3.0 * frozen.limit_share > 3.0).tolist() == (frozen.ending == DIVERGED).tolist()
    for name in ("newmark", "modal"):
        assert found.maps[name].failures == 0 and found.maps[name].worst_energy_error < KEPT
    lesson = [str(note) for note in found.notes if note.code == "frozen-not-stiff"]
    assert len(lesson) == 1 and "from a step of 1 µs on" in lesson[0]


def test_a_frozen_status_grows_nowhere_well_below_its_limit():
    found = stability(struck_rod(1.0, "free"), ["newmark-frozen"], grid=(16, 16)).maps["newmark-frozen"]
    share = 3.0 * found.limit_share
    assert not np.any(found.ending[share < 1.0] == DIVERGED)
    assert np.mean(found.ending[share > 4.0] == DIVERGED) > 0.9


# --- orders and agreement ---------------------------------------------------------------------------------------------


def velocity_after(name: str, law: dict):
    problem = problem_of(struck_rod(0.5, "fixed", law), {}, 4)
    return lambda step: run(name, problem, step).velocity


@pytest.mark.slow
@pytest.mark.parametrize(
    "name, order", [("modal", 2), ("newmark", 2), ("newmark-frozen", 1), ("central-difference", 2), ("rk4", 4)]
)
def test_orders_of_convergence(name, order):
    # a force that starts as the third power of the indentation lets every rule show its order; a secant stiffness
    # taken when the step begins is of the first
    law = {"law": "power", "stiffness": ROD.stiffness / T**2, "exponent": 3.0}
    steps = 2.0 ** -np.arange(5.0) * T / (100 if name == "rk4" else 400)
    assert observed_order(velocity_after(name, law), steps) == approx(order, abs=0.35)


@pytest.mark.slow
@pytest.mark.parametrize("law", ["kelvin-voigt", "plastic-power"])
def test_all_that_know_a_law_tend_to_the_same(law):
    problem = problem_of(struck_rod(0.5, "free", contact_table(law)), {}, 4)
    problem = problem._replace(residual=0.0)  # which only the default kernel knows
    found = {name: run(name, problem, T / 20_000) for name in INTEGRATORS if name != "moreau-jean"}
    exact = found.pop("modal")
    error = 1e-3 if law == "kelvin-voigt" else 1e-4  # its force jumps at first touch
    for outcome in found.values():
        assert outcome.ending == ENDED
        assert outcome.velocity == approx(exact.velocity, abs=error)
        assert abs(outcome.energy_error) < error


def test_impulses_lose_energy_and_less_with_more_modes():
    lost = [
        -run("moreau-jean", problem, 0.05 * problem.step_unit).energy_error
        for problem in (problem_of(struck_rod(), {}, modes) for modes in (5, 20, 80))
    ]
    assert lost[0] > lost[1] > lost[2] > 0.0
    plastic = stability(struck_rod(contact=contact_table("plastic-power")), ["moreau-jean"], grid=(2, 2))
    assert "plastic" in str(plastic.maps["moreau-jean"].reason)
    assert np.all(np.isnan(plastic.maps["moreau-jean"].energy_error))


# --- what is asked for ------------------------------------------------------------------------------------------------


def test_bodies_without_waves_and_rods_against_rods_have_maps_too():
    for name in ("two-balls", "two-equal-rods"):
        found = stability(solvers.load(name), ["modal", "newmark"], grid=(3, 3))
        assert all(each.failures == 0 and each.worst_energy_error < KEPT for each in found.maps.values())
        json.dumps(found.table(), allow_nan=False)


def test_a_run_that_needs_more_steps_is_stopped_and_says_so():
    found = stability(struck_rod(), ["modal"], grid=(2, 2), most_steps=50)
    assert found.maps["modal"].stopped == 4 - int(np.sum(found.maps["modal"].ending == ENDED)) > 0
    assert found.maps["modal"].steps.max() == 50 == found.bound
    assert any("stopped at the bound" in str(note) for note in found.notes)
    problem = problem_of(struck_rod(), {}, 1000)
    assert bound(problem, None) * problem.rows.squares.size <= 20_000_000
    assert LASTING not in found.maps["modal"].ending


def test_progress_is_reported_and_a_cancelled_map_is_left_empty():
    reported = []
    stability(struck_rod(), ["modal"], grid=(2, 5), progress=lambda done, columns: reported.append((done, columns)))
    assert sorted(reported) == [(k, 5) for k in range(1, 6)]
    found = stability(struck_rod(), ["modal"], grid=(2, 5), cancel=lambda: True)
    assert np.all(found.maps["modal"].ending == NOT_RUN) and found.maps["modal"].failures == 0
    json.dumps(found.table(), allow_nan=False)


@pytest.mark.parametrize(
    "options, key",
    [
        ({"axes": ("step",)}, "axes"),
        ({"axes": ("step", "step")}, "axes"),
        ({"axes": ("modes", "step")}, "axes"),
        ({"axes": ("step", "colour")}, "axes"),
        ({"grid": (1, 10)}, "grid"),
        ({"grid": (3,)}, "grid"),
        ({"grid": ([math.nan, 1.0], 3)}, "grid of step"),
        ({"integrators": ["leapfrog"]}, "integrators"),
        ({"modes": 0}, "modes"),
        ({"most_steps": 1}, "most_steps"),
    ],
)
def test_what_cannot_be_asked_is_refused_by_name(options, key):
    with pytest.raises(SceneError) as refused:
        stability(struck_rod(), **options)
    assert refused.value.key == key


def test_scenes_that_have_no_map_are_refused():
    with pytest.raises(SceneNotSupported, match="prescribed force"):
        stability(solvers.load("pressure-bar"))
    with pytest.raises(SceneError, match="plastic"):
        stability(struck_rod(contact=contact_table("plastic-power")), axes=("step", "restitution"))
