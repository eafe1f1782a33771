"""The integrator of flexible links: its order, what it conserves, its vibrations, and its rigid limit."""

import numpy as np
import pytest
from pytest import approx

from solvers import Scene
from solvers.jit.kernels import kernel
from solvers.jit.reference import refer
from solvers.methods.multibody.floating_linkage import bent_start, floating_linkage, room_of
from solvers.methods.multibody.linkage import centres, rates_of_centres, rigid_linkage
from solvers.numerics.beams.rotating import rotating_frequencies
from solvers.numerics.multibody import moving
from solvers.numerics.multibody.free import joints_at, look, step_on
from solvers.numerics.multibody.inertia import actions
from solvers.numerics.multibody.integrals import frames_of
from solvers.numerics.multibody.moving import STAGES
from solvers.numerics.multibody.variational import Seen
from tests.solvers.bodies.linkage.mechanisms import FLAT, STEEL, rotating_bar

RATTLE = np.ones(1)


@kernel
def probe(linkage, room, q, v, momentum, force):
    """What an inner kernel writes, for Python."""
    actions(refer(linkage), refer(room).room, q, v, momentum, force)


def mechanism(links, joints=(), **more):
    target = {"kind": "mechanism", "links": links, "joints": list(joints), **more}
    target["struck"] = {"link": links[-1]["name"], "at": 1.0, "normal": [0.0, 1.0]}
    return Scene.from_table({"impactor": {"mass": 1.0, "velocity": 1.0}, "target": target}).target


def free_bar(shapes: str):
    bar = {"name": "bar", "from": [0.0, 0.0], "to": [0.3, 0.4], "mass": 1.5, "section": FLAT, "material": STEEL}
    return mechanism([bar | {"modes": 2, "axial": 1, "shapes": shapes}])


def pendulum(young: float = 207e9, modes: int = 2):
    """Two thin bars that fall from the horizontal."""
    bar = {"section": {"width": 0.02, "height": 0.004}, "material": STEEL | {"young": young}, "modes": modes}
    links = [
        bar | {"name": "upper", "from": [0.0, 0.0], "to": [0.4, 0.0], "mass": 0.5},
        bar | {"name": "lower", "from": [0.4, 0.0], "to": [0.4, 0.4], "mass": 0.5, "shapes": "pinned-pinned"},
    ]
    joints = [{"links": ["ground", "upper"], "at": [0.0, 0.0]}, {"links": ["upper", "lower"], "at": [0.4, 0.0]}]
    return mechanism(links, joints, gravity=[0.0, -9.81])


class Follower:
    """A mechanism stepped on by itself."""

    def __init__(self, mechanism):
        self.linkage, self.rows = floating_linkage(mechanism)
        self.room = room_of(self.linkage, self.rows)
        self.q, self.v, _ = bent_start(mechanism, self.linkage, self.rows)
        self.stiffness, self.gravity = mechanism.system.stiffness, mechanism.system.gravity
        self.masses = np.array([link.mass for link in mechanism.system.links])

    def run(self, step: float, steps: int, stages: np.ndarray = STAGES) -> np.ndarray:
        """States (steps + 1, 2, size)."""
        states, reactions = [np.array([self.q, self.v])], np.zeros(self.rows.joint.size)
        for number in range(steps):
            step_on(self.linkage, self.room, stages, self.q, self.v, number * step, step, reactions)
            states.append(np.array([self.q, self.v]))
        return np.array(states)

    def seen(self, states: np.ndarray) -> tuple[Seen, np.ndarray]:
        """What is seen of states, and their energies."""
        count = len(states)
        found = Seen(*np.empty((2, count, 3 * self.masses.size)), *np.empty((3, count)))
        q, v = np.ascontiguousarray(states.transpose(1, 0, 2))
        look(self.linkage, self.room, np.zeros(count), q, v, found)
        places = found.centres.reshape(count, -1, 3)[:, :, :2]
        height = places @ self.gravity @ self.masses
        return found, found.kinetic + found.springs - height + 0.5 * q**2 @ self.stiffness


def spun(shapes: str) -> Follower:
    """A bar that turns fast, and is bent by a hundredth of its length."""
    found = Follower(free_bar(shapes))
    frequencies = np.sqrt(found.stiffness[3:])
    found.v[:] = [1.0, 2.0, 100.0, *(0.01 * frequencies[0] * np.array([0.5, -0.3, 0.1]))]
    found.q[3:] = 0.01 * frequencies[0] / frequencies * np.array([0.5, 0.3, 0.2])
    return found


@pytest.mark.slow
@pytest.mark.parametrize("shapes", ["mean-axis", "clamped-free"])
def test_a_free_bar_keeps_energy_and_momenta(shapes):
    bar = spun(shapes)
    states = bar.run(1.5e-5, 1200)
    seen, energy = bar.seen(states)
    assert np.ptp(states[:, 0, 2]) > 1.5  # it has turned
    assert energy == approx(np.full(energy.size, energy[0]), rel=2e-9)
    x, y, _ = seen.centres.T
    along, across, spin = seen.rates.T
    inertia = 1.5 * 0.25 / 12.0
    assert seen.rates[:, :2] == approx(np.tile(seen.rates[0, :2], (len(states), 1)), rel=1e-11)
    turning = inertia * spin + 1.5 * (x * across - y * along)
    assert turning == approx(np.full(turning.size, turning[0]), rel=1e-11)


@pytest.mark.parametrize(("stages", "order", "counts"), [(RATTLE, 2.0, (160, 320)), (STAGES, 6.0, (16, 32, 64))])
def test_order(stages, order, counts):
    def end(count):
        return spun("mean-axis").run(2e-4 / count, count, stages)[-1, 0]

    exact = spun("mean-axis").run(2e-4 / 256, 256)[-1, 0]
    errors = np.array([np.abs(end(count) - exact).max() for count in counts])
    assert np.log2(errors[:-1] / errors[1:]) == approx(np.full(len(counts) - 1, order), abs=0.3)


def test_a_turning_beam_is_stiffened_as_the_centrifugal_force_pulls_it():
    """Its frequencies are those of `numerics.beams.rotating`, by 8 shapes of the beam at rest."""
    target = rotating_bar(8).target
    frames, line = frames_of(target.system.links), target.links[0].line
    lowest = np.sqrt(frames.stiffness[0, 0])
    grown = frames.swelling[0, 2:, 2:] - np.einsum("k,kij->ij", frames.radial[0, :2], frames.line[0])
    for speed in (0.5 * lowest, 2.0 * lowest):
        squares = np.linalg.eigvalsh(np.diag(frames.stiffness[0]) - speed**2 * grown)
        assert np.sqrt(squares[:3]) == approx(rotating_frequencies(line, speed, 3), rel=4e-5)


def test_a_hanging_bar_vibrates_at_its_natural_frequency():
    """On a pivot, in shapes of a clamped bar: after a period all is back, but for what is of second order."""
    bar = {"name": "bar", "from": [0.0, 0.0], "to": [0.5, 0.0], "mass": 1.5, "section": FLAT, "material": STEEL}
    target = mechanism([bar | {"modes": 6}], [{"links": ["ground", "bar"], "at": [0.0, 0.0]}])
    frequencies, motions = target.frozen.vibrations
    line = target.links[0].line
    assert frequencies[0] == approx(3.9266023**2 * line.frequency_unit, rel=1e-3)  # pinned-free; by 6 shapes
    hanging, start = Follower(target), 1e-6 * motions[:, 0]
    hanging.q += start
    period = 2.0 * np.pi / frequencies[0]
    states = hanging.run(period / 800, 800)
    assert states[-1, 0] == approx(states[0, 0], abs=1e-4 * np.abs(start).max())
    assert states[400, 0] - states[0, 0] == approx(-2.0 * start, abs=1e-4 * np.abs(start).max())


@pytest.mark.parametrize(
    "shapes",
    [
        {"modes": 3},
        {"modes": 3, "axial": 1, "shapes": "pinned-free"},
        {"modes": 3, "shapes": "mean-axis"},
        {"modes": 3, "shapes": "pinned-free", "theory": "timoshenko"},
        {"modes": 5, "nodes": [0.1, 0.2, 0.3, 0.4, 0.5]},
    ],
    ids=["clamped-free", "axial", "mean-axis", "timoshenko", "elements"],
)
def test_every_set_of_shapes_swings_as_a_pendulum(shapes):
    """A bar that falls bends by little, by some of which its frame starts at another angle."""
    bar = {"name": "bar", "from": [0.0, 0.0], "to": [0.5, 0.0], "mass": 1.5, "section": FLAT, "material": STEEL}
    pivot, weight = [{"links": ["ground", "bar"], "at": [0.0, 0.0]}], {"gravity": [0.0, -9.81]}
    linkage, rows = rigid_linkage(mechanism([bar], pivot, **weight))
    q, v = np.array([0.25, 0.0, 0.0]), np.zeros(3)
    moving_on, room = np.zeros(rows.joint.size), moving.work(rows.joint.size, 3)
    for number in range(100):
        step_on(linkage, room, STAGES, q, v, number * 2e-3, 2e-3, moving_on)
    falling = Follower(mechanism([bar | shapes], pivot, **weight))
    seen, energy = falling.seen(falling.run(1e-4, 2000))
    assert q[1] < -0.1
    assert seen.centres[-1, :2] == approx(q[:2], abs=2e-5)
    assert seen.rates[-1] == approx(v, abs=5e-4)
    assert energy == approx(np.full(energy.size, energy[0]), abs=1e-9)


def test_joints_stay_closed_and_the_energy_does_not_drift():
    falling = Follower(pendulum())
    states = falling.run(2e-4, 5_000)
    seen, energy = falling.seen(states)
    swung = np.ptp(states[:, 0, 2])
    assert swung > 1.5 and seen.gap.max() < 1e-14
    assert np.abs(energy - energy[0]).max() < 1e-11 * seen.kinetic.max()  # rounding adds up to 3e-15 a step


def test_stiff_links_move_as_rigid_ones():
    """What they differ by falls as 1 / E."""
    linkage, rows = rigid_linkage(pendulum(modes=0))
    q, v = centres(pendulum(modes=0)), rates_of_centres(pendulum(modes=0))
    reactions, room = np.zeros(rows.joint.size), moving.work(rows.joint.size, q.size)
    for number in range(100):
        step_on(linkage, room, STAGES, q, v, number * 2e-3, 2e-3, reactions)
    apart = []
    for young in (1e12, 4e12):
        stiff = Follower(pendulum(young, modes=1))
        seen, _ = stiff.seen(stiff.run(2e-4, 1000))
        apart.append(np.abs(seen.centres[-1] - q).max())
    assert apart[0] < 1e-4
    assert apart[0] / apart[1] == approx(4.0, rel=0.2)


@pytest.mark.slow
def test_fifty_periods():
    """1 000 of them end within 1.9e-9, all of it rounding."""
    swinging = Follower(pendulum(modes=1))
    states = swinging.run(1e-3, 60_000)[::50]
    seen, energy = swinging.seen(states)
    assert seen.gap.max() < 1e-14
    assert np.abs(energy - energy[0]).max() < 2e-9 * seen.kinetic.max()


def crane():
    """Flexible links with joints and springs of every kind, a slider on a flexible boom among them."""
    bar = {"section": {"width": 0.02, "height": 0.01}, "material": STEEL, "modes": 2, "axial": 1}
    links = [
        bar | {"name": "mast", "from": [0.0, 0.0], "to": [0.1, 1.0], "mass": 2.0, "shapes": "pinned-free"},
        bar | {"name": "boom", "from": [0.1, 1.0], "to": [0.9, 1.2], "mass": 1.0},
        bar | {"name": "slider", "from": [0.5, 1.1], "to": [0.5, 0.8], "mass": 0.5, "shapes": "mean-axis"},
    ]
    joints = [
        {"links": ["ground", "mast"], "at": [0.0, 0.0]},
        {"links": ["mast", "boom"], "at": [0.1, 1.0], "kind": "fixed"},
        {"links": ["boom", "slider"], "at": [0.5, 1.1], "kind": "prismatic", "axis": [0.8, 0.2]},
    ]
    springs = [{"joint": 0, "stiffness": 50.0}, {"joint": 2, "stiffness": 200.0}]
    drives = [{"joint": 2, "speed": 0.1, "initial": True}]
    return mechanism(links, joints, gravity=[1.0, -9.81], springs=springs, drives=drives)


def slopes(function, at: np.ndarray, step: float = 1e-6) -> np.ndarray:
    """Of a function by every coordinate, by differences."""
    units = step * np.eye(at.size)
    return np.array([(function(at + unit) - function(at - unit)) / (2.0 * step) for unit in units]).T


@pytest.fixture(scope="module")
def bent() -> Follower:
    """The crane, bent and moving at random."""
    found, rng = Follower(crane()), np.random.default_rng(3)
    found.q += 0.02 * rng.normal(size=found.q.size) * found.linkage.unit
    found.v = rng.normal(size=found.q.size)
    return found


def test_the_jacobian_is_the_slope_of_the_gaps(bent):
    count = bent.rows.joint.size

    def gaps(q):
        gap = np.empty(count)
        joints_at(bent.linkage, q, 0.3, gap, np.empty((count, q.size)), np.empty(count))
        return gap

    jacobian = np.empty((count, bent.q.size))
    joints_at(bent.linkage, bent.q, 0.3, np.empty(count), jacobian, np.empty(count))
    assert count == 2 + 3 + 2  # two of a pin, three where fixed, two of a slider
    assert jacobian == approx(slopes(gaps, bent.q), abs=1e-8)


def test_momenta_and_forces_are_the_slopes_of_the_lagrangian(bent):
    """So a step by them is that of the action, and symplectic."""
    size = bent.q.size

    def lagrangian(q, v):
        seen, energy = bent.seen(np.array([[q, v]]))
        return 2.0 * seen.kinetic[0] - energy[0]

    momentum, force = np.empty(size), np.empty(size)
    probe(bent.linkage, bent.room, bent.q, bent.v, momentum, force)
    assert momentum == approx(slopes(lambda v: lagrangian(bent.q, v), bent.v, 1e-4), abs=1e-7)
    assert force == approx(slopes(lambda q: lagrangian(q, bent.v), bent.q), rel=1e-6, abs=1e-5)


def test_a_crane_of_every_kind_of_joint_keeps_its_energy():
    """Its slider is let go along the boom, on a spring."""
    moves = Follower(crane())
    seen, energy = moves.seen(moves.run(2e-5, 1500))
    assert seen.gap.max() < 1e-14 and seen.springs[0] < 1e-28 and seen.springs.max() > 5e-5
    assert energy == approx(np.full(energy.size, energy[0]), abs=1e-8 * seen.kinetic.max())
