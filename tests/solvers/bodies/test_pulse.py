"""A prescribed force on the end of a rod."""

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene, SceneError, SceneNotSupported

BAR = {"length": 1.0, "section": {"radius": 0.01}, "material": "steel"}
T = solvers.Rod.read("target", BAR | {"kind": "rod"}).round_trip_time


def pushed(support="anechoic", target=None, **pulse):
    return Scene.from_table(
        {"impactor": {"kind": "pulse"} | pulse, "target": target or {"kind": "rod", "support": support} | BAR}
    )


def test_the_wave_is_the_force_one_transit_later():
    scene = pushed(shape="trapezoid", force=1e4, duration=0.2 * T, rise=0.05 * T)
    motion = solvers.solve(scene, duration=1.5 * T).motion
    t = np.linspace(0.01, 0.99, 57) * T
    stress = motion.stress(t + 0.5 * T * 0.7, np.array([0.7]))[:, 0]  # waves keep their shape, thesis (4.2)
    assert stress * scene.target.area == approx(motion.force(t), abs=1e-6 * 1e4)


def test_a_rectangle_on_a_free_rod_moves_it_by_its_impulse():
    scene = pushed("free", force=1e4, duration=0.3 * T)
    solution = solvers.solve(scene)
    assert solution.impulse == approx(1e4 * 0.3 * T, rel=1e-12)
    assert solution.target_velocity == approx(solution.impulse / scene.target.mass, rel=1e-11)
    assert abs(solution.diagnostics["energy_error"]) < 1e-12
    assert solution.impactor_velocity is None
    assert solution.table()["restitution"] == {"newton": None, "poisson": None, "newton_at_contact": None}


def test_a_step_of_impedance_sends_on_and_back_what_it_must():
    thick = {"length": 1.0, "section": {"radius": 0.02}, "material": "steel"}
    scene = pushed(target={"kind": "rods", "support": "anechoic", "rods": [BAR, thick]}, force=1e4, duration=0.1 * T)
    motion = solvers.solve(scene, duration=1.4 * T).motion
    ratio = 4.0  # of the sections, and so of the impedances
    on = motion.stress(np.array([0.8 * T]), np.array([1.55]))[0, 0] * np.pi * 0.02**2
    back = motion.stress(np.array([0.8 * T]), np.array([0.45]))[0, 0] * np.pi * 0.01**2
    assert on == approx(1e4 * 2.0 * ratio / (1.0 + ratio), rel=1e-10)
    assert back == approx(1e4 * (ratio - 1.0) / (1.0 + ratio), rel=1e-10)


def test_a_pulse_is_written_and_read_back():
    scene = pushed(shape="half-sine", force=2e3, duration=1e-4)
    again = Scene.from_table(scene.table())
    assert again.impactor == scene.impactor
    assert again.table() == scene.table()


@pytest.mark.parametrize(
    "pulse, key",
    [
        ({"force": 1e4}, "impactor.duration"),
        ({"force": -1.0, "duration": 1e-4}, "impactor.force"),
        ({"force": float("nan"), "duration": 1e-4}, "impactor.force"),
        ({"force": 1.0, "duration": 1e-4, "rise": 1e-5}, "impactor.rise"),
        ({"shape": "square", "force": 1.0, "duration": 1e-4}, "impactor.shape"),
        ({"points": [[0.0, 1.0]]}, "impactor.points"),
        ({"points": [[0.0, 1.0], [1e-4, 2.0], [5e-5, 0.0]]}, "impactor.points"),
        ({"points": [[0.0, 0.0], [1e-4, 0.0]]}, "impactor.points"),
        ({"points": [[0.0, 1.0], [1e-4, 2.0]], "force": 1.0}, "impactor.force"),
    ],
)
def test_bad_pulses_are_refused(pulse, key):
    with pytest.raises(SceneError) as refused:
        pushed(**pulse)
    assert refused.value.key == key


def test_a_pulse_needs_a_rod_and_waves():
    with pytest.raises(SceneError, match=r"target.kind"):
        pushed(target={"kind": "mass", "mass": 1.0}, force=1.0, duration=1e-4)
    with pytest.raises(SceneNotSupported, match="prescribed force"):
        solvers.solve(pushed(force=1.0, duration=1e-4), "modal")
