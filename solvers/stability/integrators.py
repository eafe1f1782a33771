"""Step-by-step integrators of two bodies in modal coordinates and a contact law: made to be compared, each as usual.

Every body's motion as a whole is one more oscillator, of frequency zero, so that the bodies are y'' + s y = g F, one
row for each, s = omega^2 and g = at_contact^2; the indentation is -sum(y), the impactor's row being minus its position.
Each integrator advances a `State` by one step and returns the force and the indentation at its end. `run` follows
one until the bodies part; `run_exact` does the same with the kernel of `modal`.
"""

from typing import NamedTuple

import numpy as np

from ..jit.kernels import allocating_kernel, inner_kernel, kernel, summing_kernel
from ..numerics.law_functions import centred
from ..numerics.oscillators import Record, march

ENDED, BOUND, LASTING, DIVERGED = 0, 1, 2, 3
GROWN = 1.0  # times the energy of the start, gained: the motion grows without reason
CHECKS = 50  # of the energy, over the longest time


class Rows(NamedTuple):
    """Two bodies, (rows,) each; the impactor's motion as a whole is the first."""

    squares: np.ndarray  # s = omega^2 [1/s2]
    mobility: np.ndarray  # g = at_contact^2 [1/kg]


class State(NamedTuple):
    y: np.ndarray  # (rows,) [m]
    v: np.ndarray  # (rows,) [m/s]
    kept: np.ndarray  # deepest indentation so far [m]; force that acts at the instant [N]; lost to impulses [J]
    spare: np.ndarray  # (3, rows), for intermediate stages


class Limits(NamedTuple):
    """How long to follow a run, in steps; `opening` [m]: faces open by less may still be touching."""

    quiet: int  # without a touch, after which bodies that move apart have parted
    most: int
    opening: float


class Outcome(NamedTuple):
    ending: int  # ENDED; BOUND or LASTING: still touching at the end, set by the caller; DIVERGED
    steps: int
    energy_error: float  # the largest, relative to the energy of the start; signed
    velocity: float  # of the impactor [m/s]
    touches: int  # stretches of raw force
    contacts: int  # the same, those run together between which the faces opened by less than `opening`


def rows(frequencies: np.ndarray, at_contact: np.ndarray, mass: float, rigid_mass: float) -> Rows:
    """Of oscillators and the masses [kg] that move as a whole, or infinity."""
    whole = np.array([1.0 / mass, 1.0 / rigid_mass])
    return Rows(np.concatenate(([0.0, 0.0], frequencies**2)), np.concatenate((whole, at_contact**2)))


def highest_frequency(bodies: Rows, contact_stiffness: float) -> float:
    """Of the bodies with the contact spring [N/m] between them [rad/s], by bisection of the secular equation."""
    top = float(bodies.squares.max())
    low, high = top, top + contact_stiffness * float(bodies.mobility.sum())
    for _ in range(200):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        if contact_stiffness * float(np.sum(bodies.mobility / (middle - bodies.squares))) > 1.0:
            low = middle
        else:
            high = middle
    return float(np.sqrt(high))


# --- integrators ------------------------------------------------------------------------------------------------------


class CentralDifference(NamedTuple):
    """u at the instants, the rate carried there: velocity Verlet. Stable below 2 / (highest frequency), contact spring
    included."""

    step: float
    bodies: Rows
    lossy: bool

    def advance(self, law, state):
        return _central_difference(law, self.step, self.bodies, self.lossy, state)


class RungeKutta(NamedTuple):
    """The classical rule of fourth order. Stable below 2 sqrt(2) / (highest frequency), contact spring included."""

    step: float
    bodies: Rows

    def advance(self, law, state):
        return _runge_kutta(law, self.step, self.bodies, state)


class Trapezoid(NamedTuple):
    """A step of constant mean acceleration, y1 = carry y + drift v + give F, for the mean force of the step."""

    step: float
    carry: np.ndarray
    drift: np.ndarray
    give: np.ndarray  # [m/N]


def trapezoid(bodies: Rows, step: float) -> Trapezoid:
    """Newmark's rule with delta = 1/2, alpha = 1/4."""
    quarter = 0.25 * step**2 * bodies.squares
    return Trapezoid(
        step, (1.0 - quarter) / (1.0 + quarter), step / (1.0 + quarter), 0.5 * step**2 * bodies.mobility / (1 + quarter)
    )


class FrozenNewmark(NamedTuple):
    """Newmark's step with the contact as a spring of its secant stiffness, if it presses when the step begins.

    Feeds the motion where the faces part or meet within a step. Source: thesis 8.2.
    """

    rule: Trapezoid

    def advance(self, law, state):
        return _frozen(law, self.rule, state)


class MoreauJean(NamedTuple):
    """Impulses on a contact that is rigid: the rate of closing is at most -restitution times what it was before.

    Source: Moreau (1988), Jean (1999), with theta = 1/2. Knows no stiffness; a touch with restitution below 1 loses
    energy, the more of it the fewer the modes.
    """

    rule: Trapezoid
    restitution: float
    lossy: bool  # whether what the impulses take is meant to be lost

    def advance(self, law, state):
        return _moreau_jean(self.restitution, self.lossy, self.rule, state)


@summing_kernel
def _central_difference(law, step, bodies, lossy, state):
    y, v, memory = state.y, state.v, state.kept
    half, force = 0.5 * step, memory[1]
    indentation, rate, mobility = 0.0, 0.0, 0.0
    for i in range(y.size):
        halfway = v[i] + half * (bodies.mobility[i] * force - bodies.squares[i] * y[i])
        y[i] += step * halfway
        v[i] = halfway - half * bodies.squares[i] * y[i]
        indentation -= y[i]
        rate -= v[i]
        mobility += bodies.mobility[i]
    force = centred(law, indentation, rate, half * mobility if lossy else 0.0, memory[0])
    for i in range(y.size):
        v[i] += half * bodies.mobility[i] * force
    memory[0], memory[1] = max(memory[0], indentation), force
    return force, indentation


@summing_kernel
def _runge_kutta(law, step, bodies, state):
    y, v, memory = state.y, state.v, state.kept
    squares, mobility = bodies.squares, bodies.mobility
    second, third, fourth = state.spare[0], state.spare[1], state.spare[2]  # velocities of the stages
    half, force, deepest = 0.5 * step, memory[1], memory[0]
    depth, rate = 0.0, 0.0
    for i in range(y.size):
        second[i] = v[i] + half * (mobility[i] * force - squares[i] * y[i])
        depth -= y[i] + half * v[i]
        rate -= second[i]
    force = law.force(depth, rate, deepest)
    depth, rate = 0.0, 0.0
    for i in range(y.size):
        third[i] = v[i] + half * (mobility[i] * force - squares[i] * (y[i] + half * v[i]))
        depth -= y[i] + half * second[i]
        rate -= third[i]
    force = law.force(depth, rate, deepest)
    depth, rate = 0.0, 0.0
    for i in range(y.size):
        fourth[i] = v[i] + step * (mobility[i] * force - squares[i] * (y[i] + half * second[i]))
        depth -= y[i] + step * third[i]
        rate -= fourth[i]
    force = law.force(depth, rate, deepest)
    depth, rate = 0.0, 0.0
    for i in range(y.size):
        was, last = v[i], mobility[i] * force - squares[i] * (y[i] + step * third[i])
        y[i] += step / 6.0 * (was + 2.0 * second[i] + 2.0 * third[i] + fourth[i])
        v[i] += ((second[i] - was) + 2.0 * (third[i] - was) + (fourth[i] - was) + half * last) / 3.0
        depth -= y[i]
        rate -= v[i]
    memory[1] = law.force(depth, rate, deepest)
    memory[0] = max(deepest, depth)
    return memory[1], depth


@summing_kernel
def _frozen(law, rule, state):
    y, v, memory = state.y, state.v, state.kept
    depth, rate, free, compliance = 0.0, 0.0, 0.0, 0.0
    for i in range(y.size):
        depth -= y[i]
        rate -= v[i]
        free -= rule.carry[i] * y[i] + rule.drift[i] * v[i]
        compliance += rule.give[i]
    pressed, before = law.force(depth, rate, memory[0]), memory[1]
    stiffness = pressed / depth if pressed > 0.0 else 0.0
    depth = (free - 0.5 * compliance * before) / (1.0 + 0.5 * compliance * stiffness)
    memory[1] = stiffness * depth  # a spring that pulls, too, until the step is over
    mean = 0.5 * (before + memory[1])
    rate = _move(rule, mean, y, v)
    force = law.force(depth, rate, memory[0])
    memory[0] = max(memory[0], depth)
    return force, depth


@summing_kernel
def _move(rule, mean, y, v):
    """A step under this mean force, in place; the rate at its end."""
    rate, double = 0.0, 2.0 / rule.step
    for i in range(y.size):
        now = rule.carry[i] * y[i] + rule.drift[i] * v[i] + rule.give[i] * mean
        v[i] = double * (now - y[i]) - v[i]
        y[i] = now
        rate -= v[i]
    return rate


@summing_kernel
def _moreau_jean(restitution, lossy, rule, state):
    y, v = state.y, state.v
    depth, rate, end, compliance = 0.0, 0.0, 0.0, 0.0
    for i in range(y.size):
        depth -= y[i]
        rate -= v[i]
        end -= rule.carry[i] * y[i] + rule.drift[i] * v[i]
        compliance += rule.give[i]
    double = 2.0 / rule.step
    force, free = 0.0, double * (end - depth) - rate
    if depth + 0.5 * rule.step * rate >= 0.0:
        force = max(0.0, (free + restitution * rate) / (double * compliance))
    _move(rule, force, y, v)
    before, depth = depth, 0.0
    for i in range(y.size):
        depth -= y[i]
    if lossy:
        state.kept[2] += force * (depth - before)
    return force, depth


# --- runs -------------------------------------------------------------------------------------------------------------


@summing_kernel
def _energy(bodies, y, v):
    total = 0.0
    for i in range(y.size):
        if bodies.mobility[i] > 0.0:
            total += 0.5 * (v[i] * v[i] + bodies.squares[i] * y[i] * y[i]) / bodies.mobility[i]
    return total


@kernel
def _count(force, indentation, limits, tally):
    """Touches and contacts at one instant; tally: touches, contacts, widest gap since the last touch, quiet steps."""
    if force > 0.0:
        if tally[3] > 0:
            tally[0] += 1
            if tally[2] > limits.opening:
                tally[1] += 1
        tally[2], tally[3] = 0.0, 0
    else:
        tally[2], tally[3] = max(tally[2], -indentation), tally[3] + 1


@inner_kernel
def _out_of_reach(bodies, state):
    """Whether the bodies move apart, too far from each other for any bulge of theirs to close the gap."""
    if state.v[1] + state.v[0] <= 0.0:
        return False
    gap = state.y[1] + state.y[0]
    for i in range(2, state.y.size):
        gap -= np.hypot(state.y[i], state.v[i] / np.sqrt(bodies.squares[i]))
    return gap > 0.0


@allocating_kernel
def run(integrator, law, rigid, bodies, step, speed, limits):
    """Follow an integrator from first touch until the bodies part, their motion is past reason, or `limits.most` steps.

    The energy that the law holds or has taken is that of the path that the indentation took; where the contact is
    `rigid` it is what the restitution takes.
    """
    count = bodies.squares.size
    state = State(np.zeros(count), np.zeros(count), np.zeros(3), np.zeros((3, count)))
    state.v[0] = -speed
    initial = 0.5 * speed * speed / bodies.mobility[0]
    every = max(1, limits.most // CHECKS)
    tally = np.array([0.0, 0.0, np.inf, 1.0])
    worst, indentation, work, ending, done = 0.0, 0.0, 0.0, BOUND, limits.most
    for k in range(limits.most):
        deepest, was = state.kept[0], indentation
        force, indentation = integrator.advance(law, state)
        if not rigid:
            work += law.mean(was, indentation, 1.0 / step, deepest)[0] * (indentation - was)
        _count(force, indentation, limits, tally)
        over = tally[3] >= limits.quiet and state.v[1] + state.v[0] > 0.0
        if over or (k + 1) % every == 0 or k + 1 == limits.most:
            over = over or _out_of_reach(bodies, state)
            error = (_energy(bodies, state.y, state.v) + work + state.kept[2]) / initial - 1.0
            if not abs(error) <= abs(worst):
                worst = error
            if over or not abs(worst) < GROWN:
                ending, done = ENDED if abs(worst) < GROWN else DIVERGED, k + 1
                break
    return Outcome(ending, done, worst, -state.v[0], int(tally[0]), int(tally[1]))


@allocating_kernel
def run_exact(law, residual, mass, rigid_mass, step, bank, speed, limits):
    """The same with the kernel of `modal`, whose step is exact for every oscillator; or, if the bank turns them so,
    trapezoidal."""
    modes, chunk = bank.energy.size, max(1, min(limits.quiet, limits.most // CHECKS))
    rows = limits.most // chunk + 1
    r = Record(
        np.empty(limits.most), np.empty(limits.most + 1), np.empty(limits.most + 1), np.empty(limits.most + 1),
        np.empty(limits.most + 1), np.empty(limits.most + 1), np.empty(limits.most + 1), np.empty(limits.most + 1),
        np.empty((rows, modes)), np.empty((rows, modes)),
    )  # fmt: skip
    for values in (r.indentation, r.position, r.velocity, r.rigid_position, r.rigid_velocity, r.spring_force, r.lost):
        values[0] = 0.0
    r.velocity[0] = speed
    displacement, velocity = np.zeros(modes), np.zeros(modes)
    initial = 0.5 * mass * speed * speed
    tally = np.array([0.0, 0.0, np.inf, 1.0])
    worst, deepest, ending, done = 0.0, 0.0, BOUND, 0
    while done < limits.most and ending == BOUND:
        until = min(done + chunk, limits.most)
        march(law, residual, mass, rigid_mass, 0.0, 0.0, step, bank, displacement, velocity, chunk, done, until, r)
        for k in range(done, until):
            _count(r.contact_force[k], r.indentation[k + 1], limits, tally)
            deepest = max(deepest, r.indentation[k + 1])
        done = until
        error = _exact_energy(law, residual, mass, rigid_mass, bank, displacement, velocity, r, done, deepest)
        error = error / initial - 1.0
        if not abs(error) <= abs(worst):
            worst = error
        if not abs(worst) < GROWN:
            ending = DIVERGED
        elif r.rigid_velocity[done] > r.velocity[done]:
            bulge = np.hypot(displacement, velocity).sum() + residual.compliance * abs(r.spring_force[done])
            if tally[3] >= limits.quiet or r.rigid_position[done] - r.position[done] > bulge:
                ending = ENDED
    return Outcome(ending, done, worst, r.velocity[done], int(tally[0]), int(tally[1]))


@inner_kernel
def _exact_energy(law, residual, mass, rigid_mass, bank, displacement, velocity, r, k, deepest):
    total = 0.5 * mass * r.velocity[k] ** 2 + law.stored(r.indentation[k], deepest) + r.lost[k]
    total += 0.5 * residual.compliance * r.spring_force[k] ** 2
    if np.isfinite(rigid_mass):
        total += 0.5 * rigid_mass * r.rigid_velocity[k] ** 2
    for i in range(bank.energy.size):
        total += bank.energy[i] * (displacement[i] ** 2 + velocity[i] ** 2)
    return total
