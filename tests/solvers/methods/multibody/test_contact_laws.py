"""Contact laws while a mechanism moves: closed forms, order, energy, momentum, and what freezing it is off by."""

import numpy as np
import pytest
from pytest import approx
from scipy.integrate import solve_ivp

import solvers
from solvers import Modal, RigidImpulse, Scene
from solvers.contact import LAWS
from solvers.methods.freezing import freezing_error
from solvers.methods.multibody.method import Multibody
from solvers.numerics.closed_collisions import deepest_of_power
from solvers.numerics.collisions import duration_of_power
from tests.catalog import SCENES
from tests.solvers.bodies.linkage.mechanisms import four_bar, rotating_bar

RESTITUTION = 0.6
BAR = {"name": "bar", "from": [-1.0, 0.0], "to": [1.0, 0.0], "mass": 1.0}


def contact_of(name: str, stiffness: float = 1e7) -> dict:
    """A law as a table, its losses by what it delivers, by itself soft enough for a contact of some milliseconds."""
    given = dict(LAWS[name].EXAMPLE) | {"stiffness": stiffness}
    if LAWS[name].PLASTIC:
        given["yield_indentation"] = 1e-5
    if LAWS[name].LOSSY:
        given = {key: value for key, value in given.items() if key in ("stiffness", "exponent")}
        given["restitution"] = RESTITUTION
    return {"law": name} | given


def floor(law: dict, velocity: float = 2.0, gravity: float = -10.0) -> Scene:
    """A mass of 1 kg that falls on a bar whose drive stands still."""
    target = {
        "kind": "mechanism",
        "gravity": [0.0, gravity],
        "links": [BAR],
        "joints": [{"links": ["ground", "bar"], "at": [0.0, 0.0]}],
        "drives": [{"joint": 0, "speed": 0.0}],
        "struck": {"link": "bar", "at": 0.75, "normal": [0.0, -1.0]},
    }
    return Scene.from_table({"impactor": {"mass": 1.0, "velocity": velocity}, "target": target, "contact": law})


def test_a_pendulum_struck_at_its_centre_of_percussion():
    """Two bodies of reduced mass m M / (m + M), M = I / L^2: peak, duration 2.94 a / v, impulse; none at the pivot."""
    contact = {"law": "hertz", "stiffness": 1e10}
    scene = SCENES["compound-pendulum"].replace({"contact": contact, "target.gravity": [0.0, 0.0]})
    mass, felt, speed = 0.2, 1.5 * 0.36 / 3.0 / 0.4**2, 2.0
    reduced = mass * felt / (mass + felt)
    deepest = deepest_of_power(1e10, 1.5, reduced, speed)
    peak, lasts = 1e10 * deepest**1.5, duration_of_power(1.5) * deepest / speed
    errors = []
    for steps in (50, 100, 200):
        found = Multibody(contact_steps=steps, estimate=False).solve(scene, 1e-3)
        (contact,) = found.contacts
        errors.append([contact.end / lasts - 1.0, found.peak_force / peak - 1.0])
        assert contact.impulse == approx(2.0 * reduced * speed, rel=1e-6)
        assert found.diagnostics["energy_drift"] < 1e-13 and found.diagnostics["constraint_error"] < 1e-14
        assert found.reactions[0]["impulse"] == approx([0.0, 0.0], abs=1e-6)
    assert np.abs(errors[-1]) == approx([0.0, 0.0], abs=1e-4) and np.abs(errors[0]) == approx([0.0, 0.0], abs=2e-3)
    assert errors[0][0] / errors[2][0] == approx(16.0, rel=0.02)  # of second order
    assert found.peak_indentation == approx(deepest, rel=1e-4) and found.residual_indentation == 0.0
    assert found.restitution["newton_at_contact"] == approx(1.0, abs=1e-6)


def test_a_bar_that_turns_far_while_it_is_struck():
    """By 21 degrees, on a soft spring, the mass sliding along it: as by integrating the angle of the bar, to 1e-13."""
    target = {
        "kind": "mechanism",
        "gravity": [0.0, -9.81],
        "links": [{"name": "bar", "from": [0.0, 0.0], "to": [0.6, 0.0], "mass": 1.5}],
        "joints": [{"links": ["ground", "bar"], "at": [0.0, 0.0]}],
        "drives": [{"joint": 0, "speed": 8.0, "initial": True}],
        "struck": {"link": "bar", "at": 0.5, "normal": [0.0, -1.0]},
    }
    contact = {"law": "linear", "stiffness": 600.0}
    table = {"impactor": {"mass": 0.8, "velocity": 1.0}, "target": target, "contact": contact}

    def change(_, state):
        angle, x, y, spin, along, up = state
        normal = np.array([np.sin(angle), -np.cos(angle)])
        force = 600.0 * max(normal @ [x, y], 0.0)
        turning = force * (x * normal[1] - y * normal[0]) - 1.5 * 9.81 * 0.3 * np.cos(angle)
        pushed = -force / 0.8 * normal
        return [spin, along, up, turning / (1.5 * 0.6**2 / 3.0), pushed[0], pushed[1] - 9.81]

    def apart(time, state):
        return np.sin(state[0]) * state[1] - np.cos(state[0]) * state[2] if time > 1e-3 else 1.0

    apart.terminal = True
    exact = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14}
    touching = solve_ivp(change, (0.0, 0.15), [0.0, 0.3, 0.0, 8.0, 0.0, -1.0], events=apart, **exact)
    parted = float(touching.t[-1])
    after = solve_ivp(change, (parted, 0.15), touching.y[:, -1], **exact).y[:, -1]
    assert np.degrees(touching.y[0, -1]) > 20.0
    errors = []
    for steps in (400, 800):
        found = Multibody(contact_steps=steps, steps=400, estimate=False).solve(Scene.from_table(table), 0.15)
        course, (contact,) = found.motion.course, found.contacts
        ends = [course.coordinates[-1, 2], *course.place[-1], course.rates[-1, 2], *course.speed[-1]]
        errors.append(np.append(ends - after, contact.end - parted))
        assert found.diagnostics["energy_drift"] < 1e-12
    assert np.abs(errors[1]).max() < 2e-6
    assert errors[0] / errors[1] == approx(np.full(7, 4.0), rel=0.02)  # of second order


@pytest.mark.parametrize("name", [name for name in LAWS if name != "rigid"])
def test_second_order_energy_and_restitution_of_every_law(name):
    """In a four-bar that turns by up to half a degree meanwhile."""
    scene, steps = four_bar(0, contact=contact_of(name, 1e9)), (60, 120, 240, 3840)
    every = [Multibody(steps=20, contact_steps=count, estimate=False).solve(scene, 0.003) for count in steps]
    last = every[-1]
    for found in every:
        known = found.diagnostics
        assert known["energy_drift"] < 1e-12 and known["constraint_error"] < 1e-14
        assert abs(known["momentum_error"]) < 1e-13 and len(found.contacts) == 1
    errors = [abs(found.impulse / last.impulse - 1.0) for found in every]
    if LAWS[name].PLASTIC:  # by where in a step it is deepest
        assert all(error < 3.0 * count**-2.0 for error, count in zip(errors, steps, strict=False))
        assert last.residual_indentation == approx(scene.contact.dent(last.peak_indentation), rel=1e-12)
        assert last.energy["dissipated"] > 0.1 and last.residual_indentation > 0.0
    else:
        assert np.log2(errors[0] / errors[1]) == approx(2.0, abs=0.1)
        assert np.log2(errors[1] / errors[2]) == approx(2.0, abs=0.1)
        delivered = RESTITUTION if LAWS[name].LOSSY else 1.0
        assert last.restitution["newton_at_contact"] == approx(delivered, abs=3e-3)  # of the turn
    times, force = last.motion.force_history()
    assert np.trapezoid(force, times) == approx(last.impulse, rel=1e-12)
    assert force.max() == last.peak_force == last.contacts[0].peak_force


@pytest.mark.parametrize(("initial", "power"), [(False, 2.0), (True, 1.0)])
def test_a_frozen_mechanism_is_off_by_how_far_it_turns_in_the_contact(initial, power):
    """Velocities by the square of the duration where a drive holds its speed, else in proportion to it; reactions in
    proportion. The note of either method says how much, to a factor of two."""
    off, noted = [], []
    for stiffness in (1e5, 1.6e6):  # durations as 4 to 1
        scene = four_bar(0, initial, contact={"law": "linear", "stiffness": stiffness})
        moving = Multibody(contact_steps=400, steps=20, estimate=False).solve(scene, 0.02)
        lasts = moving.contacts[0].end
        still = Modal(steps=2000, estimate=False).solve(scene, 1.2 * lasts)
        ends = np.array([1.1 * lasts])
        parts = [found.motion.impactor_velocity(ends)[0] for found in (moving, still)]
        joints = [
            np.array([joint["impulse"] for joint in found.reactions]) / found.impulse for found in (moving, still)
        ]
        off.append([abs(parts[0] - parts[1]) / scene.speed, np.abs(joints[0] - joints[1]).max()])
        notes = {note.code: note.values for found in (moving, still) for note in found.notes}
        noted.append([0.01 * notes[f"configuration-{how}"]["error"] for how in ("followed", "frozen")])
        assert notes["configuration-followed"]["angle"] == approx(notes["configuration-frozen"]["angle"], rel=0.3)
    assert np.log(off[0][0] / off[1][0]) / np.log(4.0) == approx(power, abs=0.1)
    assert np.log(off[0][1] / off[1][1]) / np.log(4.0) == approx(1.0, abs=0.1)
    assert 0.5 < noted[1][1] / off[1][0] < 4.0 and noted[1][0] == approx(noted[1][1], rel=0.5)


def test_what_freezing_is_off_by_is_nothing_for_what_lasts_no_time():
    scene = four_bar(0, True)
    assert freezing_error(scene, 0.0, 1.0, 0.0) == 0.0 < freezing_error(scene, 1e-3, 1.0, 0.0)


def test_a_stiff_law_tends_to_the_impulse_of_its_restitution():
    """To the impulse, the reactions, and the velocities of the links; in proportion to the duration."""
    impulse, off = RigidImpulse(RESTITUTION).solve(four_bar(0, True)), []
    for stiffness in (1e10, 1e12):
        law = {"law": "hunt-crossley", "stiffness": stiffness, "restitution": RESTITUTION}
        found = Multibody(estimate=False).solve(four_bar(0, True, contact=law), 0.002)
        lasts, joints = found.contacts[0].end, zip(impulse.reactions, found.reactions, strict=True)
        after = found.motion.link_rates(lasts)
        off.append(
            [
                lasts,
                abs(found.impulse - impulse.impulse),
                max(np.abs(np.subtract(one["impulse"], other["impulse"])).max() for one, other in joints),
                max(abs(link["final_spin"] - after[name]["final_spin"]) for name, link in impulse.links.items()),
            ]
        )
    assert all(value < limit for value, limit in zip(off[1], (1e-4, 3e-4, 3e-3, 3e-3), strict=True))
    assert off[0][2] / off[1][2] == approx(off[0][0] / off[1][0], rel=0.3)


def test_flexible_links_are_struck_as_the_frozen_ones():
    """Modes left out give way in both; the bar turns by less than two degrees until the mass has left it."""
    scene = rotating_bar(3, contact={"law": "hertz", "stiffness": 1e7})
    found, still = Multibody(estimate=False).solve(scene, 0.016), Modal(estimate=False).solve(scene)
    assert len(found.contacts) == len(still.contacts) == 3
    for one, other in zip(found.contacts, still.contacts, strict=True):
        assert (one.start, one.end) == approx((other.start, other.end), rel=2e-3)
        assert (one.impulse, one.peak_force) == approx((other.impulse, other.peak_force), rel=2e-3)
    assert found.impactor_velocity == approx(still.impactor_velocity, abs=1e-4)
    assert found.reactions[0]["impulse"][1] == approx(still.reactions[0]["impulse"][1], rel=2e-3)
    assert found.reactions[0]["moment_impulse"] == approx(still.reactions[0]["moment_impulse"], rel=5e-3)
    assert found.diagnostics["energy_drift"] < 1e-10 and found.diagnostics["constraint_error"] < 1e-13
    assert found.energy["target_vibration"] > 0.0


def test_momentum_of_what_nothing_holds():
    """Two links on a pin, struck off centre by a law that leaves a dent: momentum and angular momentum, to rounding."""
    target = {
        "kind": "mechanism",
        "links": [
            {"name": "first", "from": [0.0, 0.0], "to": [0.4, 0.0], "mass": 0.5},
            {"name": "second", "from": [0.4, 0.0], "to": [0.4, 0.3], "mass": 0.8},
        ],
        "joints": [{"links": ["first", "second"], "at": [0.4, 0.0]}],
        "struck": {"link": "second", "at": 0.8, "normal": [0.6, 0.8]},
    }
    table = {"impactor": {"mass": 0.4, "velocity": 3.0}, "target": target, "contact": contact_of("plastic-power")}
    found = Multibody(estimate=False).solve(Scene.from_table(table), 0.1)
    course, masses = found.motion.course, np.array([0.5, 0.8, 0.4])
    places = np.concatenate((course.coordinates.reshape(-1, 2, 3)[:, :, :2], course.place[:, None]), axis=1)
    rates = np.concatenate((course.rates.reshape(-1, 2, 3)[:, :, :2], course.speed[:, None]), axis=1)
    momentum = np.einsum("b,tbk->tk", masses, rates)
    turning = (masses * (places[..., 0] * rates[..., 1] - places[..., 1] * rates[..., 0])).sum(axis=1)
    turning += course.rates[:, 2::3] @ [0.5 * 0.4**2 / 12.0, 0.8 * 0.3**2 / 12.0]
    assert np.abs(momentum - momentum[0]).max() < 1e-14 * course.time.size
    assert np.abs(turning - turning[0]).max() < 1e-14 * course.time.size
    assert found.energy["dissipated"] > 0.0 and found.diagnostics["energy_drift"] < 1e-11


def test_a_dent_stays_and_is_not_made_again():
    """The first fall yields; later ones are slower, elastic, and all alike: flights of 2 v / g. But for what the steps
    of the first have missed of its depth, of second order."""
    found = Multibody(estimate=False, steps=200).solve(floor(contact_of("plastic-linear")), 0.6)
    first, second, third, *_ = found.contacts
    leaves = float(-found.motion.impactor_velocity(np.array([first.end]))[0])
    assert leaves < 1.9 and second.peak_force < first.peak_force
    flight = 2.0 * leaves / 10.0
    assert second.start - first.end == approx(flight, rel=1e-10)
    assert third.start - second.end == approx(flight, rel=1e-3)
    assert third.impulse == approx(second.impulse, rel=1e-3)
    lost = found.motion.energies(np.array([first.end, second.end, third.end]))["dissipated"]
    gained = 10.0 * found.scene.contact.dent(found.peak_indentation)  # by the depth of the dent
    assert lost == approx(np.full(3, 0.5 * (4.0 - leaves**2) + gained), rel=1e-4)
    assert found.residual_indentation == approx(found.scene.contact.dent(found.peak_indentation), rel=1e-12)
    assert found.diagnostics["energy_drift"] < 1e-12


def test_a_mass_comes_to_rest_on_a_law_that_damps():
    """Its weight lies on the bar in the end, which the steps of a contact that lasts need not resolve for ever."""
    law = {"law": "kelvin-voigt", "stiffness": 1e7, "restitution": 0.5}
    found = Multibody(estimate=False, steps=400).solve(floor(law), 1.0)
    assert found.impulse == approx(2.0 + 10.0, rel=1e-9)
    assert found.motion.force(np.array([0.9])) == approx(10.0, rel=1e-6)
    assert found.motion.reaction_forces(np.array([0.9]))[0, 0] == approx([0.0, 20.0, 5.0], rel=1e-5)
    assert found.energy["local"] == approx(0.5 * 10.0**2 / 1e7, rel=1e-5)
    assert found.diagnostics["energy_drift"] < 1e-12 and found.contacts[-1].end == approx(1.0)
    assert found.motion.time.size < 10_000


def test_a_mechanism_strikes_by_a_law():
    """The arm of the trip hammer on a mass: as two masses meet, and the pivot gives half of it."""
    table = SCENES["trip-hammer"].table()
    link = {"name": "arm", "from": [0.0, 0.0], "to": [0.5, 0.0], "mass": 3.0}
    table["impactor"] |= {"links": [link], "gravity": [0.0, 0.0]}
    table |= {"target": {"kind": "mass", "mass": 2.0}, "contact": {"law": "linear", "stiffness": 1e9}}
    found = solvers.solve(Scene.from_table(table), "multibody", duration=0.001)
    reduced = 2.0 * 1.0 / 3.0
    assert found.impulse == approx(2.0 * reduced * 2.0, rel=1e-5) and found.target_velocity == approx(
        4.0 / 3.0, rel=1e-5
    )
    assert found.contacts[0].end == approx(np.pi * np.sqrt(reduced / 1e9), rel=1e-4)
    assert found.reactions[0]["impulse"][1] == approx(0.5 * found.impulse, rel=1e-3)
    assert found.diagnostics["energy_drift"] < 1e-12


def test_restitution_does_not_count_beside_a_law():
    scene = floor({"law": "linear", "stiffness": 1e6}, gravity=0.0)
    notes = {note.code for note in Multibody(restitution=0.5).solve(scene, 0.01).notes}
    assert "law-without-restitution" in notes
    without = Multibody().solve(scene, 0.01)
    assert "law-without-restitution" not in {note.code for note in without.notes}
    assert without.diagnostics["estimated_error"] < 1e-4 and "balances" not in without.diagnostics


def test_contacts_without_end_are_cut_short():
    law = {"law": "kelvin-voigt", "stiffness": 1e7, "restitution": 0.5}
    found = Multibody(estimate=False, most_contact_steps=300).solve(floor(law), 1.0)
    assert "cut-short" in {note.code for note in found.notes} and found.duration < 1.0
