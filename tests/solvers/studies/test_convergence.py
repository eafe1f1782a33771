"""More modes: known orders are found, what does not converge is reported, and the impact beside a half-space."""

import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Modal, SceneError, compare_with_half_space, contact_times, convergence
from solvers.numerics.rods import composite_rod_modes
from solvers.studies.contact_times import half_periods
from solvers.studies.orders import rate
from solvers.text.notes import Severity
from tests.catalog import ROD, SCENES, T, bronze_rod, contact_table, struck_beam, struck_rod

COUNTS = np.array([3.0, 5.0, 10.0, 20.0, 40.0, 80.0])


def rated(values, scale=1.0, name="impulse"):
    return rate(name, COUNTS, values, scale, "modes", (7.0, 2.0))


@pytest.mark.parametrize("order", [0.5, 1.0, 2.0, 3.5])
def test_a_known_order_is_found_and_what_is_left_too(order):
    differences, found, reported = rated(2.0 + COUNTS**-order, 2.0)
    assert found == approx(order, abs=0.02)
    assert differences == approx((COUNTS**-order - 80.0**-order) / 2.0, rel=1e-12)
    assert reported.code == "converges" and "converges with order" in str(reported)
    assert 1.9 * 80.0**-order / 2.0 < reported.values["error"] < 2.0 ** max(order, 2.0) * 80.0**-order


def test_what_goes_to_infinity_does_not_converge():
    grows = rated(COUNTS**1.5)
    assert grows[1] is None and grows[2].code == "diverges"
    assert "grows as the number of modes to the power +1.5" in str(grows[2])


def test_what_goes_to_zero_is_told_with_what_is_left_of_it():
    note = rated(0.6 / COUNTS, 2.0, "mean_jump")[2]
    assert (note.code, note.severity) == ("vanishes", Severity.REMARK)
    assert note.values["power"] == approx(-1.0) and note.values["share"] == approx(100.0 * 0.6 / 80.0 / 2.0)
    assert "at 80 it is 0.38 % of the speed of approach" in str(note)
    assert "of its largest value" in str(rated(1e-4 / COUNTS, 1e-4 / 3.0, "first_parting")[2])


def test_without_a_clear_order_a_figure_settles_or_does_not():
    irregular = np.array([1.0, -3.0, 2.0, -1.0, 2.0, 0.0])
    for scatter, code, severity in ((1e-2, "no-order", Severity.WARNING), (3e-3, "settled", Severity.REMARK)):
        _, order, note = rated(1.0 + scatter * irregular)
        assert (order, note.code, note.severity) == (None, code, severity)
        assert note.values["error"] == approx(200.0 * scatter)
    assert "settles within 0.6 % of the finest from 20 modes on, without a clear order" in str(note)
    assert rated(np.ones(6))[2].code == "same-for-all"
    assert rated(np.array([1, 1, 2, 3, 3, 3.0]), 3.0, "contacts")[2].values["count"] == 20
    assert rated(np.array([1, 1, 2, 3, 3, 4.0]), 3.0, "contacts")[2].code == "contacts-scatter"


def test_modes_of_a_rod_in_hertz_contact_converge():
    scene = bronze_rod()
    found = convergence(scene)
    exact = solvers.solve(scene, "waves")
    assert found.counts.tolist() == [3, 5, 10, 20, 40, 80] and found.kind == "modes"
    for name, value in (("final_velocity", exact.impactor_velocity), ("peak_force", exact.peak_force)):
        assert 2.0 < found.order[name] < 4.5
        assert found.values[name][-1] == approx(value, rel=3e-5)
    assert str(found.summary["contacts"]) == "1 from 3 to 80 modes"
    assert "peak_shear" not in found.values and "support_stress" not in found.values  # a free rod
    alone = Modal(modes=10, estimate=False).solve(scene, solvers.solve(scene, Modal(modes=80)).duration)
    assert found.values["impulse"][2] == alone.impulse


def test_elements_converge_with_their_order():
    found = convergence(bronze_rod(), (10, 20, 40, 80), method="fe-nodal")
    assert found.kind == "elements"
    assert found.order["final_velocity"] == approx(2.0, abs=0.4)


def test_in_rigid_contact_the_force_converges_slowly():
    found = convergence(struck_rod())
    assert found.values["support_stress"].size == 6
    assert found.order["peak_force"] is None or found.order["peak_force"] < 1.5
    exact = solvers.solve(struck_rod())
    assert found.values["final_velocity"][-1] == approx(exact.impactor_velocity, abs=0.01)


def test_the_table_is_plain():
    table = convergence(bronze_rod(), [2, 4, 8]).table()
    assert table["counts"] == [2, 4, 8] and set(table["values"]) == set(table["units"]) == set(table["told"])
    assert all(isinstance(value, float) for value in table["values"]["impulse"])


@pytest.mark.parametrize(
    ("modes", "method", "key"),
    [
        ((3, 5), "modal", "modes"),
        ((3, 5, 5), "modal", "modes"),
        ((3, 5, 2.5), "modal", "modes"),
        ((0, 5, 10), "modal", "modes"),
        ("123", "modal", "modes"),
        ((3, 5, 10), "waves", "method.name"),
        ((3, 5, 10), "no-such-method", "method.name"),
        ((3, 5, 10), "mode-switch", "method.name"),  # refuses Hertz contact
    ],
)
def test_bad_input_is_refused(modes, method, key):
    with pytest.raises(SceneError) as refused:
        convergence(bronze_rod(), modes, method)
    assert refused.value.key == key


def test_contact_times_of_the_fixed_rod():
    found = contact_times(solvers.solve(struck_rod()))
    assert found.contacts == 2
    assert found.apparent == approx(0.2516982e-3, rel=1e-6) and found.real < found.apparent
    # z tan z = m2/m1, (5.11), with z = omega L / c
    z = math.pi * 0.5 * T / found.half_period
    assert z * math.tan(z) == approx(1.0, rel=1e-8)
    assert found.half_period_alone == approx(T, rel=1e-12)  # a quarter wave: a period of 4 L / c
    assert "as if stuck to each other" in str(found.summary)


def test_contact_times_without_a_swing():
    found = contact_times(solvers.solve(solvers.load("two-balls")))
    assert found.half_period is None and found.apparent == found.real and "touch once" in str(found.summary)
    free = contact_times(solvers.solve(bronze_rod()))
    rod = bronze_rod().target
    modes = composite_rod_modes(rod.length, rod.mass, rod.wave_speed, False, 1, bronze_rod().impactor.mass)
    assert free.half_period == approx(math.pi / modes.frequencies[0], rel=1e-8)
    assert "over before the body" in str(free.summary)
    swinging = solvers.solve(solvers.load("spring-mass"))
    target, mass = swinging.scene.target, swinging.scene.impactor.mass
    assert contact_times(swinging).half_period == approx(math.pi * math.sqrt((target.mass + mass) / target.stiffness))


def test_the_impact_on_a_half_space_is_the_closed_form_of_hertz():
    scene = bronze_rod()
    beside = compare_with_half_space(scene)
    mass, speed, stiffness = scene.impactor.mass, scene.speed, scene.contact.stiffness
    depth = (1.25 * mass * speed**2 / stiffness) ** 0.4
    assert beside.peak_indentation == approx(depth, rel=1e-4)
    assert beside.peak_force == approx(stiffness * depth**1.5, rel=1e-4)
    assert beside.contacts[0].end == approx(2.9432750 * depth / speed, rel=1e-4)
    assert beside.impactor_velocity == approx(-speed, rel=1e-12)


def test_the_impact_on_a_half_space_keeps_the_law():
    scene = struck_rod(contact=contact_table("plastic-power"))
    beside = compare_with_half_space(scene)
    assert beside.scene.contact == scene.contact and beside.scene.target.material == ROD.material
    assert beside.energy["dissipated"] > solvers.solve(scene, Modal()).energy["dissipated"]
    damped = struck_rod(contact=contact_table("hunt-crossley"))
    assert compare_with_half_space(damped).scene.contact == damped.contact


def test_no_half_space_in_rigid_contact():
    with pytest.raises(SceneError, match="a law that gives way"):
        compare_with_half_space(struck_rod())
    with pytest.raises(SceneError, match="a rigid impactor"):
        compare_with_half_space(
            solvers.load("two-equal-rods").replace({"contact": {"law": "linear", "stiffness": 1e9}})
        )


def test_a_rigid_impact_on_a_slender_beam_does_not_converge():
    """The first separation is the echo of the highest mode kept: the more modes, the earlier, down to nothing."""
    found = convergence(struck_beam(contact={"law": "rigid"}), (5, 10, 20, 40))
    assert found.summary["first_parting"].code == "vanishes"
    assert -2.0 < found.summary["first_parting"].values["power"] < -1.0
    assert found.values["first_parting"][1] == approx(67.2e-6, rel=2e-3)  # of the contact modes of thesis 5.5
    assert (np.diff(found.values["first_parting"]) < 0.0).all()
    assert "do not settle" in str(found.summary["contacts"])
    assert "has no limit" in str(found.summary["final_velocity"])


@pytest.mark.parametrize("ulps", range(0, 12))
def test_of_a_chaotic_rebound_no_order_is_told_whatever_its_digits(ulps):
    """Half of such runs once said "converges with order 1.9", with velocities that differ in their second digit."""
    scene = struck_beam(contact={"law": "rigid"})
    found = convergence(scene.with_impactor_mass(scene.impactor.mass * (1.0 + 2e-13 * ulps)), (5, 10, 20))
    assert set(found.order.values()) == {None}
    assert {found.summary[name].code for name in ("final_velocity", "impulse", "last_parting")} == {"no-limit"}
    assert found.summary["contacts"].code == "contacts-scatter"


@pytest.mark.parametrize("values", [2.0 + COUNTS**-2.0, 1.0 / COUNTS, COUNTS])
def test_nothing_is_fitted_to_what_is_chaotic(values):
    _, order, note = rate("final_velocity", COUNTS, values, 1.0, "modes", (7.0, 2.0), True)
    assert (order, note.code, note.severity) == (None, "no-limit", Severity.WARNING)


ORDERS = [  # of the final velocity in modes of a slender beam
    ("hertz", {"stiffness": 2.4e10}, 7.0),
    ("hunt-crossley", {"stiffness": 2.4e10, "restitution": 0.6}, 7.0),
    ("plastic-linear", {"stiffness": 2.4e10, "yield_indentation": 2e-6}, 7.0),
    ("yigit-christoforou", {"stiffness": 2.4e10, "yield_indentation": 2e-6}, 7.0),
    ("kelvin-voigt", {"stiffness": 2e8, "restitution": 0.6}, 2.5),
]


@pytest.mark.parametrize("law, constants, order", ORDERS, ids=lambda value: str(value))
def test_the_order_in_modes_of_a_beam_is_that_of_the_first_touch(law, constants, order):
    """Modes left out follow a smooth force as springs do; one that jumps makes them ring."""
    scene = struck_beam(1.0, {"law": law} | constants)
    counts = (5, 7, 10, 14, 20) if order > 5.0 else (5, 10, 20, 40, 80)

    def velocity(modes: int) -> float:
        return solvers.solve(scene, Modal(modes=modes, steps=40_000, estimate=False), duration=4e-3).impactor_velocity

    finest = velocity(2 * counts[-1])
    errors = [abs(velocity(modes) - finest) for modes in counts]
    assert -np.polyfit(np.log(counts), np.log(errors), 1)[0] == approx(order, rel=0.25)


def test_a_hertz_impact_on_a_beam_converges_with_its_shear():
    found = convergence(solvers.load("timoshenko-1913-long"), (4, 8, 16, 32))
    assert {"support_shear", "peak_shear"} <= set(found.values)
    assert found.order["impulse"] > 2.0 and found.order["support_shear"] > 2.0
    assert str(found.summary["contacts"]) == "3 from 8 to 32 modes"


def test_the_half_period_of_a_beam_with_a_mass_on_it():
    scene = struck_beam(contact={"law": "hertz", "stiffness": 1e10})
    with_mass, alone = half_periods(scene)
    assert with_mass == approx(4.0662e-3, rel=1e-4)  # thesis 5.5, with m1 = m2 on the tip
    assert alone == approx(0.5 * scene.target.time_unit, rel=1e-12)
    pinned = struck_beam(1e-6, contact={"law": "hertz", "stiffness": 1e10}, support="pinned-pinned", at=0.5)
    stiffness = 48.0 * pinned.target.line.bending_stiffness / pinned.target.length**3
    heavy = pinned.impactor.mass  # a million times the beam, which is a spring
    assert half_periods(pinned)[0] == approx(math.pi * math.sqrt(heavy / stiffness), rel=1e-5)


def test_links_and_pendulums_are_given_the_modes_that_are_compared():
    """Their number is their own: what is compared is the scene by so many, as it would be solved."""
    scene = SCENES["table-6.6"]
    found = convergence(scene, (3, 5, 10, 20), method="balance")
    assert found.kind == "modes" and found.method == "balance"
    for count, velocity in zip(found.counts, found.values["final_velocity"], strict=True):
        bar = scene.table()["target"]["links"][0] | {"modes": int(count)}
        alone = solvers.solve(scene.replace({"target.links": [bar]}))
        assert velocity == approx(alone.impactor_velocity, abs=1e-12)
    assert np.ptp(found.values["final_velocity"]) > 0.1 and found.values["contacts"].max() > 50
    pendulum = convergence(SCENES["figure-10.11"], (3, 5, 10))
    assert pendulum.values["final_velocity"] / 0.19 == approx([-5.059, -6.2862, -6.3340], abs=1e-4)


def test_links_of_elements_are_compared_up_to_all_their_modes():
    nodes = SCENES["table-6.10"]
    assert convergence(nodes, (3, 5, 10, 20, 40)).counts.tolist() == [3, 5, 10]
    with pytest.raises(SceneError, match="that the links can have"):
        convergence(nodes, (10, 20, 40))


def test_a_mechanism_that_strikes_is_given_them_too():
    found = convergence(SCENES["trip-hammer"], (3, 5, 10, 20))
    assert found.values["contacts"].tolist() == [2, 2, 3, 3]


def test_elements_are_asked_for_by_name():
    by_name = solvers.convergence("fixed-rod", elements=[4, 8, 16])
    assert (by_name.method, by_name.kind, by_name.counts.tolist()) == ("fe-nodal", "elements", [4, 8, 16])
    older = solvers.convergence("fixed-rod", [4, 8, 16], "fe-nodal")
    assert older.kind == "elements" and older.values["impulse"].tolist() == by_name.values["impulse"].tolist()
    own = solvers.convergence(solvers.load("fixed-rod").replace({"method.name": "fe-modal"}), elements=[4, 8, 16])
    assert own.method == "fe-modal"
    for wrong, method in (([4, 8, 16], "modal"), ([], None), ([16, 8, 4], None)):
        with pytest.raises(SceneError, match=r"^elements: got"):
            solvers.convergence("fixed-rod", elements=wrong, method=method)
