"""Thesis 8.3: a mass on the tip of a cantilever of fifteen elements, against the exact motion of that mesh.

Between touches mesh and mass move freely, while they touch a spring joins them: two linear systems whose modes are
known, and instants at which the gap closes or opens. Only what is well determined is asked for: a billionth more mass
changes the later contacts.
"""

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers.contact import Linear
from solvers.numerics.elements import newmark
from solvers.numerics.elements.banded import full
from solvers.numerics.elements.line import line
from solvers.numerics.elements.mesh import point_mesh
from solvers.numerics.law_functions import stepped
from tests.catalog import SCENES, STEEL_ROD_MASS, struck_beam

# contact stiffness over E I / l^3; first peak [N] and its instant [s]; velocity of the mass after the first contact
# [m/s]; the six first instants of parting [s]
CASES = [
    (
        1.0, 10576.5763, 1.13237882e-05, 0.842931385,
        (9.94564285e-05, 1.29618831e-04, 1.86713187e-04, 3.81277973e-04, 1.14334369e-03, 1.25054107e-03),
    ),
    (
        10.0, 23540.3335, 2.47512143e-06, 0.883077233,
        (4.95498292e-05, 5.7595012e-05, 6.91811128e-05, 8.61788299e-05, 1.13638261e-04, 1.73102658e-04),
    ),
]  # fmt: skip
BEAM = struck_beam().target


class Phase:
    """A linear system M u'' + K u = 0 from the state in which it begins."""

    def __init__(self, mass, stiffness, closing):
        from scipy.linalg import eigh

        squares, self.vectors = eigh(stiffness, mass)
        self.frequencies = np.sqrt(np.where(squares < 1e-13 * squares[-1], 0.0, squares))
        self.mass, self.closing = mass, closing

    def start(self, u, v):
        self.q, self.p = (self.vectors.T @ (self.mass @ w) for w in (u, v))

    def state(self, time):
        angle = self.frequencies * time
        over = time * np.sinc(angle / np.pi)  # sin(omega t) / omega
        q = self.q * np.cos(angle) + self.p * over
        return self.vectors @ q, self.vectors @ (self.p * np.cos(angle) - self.frequencies**2 * over * self.q)

    def overlap(self, time):
        return float(self.closing @ self.state(time)[0])


def exact_contacts(factor: float, count: int) -> list[tuple[float, float, float, float]]:
    """Instant of parting, largest force and its instant, velocity of the mass then, of the first contacts."""
    from scipy.optimize import brentq, minimize_scalar

    mesh = BEAM.mesh(15)
    whole, spring = line(point_mesh(STEEL_ROD_MASS), mesh), factor * mesh.neighbour
    mass, stiffness = full(whole.mass), full(whole.stiffness)
    closing = np.zeros(mass.shape[0])
    closing[whole.front], closing[whole.other] = 1.0, -1.0
    joined, apart = (
        Phase(mass, stiffness + spring * np.outer(closing, closing), closing),
        Phase(mass, stiffness, closing),
    )
    u, v, time, found = np.zeros(mass.shape[0]), np.eye(mass.shape[0])[whole.front], 0.0, []
    phase, step = joined, 5e-8  # shorter than any contact and any gap
    while len(found) < count:
        phase.start(u, v)
        sign, end = 1.0 if phase is joined else -1.0, step
        highest, at = 0.0, 0.0
        while (here := sign * phase.overlap(end)) > 0.0:
            highest, at = max((highest, at), (here, end))
            end += step
        end = brentq(phase.overlap, end - step, end, xtol=1e-20, rtol=1e-13)
        u, v = phase.state(end)
        if phase is joined:
            bounds = (max(at - step, 0.0), min(at + step, end))
            top = minimize_scalar(
                lambda t: -joined.overlap(t), bounds=bounds, method="bounded", options={"xatol": 1e-13}
            )
            found.append((time + end, -spring * top.fun, time + top.x, float(v[whole.front])))
        time, phase = time + end, apart if phase is joined else joined
    return found


@pytest.mark.parametrize("factor, peak, at, velocity, partings", CASES)
def test_first_contacts_of_the_exact_motion(factor, peak, at, velocity, partings):
    found = exact_contacts(factor, 6)
    assert [contact[0] for contact in found] == approx(partings, rel=1e-8)
    assert found[0][1] == approx(peak, rel=1e-8)
    assert found[0][2] == approx(at, rel=1e-6)  # a largest value is flat
    assert found[0][3] == approx(velocity, rel=1e-8)


@pytest.mark.parametrize("name, case", [("figure-8.9", CASES[0]), ("figure-8.10", CASES[1])])
def test_figures_8_9_and_8_10(name, case):
    _, peak, at, velocity, partings = case
    found = solvers.solve(SCENES[name], solvers.FeNodal(**options(SCENES[name]), estimate=False), duration=5e-3)
    course = found.motion.course
    near = slice(0, round(2.0 * at / course.step))
    assert course.force[near].max() == approx(peak, rel=1e-4)
    assert course.step * course.force[near].argmax() == approx(at, abs=course.step)
    assert [contact.end for contact in found.contacts[:6]] == approx(partings, rel=2e-4)
    first = np.array([found.contacts[0].end])
    assert found.motion.impactor_velocity(first)[0] == approx(velocity, rel=1e-5)
    assert 1.05e-3 < found.motion.end_position(found.motion.time).max() < 1.10e-3
    assert found.impactor_velocity == approx(-0.79, abs=0.05)
    assert abs(found.diagnostics["energy_error"]) < 1e-10
    assert any("each of which starts from how the one before left" in str(note) for note in found.notes)


def options(scene) -> dict:
    return {key: scene.method[key] for key in ("elements", "steps", "contact_stiffness")}


@pytest.mark.parametrize("factor, peak, at, velocity, partings", CASES)
def test_newmark_tends_to_the_exact_motion_with_the_square_of_the_step(factor, peak, at, velocity, partings):
    mesh = BEAM.mesh(15)
    whole, law = line(point_mesh(STEEL_ROD_MASS), mesh), Linear(factor * mesh.neighbour)
    errors = []
    for steps in (4000, 8000, 16000):
        step = 0.9 * partings[0] / steps
        u, v = np.zeros(whole.mass.shape[1]), np.zeros(whole.mass.shape[1])
        v[0] = 1.0
        record = newmark.record(steps, steps, u.size)
        still = whole.wholes.still()
        newmark.march_implicit(
            *stepped(law), newmark.newmark(whole, step), 0.0, step, u, v, still, steps, 0, steps, record
        )
        errors.append(record.contact_force.max() / peak - 1.0)
    assert np.abs(errors[-1]) < 1e-6
    assert errors[0] / errors[1] == approx(4.0, rel=0.2)
