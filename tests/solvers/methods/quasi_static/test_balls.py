"""A row of balls: one ball after the other, Newton's cradle, what is kept, another integration."""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from pytest import approx
from scipy.integrate import solve_ivp

import solvers
from solvers import Scene, SceneError, SceneNotSupported
from solvers.numerics import ball_chain

DOCS = Path(__file__).parents[4] / "docs"
CRADLE = solvers.load("newtons-cradle")
BALL = {"radius": 0.02}
# how-it-is-computed, "Quasi-static estimates"
PROMISED = float(re.search(r"exactly; energy is kept to (\S+) ", (DOCS / "how-it-is-computed.md").read_text())[1])


def row(*balls: dict, **impactor) -> Scene:
    striker = {"kind": "sphere", "radius": 0.02, "velocity": 1.0} | impactor
    return Scene.from_table(
        {"impactor": striker, "target": {"kind": "balls", "balls": list(balls)}, "contact": {"law": "hertz"}}
    )


def final(solution) -> list[float]:
    return [solution.impactor_velocity, *solution.ball_velocities]


def test_one_ball_is_an_impact_of_two():
    """Hertz's closed form: peak, impulse and contact time; the struck ball takes all the velocity."""
    found = solvers.solve(row(BALL))
    pair = solvers.solve(
        Scene.from_table(
            {
                "impactor": {"kind": "sphere", "radius": 0.02, "velocity": 1.0},
                "target": {"kind": "sphere", "radius": 0.02} | {"kind": "mass", "mass": found.scene.impactor.mass},
                "contact": {"law": "hertz"},
            }
        )
    )
    assert final(found) == approx([0.0, 1.0], abs=1e-9)
    assert found.peak_force == approx(pair.peak_force, rel=1e-3)  # sampled eight times a step
    assert found.contacts[0].end == approx(pair.contacts[0].end, rel=1e-6)
    assert found.impulse == approx(pair.impulse, rel=1e-9)


@pytest.mark.parametrize("gap", [2e-4, 1e-3])
def test_one_in_is_one_out_where_there_are_gaps(gap):
    """Each pair is over before the next one meets: velocities are handed on, whatever the law."""
    found = solvers.solve(row(BALL, BALL | {"gap": gap}, BALL | {"gap": gap}))
    assert final(found) == approx([0.0, 0.0, 0.0, 1.0], abs=1e-8)


def test_one_in_is_not_one_out_where_balls_touch():
    """In longer rows the first ones come back at 0.0711 and 0.0303: the wave leaves them before it meets the end
    (Hinch and Saint-Jean 1999)."""
    assert final(solvers.solve(row(BALL, BALL))) == approx([-0.0710, 0.0764, 0.9945], abs=1e-4)
    for solution in (solvers.solve(CRADLE), solvers.solve(row(*[BALL] * 6))):
        assert final(solution)[:2] == approx([-0.0711, -0.0303], abs=1e-4)
        assert 0.98 < final(solution)[-1] < 0.99


def test_speed_and_stiffness_change_nothing_in_the_shares():
    for changes in ({"impactor.velocity": 30.0}, {"contact.stiffness": 1e7}):
        assert np.divide(final(solvers.solve(CRADLE.replace(changes))), CRADLE.replace(changes).speed) == approx(
            final(solvers.solve(CRADLE)), abs=1e-8
        )


UNLIKE = row({"radius": 0.01}, {"radius": 0.03, "gap": 1e-5}, {"radius": 0.015, "material": "bronze"}, radius=0.025)


@pytest.mark.parametrize("scene", [CRADLE, UNLIKE], ids=["alike", "unlike"])
def test_momentum_and_energy_are_kept(scene):
    solution = solvers.solve(scene)
    masses = [scene.impactor.mass, *(ball.mass for ball in scene.target.balls)]
    velocities = final(solution)
    assert np.dot(masses, velocities) == approx(masses[0] * scene.speed, rel=1e-14)
    assert 0.5 * np.dot(masses, np.square(velocities)) == approx(scene.initial_energy, rel=1e-9)
    assert abs(solution.diagnostics["energy_error"]) < 1e-9
    energies = solution.motion.energies(np.linspace(0.0, solution.duration, 50))
    assert sum(energies.values()) == approx(np.full(50, scene.initial_energy), rel=1e-4)  # straight between instants
    assert velocities == sorted(velocities)  # nothing meets again
    assert sum(period.impulse for period in solution.joints[-1]) == approx(masses[-1] * velocities[-1], rel=1e-8)


ROUGH = row(  # of 230 random rows the one whose energy was kept worst: light balls chatter between heavy ones
    {"radius": 0.0063, "material": "aluminium"},
    {"radius": 0.0077, "gap": 2.5e-4},
    {"radius": 0.0353, "material": "aluminium"},
    {"radius": 0.0032, "material": "bronze"},
    {"radius": 0.0045},
    {"radius": 0.0152, "material": "bronze", "gap": 1.3e-6},
    {"radius": 0.01, "material": "aluminium"},
    {"radius": 0.0059},
    radius=0.0416,
    material="aluminium",
)


def random_row(number: int) -> Scene:
    random = np.random.default_rng([55, number])

    def ball() -> dict:
        return {
            "radius": 10.0 ** random.uniform(-2.5, -1.3),
            "material": str(random.choice(["steel", "aluminium", "bronze"])),
        }

    gaps = [{}, *({"gap": 10.0 ** random.uniform(-7.0, -3.0) * (random.random() < 0.5)} for _ in range(5))]
    balls = [ball() | gap for gap in gaps[: random.integers(1, 7)]]
    return row(*balls, **ball(), velocity=10.0 ** random.uniform(-1.0, 1.0))


@pytest.mark.parametrize("scene", [ROUGH, *map(random_row, range(12))])
def test_any_row_keeps_the_energy_that_the_documentation_promises(scene):
    assert abs(solvers.solve(scene).diagnostics["energy_error"]) < PROMISED


def test_against_another_integration():
    """With velocities in the state, where ours has impulses, and steps that miss no contact."""
    scene = UNLIKE
    masses = np.array([scene.impactor.mass, *(ball.mass for ball in scene.target.balls)])
    laws = [scene.contact, *scene.joint_laws]
    gaps = np.array([0.0, *scene.target.gaps])
    assert len({law.stiffness for law in laws}) == 3  # of radii and materials of their own
    length = 1e-5

    def rates(_, state):
        force = [
            law.stiffness * max(a, 0.0) ** 1.5 for law, a in zip(laws, -np.diff(state[:4]) * length - gaps, strict=True)
        ]
        return np.concatenate((state[4:] / length, (np.append(0.0, force) - np.append(force, 0.0)) / masses))

    start = np.array([0, 0, 0, 0, 1.0, 0, 0, 0])
    solution = solvers.solve(scene)
    found = solve_ivp(rates, (0.0, solution.duration), start, "DOP853", rtol=1e-12, atol=1e-13, max_step=2e-6)
    assert final(solution) == approx(found.y[4:, -1], abs=1e-8)


@pytest.mark.parametrize("duration", [None, 3.0])
def test_no_steps_are_spent_while_nothing_touches(duration):
    """Balls so far apart that they touch two at a time: by the exchange of momentum, some 10 000 contact times."""
    scene = row({"radius": 0.01}, {"radius": 0.03, "gap": 0.2}, {"radius": 0.005, "gap": 0.08}, radius=0.025)
    masses = np.array([scene.impactor.mass, *(ball.mass for ball in scene.target.balls)])
    velocities, place = np.array([scene.impactor.velocity, 0.0, 0.0, 0.0]), np.array([0.0, 0.0, 0.2, 0.28])
    contacts = 0
    while (closing := -np.diff(velocities)).max() > 1e-12:
        near = np.flatnonzero(closing > 1e-12)
        times = np.diff(place)[near] / closing[near]
        k, contacts = int(near[times.argmin()]), contacts + 1
        place = place + velocities * times.min()
        first, second = masses[k], masses[k + 1]
        common = (first * velocities[k] + second * velocities[k + 1]) / (first + second)
        velocities[k], velocities[k + 1] = 2.0 * common - velocities[k], 2.0 * common - velocities[k + 1]
    found = solvers.solve(scene, duration=duration)
    assert final(found) == approx(velocities, abs=1e-8)
    assert len(found.contacts) + sum(len(periods) for periods in found.joints) == contacts > 2
    assert found.diagnostics["steps"] < 100 * contacts
    last = max(period.end for periods in (found.contacts, *found.joints) for period in periods)
    moved = found.known_motion.impactor_position(np.array([found.duration]))[0]
    assert moved == approx(place[0] + velocities[0] * (found.duration - last), rel=1e-3)
    assert duration in (None, found.duration)


def test_a_touch_that_comes_too_late_is_told():
    found = solvers.solve(row({"radius": 0.01}, {"radius": 0.03, "gap": 5.0}, radius=0.025))
    assert [note.code for note in found.notes] == ["not-parted"] and found.duration < 4.0


def test_a_row_that_goes_on_is_cut_and_says_so_but_for_a_duration(monkeypatch):
    whole = solvers.solve(UNLIKE)
    monkeypatch.setattr(ball_chain, "MAX_STEPS", whole.diagnostics["steps"] // 2)
    cut = solvers.solve(UNLIKE)
    assert cut.diagnostics["steps"] == ball_chain.MAX_STEPS and cut.duration < whole.duration
    assert {note.code for note in cut.notes} & {"not-parted", "still-touching"}
    asked = solvers.solve(UNLIKE, duration=whole.duration)
    assert final(asked) == approx(final(whole), abs=1e-9)
    assert {note.severity for note in asked.notes} <= {"remark"}


def test_a_scene_is_written_back_and_its_result_is_json():
    assert Scene.from_table(UNLIKE.table()) == UNLIKE
    written = json.loads(json.dumps(solvers.solve(UNLIKE).table(), allow_nan=False))
    assert len(written["balls"]) == 3 and len(written["joints"]) == 2


def test_a_duration_is_kept_to():
    solution = solvers.solve(CRADLE, duration=1e-4)
    assert solution.duration == 1e-4
    assert [note.code for note in solution.notes] == ["still-touching"]


@pytest.mark.parametrize("name", sorted(set(solvers.METHODS) - {"quasi-static"}))
def test_other_methods_say_what_knows_rows(name):
    with pytest.raises(SceneNotSupported, match="row of balls; use 'quasi-static'"):
        solvers.solve(CRADLE, name)


@pytest.mark.parametrize(
    "key, value, named, said",
    [
        ("target.balls", [], "target.balls", "1 to 30 balls"),
        ("target.balls", 3, "target.balls", "1 to 30 balls"),
        ("target.balls", [BALL] * 31, "target.balls", "1 to 30 balls"),
        ("target.balls", [BALL, {"mass": 1.0}], "target.balls[2].radius", "from 1"),
        ("target.balls", [BALL | {"gap": 1e-3}], "target.balls[1].gap", "first ball"),
        ("target.balls", [BALL, BALL | {"gap": -1.0}], "target.balls[2].gap", "a number from 0"),
        ("target.balls", [BALL, BALL | {"colour": 1}], "target.balls[2].colour", "no such key"),
        ("target.balls", [BALL, BALL | {"gap": math.nan}], "target.balls[2].gap", "a number"),
        ("contact", {"law": "rigid"}, "method.name", "gives way"),
        ("contact", {"law": "hunt-crossley", "restitution": 0.5}, "method.name", "loses nothing"),
        (
            "impactor",
            {"kind": "rod", "length": 0.1, "section": {"radius": 0.01}, "material": "steel", "velocity": 1.0},
            "method.name",
            "a mass",
        ),
    ],
)
def test_what_is_refused(key, value, named, said):
    with pytest.raises(SceneError) as refused:
        solvers.solve(CRADLE.replace({key: value}))
    assert refused.value.key == named and said in refused.value.allowed
