"""Mechanisms that run into a stop as they move: closed forms, order, what is conserved, and the frozen mechanism."""

import math

import numpy as np
import pytest
from pytest import approx
from scipy.special import ellipk

import solvers
from solvers import Modal, Scene
from solvers.methods.base import SceneNotSupported
from solvers.methods.multibody.method import Multibody
from tests.catalog import SCENES

MASS, LENGTH, SPEED = 1.5, 0.6, 2.0  # of a bar on a pivot, its tip at that speed
FELT = MASS / 3.0  # at its tip: inertia over the square of the length


def bar_on_stop(at: float = 1.0, modes: int = 0, gravity: float = 0.0, target: dict | None = None, **contact) -> Scene:
    """A bar on a pivot that turns into a stop."""
    link = {"name": "bar", "from": [0.0, 0.0], "to": [LENGTH, 0.0], "mass": MASS}
    if modes:
        link |= {"section": {"width": 0.03, "height": 0.008}, "material": "steel", "modes": modes}
    impactor = {
        "kind": "mechanism",
        "links": [link],
        "joints": [{"links": ["ground", "bar"], "at": [0.0, 0.0]}],
        "drives": [{"joint": 0, "speed": -SPEED / LENGTH, "initial": True}],
        "struck": {"link": "bar", "at": at, "normal": [0.0, -1.0]},
        "gravity": [0.0, -gravity],
    }
    tables = {"impactor": impactor, "target": target or {"kind": "stop"}, "contact": contact or {"law": "rigid"}}
    return Scene.from_table(tables)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("at", [0.5, 1.0])
def test_impulse_of_a_stop(restitution, at):
    """J = (1 + e) I / a^2 v, v = a w; the pivot bears what the stop does not turn of the bar: J (1 - a L m / 2 I)."""
    arm, inertia = at * LENGTH, MASS * LENGTH**2 / 3.0
    found = Multibody(restitution=restitution).solve(bar_on_stop(at), 0.05)
    impulse = (1.0 + restitution) * inertia / arm**2 * at * SPEED
    assert found.impulse == approx(impulse, rel=1e-13)
    assert found.links["bar"]["final_spin"] == approx(restitution * SPEED / LENGTH, abs=1e-12)
    assert found.reactions[0]["impulse"] == approx(
        [0.0, impulse * (0.5 * MASS * LENGTH * arm / inertia - 1.0)], abs=1e-12
    )
    assert found.target_velocity == 0.0 and found.diagnostics["momentum_error"] == approx(0.0, abs=1e-14)
    energy = found.energy
    assert energy["impactor"] == approx(restitution**2 * energy["initial"], abs=1e-13)
    assert energy["dissipated"] == approx((1.0 - restitution**2) * energy["initial"], abs=1e-13)
    assert energy["target_rigid"] == energy["target_vibration"] == 0.0


def test_bounces_on_a_stop_end_where_they_come_to_rest():
    """A block on a guide, at v downwards on the stop: flights of 2 e^k v / g, in all 2 v e / (g (1 - e))."""
    block = {"name": "block", "from": [-0.1, 0.0], "to": [0.1, 0.0], "mass": 1.2}
    guide = {"kind": "prismatic", "links": ["ground", "block"], "at": [0.0, 0.0], "axis": [0.0, 1.0]}
    impactor = {
        "kind": "mechanism",
        "links": [block],
        "joints": [guide],
        "drives": [{"joint": 0, "speed": -1.0, "initial": True}],
        "struck": {"link": "block", "at": 0.5, "normal": [0.0, -1.0]},
        "gravity": [0.0, -10.0],
    }
    scene = Scene.from_table({"impactor": impactor, "target": {"kind": "stop"}})
    found = Multibody(restitution=0.5, steps=1000).solve(scene, 0.5)
    assert [contact.start for contact in found.contacts[:4]] == approx([0.0, 0.1, 0.15, 0.175], abs=1e-12)
    assert [contact.impulse for contact in found.contacts[:3]] == approx([1.8, 0.9, 0.45], rel=1e-10)
    (note,) = found.notes
    assert note.code == "rests-on-stop" and note.values["time"] == approx(0.2, abs=1e-4)
    assert found.duration == note.values["time"]
    assert found.energy["impactor"] < 1e-5 and abs(found.diagnostics["energy_error"]) < 1e-12


def turning_in(contact_steps: int) -> tuple[float, float]:
    """A soft stop half-way along the bar, into which it turns by 33 degrees: how long [s], and how far [rad]."""
    stiffness = (MASS * SPEED**2 / 3.0) / (0.3 * (0.5 * LENGTH) ** 2)
    scene = bar_on_stop(0.5, law="linear", stiffness=stiffness)
    found = Multibody(contact_steps=contact_steps, estimate=False).solve(scene, 1.0)
    (contact,) = found.contacts
    assert abs(found.diagnostics["energy_error"]) < 1e-12 and abs(found.diagnostics["momentum_error"]) < 1e-12
    followed = found.motion.struck  # which knows its links at every step
    within = followed.time <= contact.end
    return contact.end - contact.start, float(np.abs(followed.centres[within, 2]).max())


def test_a_bar_that_turns_far_into_a_soft_stop():
    """I a'' = -k r^2 sin a cos a, a pendulum in 2 a: 2 K(m) / w with w^2 = k r^2 / I and m = (a' / w)^2 = 0.3."""
    spin = SPEED / LENGTH
    exact = 2.0 * ellipk(0.3) * math.sqrt(0.3) / spin
    errors = [abs(turning_in(steps)[0] - exact) / exact for steps in (50, 100, 200)]
    assert errors[-1] < 1e-4
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == approx([2.0, 2.0], abs=0.3)
    assert turning_in(200)[1] == approx(math.asin(math.sqrt(0.3)), rel=1e-4)


@pytest.mark.parametrize(
    "contact",
    [
        {"law": "hertz", "stiffness": 1e9},
        {"law": "hunt-crossley", "stiffness": 1e10, "damping": 1.0},
        {"law": "yigit-christoforou", "stiffness": 1e9, "yield_indentation": 1e-5},
    ],
    ids=lambda contact: contact["law"],
)
def test_a_short_contact_is_that_of_the_frozen_mechanism(contact):
    """The bar turns by less than 0.1 degrees, so that what freezing leaves out is far below the error of the steps."""
    scene = bar_on_stop(gravity=9.81, **contact)
    frozen = Modal(estimate=False).solve(scene)
    found = Multibody(estimate=False).solve(scene, frozen.duration)
    assert found.impulse == approx(frozen.impulse, rel=3e-5)
    assert found.impactor_velocity == approx(frozen.impactor_velocity, abs=1e-4 * SPEED)
    assert found.peak_force == approx(frozen.peak_force, rel=2e-4)  # means over steps, of either
    assert abs(found.diagnostics["energy_error"]) < 1e-12 and abs(found.diagnostics["momentum_error"]) < 1e-12
    (note,) = (note for note in found.notes if note.code == "configuration-followed")
    assert 1e-3 < note.values["angle"] < 0.2 and note.values["error"] < 1e-3  # at its deepest, not as it parts


def test_a_bar_that_bends_on_a_stop():
    """One impulse takes up what the struck point can give; the next ones come as the bar swings back."""
    found = Multibody(restitution=0.0, estimate=False).solve(bar_on_stop(modes=3), 0.01)
    felt = found.scene.impactor.frozen.modes
    sudden = SPEED / (1.0 / felt.rigid_mass + float(felt.at_contact @ felt.at_contact))
    assert found.contacts[0].impulse == approx(sudden, rel=1e-9) and sudden < 0.7 * FELT * SPEED
    assert abs(found.diagnostics["energy_error"]) < 1e-9 and abs(found.diagnostics["momentum_error"]) < 1e-9


ROD = {"kind": "rod", "length": 0.3, "section": {"area": 1e-4}, "material": "steel", "support": "free"}


@pytest.mark.parametrize(
    "target", [{"kind": "half-space", "material": "steel"}, ROD], ids=lambda target: target["kind"]
)
def test_what_is_neither_a_mass_nor_a_stop_is_refused(target):
    with pytest.raises(SceneNotSupported) as refused:
        solvers.solve(bar_on_stop(target=target), method="multibody")
    assert refused.value.reason.code == "refusals.mass-on-mechanism"
    assert refused.value.reason.values["impactor"] == target["kind"]


def test_frozen_is_enough_for_a_hammer_on_a_rod():
    """The trip hammer on a mass as large as its rod, contacts as long: freezing it leaves out 1e-5."""
    hammer = SCENES["trip-hammer"].table()["impactor"]
    hammer["links"][0]["modes"] = 3
    mass = {"kind": "mass", "mass": SCENES["trip-hammer"].target.mass}
    scene = Scene.from_table({"impactor": hammer, "target": mass, "contact": {"law": "hertz"}})
    frozen = Modal(modes=3, estimate=False).solve(scene)
    found = Multibody(estimate=False).solve(scene, frozen.duration)
    assert found.contacts[-1].end == approx(frozen.contacts[-1].end, rel=1e-3) and found.contacts[-1].end > 5e-4
    assert found.target_velocity == approx(frozen.target_velocity, abs=2e-5 * scene.speed)
    assert found.impulse == approx(frozen.impulse, rel=2e-5)
    (note,) = (note for note in frozen.notes if note.code == "configuration-frozen")
    assert note.values["error"] < 5e-3  # %, of all the time from first touch to last parting
