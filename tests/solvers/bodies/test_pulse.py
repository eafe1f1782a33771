"""A prescribed force on the end of a rod."""

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene, SceneError, SceneNotSupported
from solvers.methods.waves.chain_grid import GridHistory
from solvers.methods.waves.chain_scene import ChainScene
from solvers.numerics.waves.record import IMPULSE

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


PULSES = [  # each with its impulse over force and duration
    ({"shape": "rectangle"}, 1.0),
    ({"shape": "triangle"}, 0.5),
    ({"shape": "trapezoid"}, 0.9),
    ({"shape": "trapezoid", "rise": 0.0}, 1.0),
    ({"shape": "half-sine"}, 2.0 / np.pi),
]


@pytest.mark.parametrize("shaped, share", PULSES)
@pytest.mark.parametrize("duration", [0.05 * T, 0.4 * T, 3.0 * T])
def test_every_shape_gives_a_free_rod_its_own_impulse(shaped, share, duration):
    solution = solvers.solve(pushed("free", force=1e4, duration=duration, **shaped))
    impulse = 1e4 * duration * share
    assert solution.impulse == approx(impulse, rel=1e-13)
    assert solution.target_velocity == approx(impulse / solution.scene.target.mass, rel=1e-12)


@pytest.mark.parametrize("shaped, share", PULSES)
def test_on_a_grid_of_times_too(shaped, share):
    scene = pushed("free", force=1e4, duration=0.4 * T, **shaped)
    history = GridHistory(ChainScene(scene), until=1.7, horizon=1.7, share=0.001)
    pressed = history.sampled(0, IMPULSE, np.array([history.reach]))[0] * history.force_unit * history.trip
    assert pressed == approx(1e4 * 0.4 * T * share, rel=1e-12)


def test_points_give_the_impulse_of_the_lines_between_them():
    points = [[0.0, 2e3], [3e-5, 5e3], [3e-5, 1e3], [7e-5, 4e3], [9e-5, 0.0]]
    solution = solvers.solve(pushed("free", points=points))
    times, forces = np.transpose(points)
    assert solution.impulse == approx(np.trapezoid(forces, times), rel=1e-13)
    fine = np.linspace(0.0, 1e-4, 1001)
    assert solution.scene.impactor.pushed(fine)[-1] == approx(solution.impulse, rel=1e-13)
    assert (np.diff(solution.scene.impactor.pushed(fine)) >= 0.0).all()


def test_a_half_sine_is_a_sine_at_every_time_and_place():
    duration = 0.2 * T
    motion = solvers.solve(pushed(shape="half-sine", force=1e4, duration=duration), duration=1.5 * T).motion
    t = np.linspace(0.0, duration, 101)
    sine = 1e4 * np.sin(np.pi * t / duration)
    assert motion.force(t) == approx(sine, abs=1e-12 * 1e4)
    stress = motion.stress(t + 0.35 * T, np.array([0.7]))[:, 0]
    assert stress * motion.scene.target.area == approx(sine, abs=1e-11 * 1e4)


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
