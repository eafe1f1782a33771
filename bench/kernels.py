"""Kernels against what they cannot beat, and answers against exact ones."""

import numpy as np

import solvers
from solvers.contact import Hertz, Linear
from solvers.jit import kernel
from solvers.numerics import contact_waves, rigid_waves, stepped_waves
from solvers.numerics.oscillators import Record, Residual, march, oscillator_bank

from .timing import median, paired_medians, row

STEPS = 4000


@kernel
def bare_rotation(cosine, sine, displacement, velocity, steps):
    """The floor: turn every oscillator, nothing else."""
    for _ in range(steps):
        for i in range(displacement.size):
            turned = cosine[i] * displacement[i] + sine[i] * velocity[i]
            velocity[i] = cosine[i] * velocity[i] - sine[i] * displacement[i]
            displacement[i] = turned


def measure() -> dict[str, object]:
    return dict(_waves() + _modal() + _accuracy())


def _waves() -> list:
    scene = solvers.load("fixed-rod")
    trip = scene.target.round_trip_time
    ball = solvers.load("bronze-rod-steel-ball")
    unit = ball.target.impedance * ball.impactor.velocity
    law = ball.contact.scaled(ball.impactor.velocity * ball.target.round_trip_time, ball.impactor.velocity, unit)
    times = np.linspace(0.0, 3.0 * trip, 500)
    wave, total = np.empty(500), np.empty(500)

    def exact():
        found = rigid_waves.strike(1.0, 1.0, 3.0, 400, 40, 400)
        rigid_waves.sample(times / trip, True, 2.0, *found[2:6], wave, total)

    return [
        row(
            "waves, stepping form, 500 output times",
            1e6 * median(lambda: stepped_waves.strike(1.0, 1.0, 166, 500, True, 50), 200),
            "us",
            "<= 20",
        ),
        row("waves, event-exact kernel, 500 output times", 1e3 * median(exact, 200), "ms", "<= 1"),
        row("waves, event-exact, whole solve() with its figures", 1e3 * median(lambda: solvers.solve(scene), 50), "ms"),
        row(
            "waves with Hertz contact, kernel, tolerance 1e-9",
            1e3 * median(lambda: contact_waves.strike(law, ball.mass_ratio, -1.0, 2.0, 1e-9, 4000, 50), 50),
            "ms",
        ),
    ]


def _modal() -> list:
    rows = []
    scene = solvers.load("fixed-rod")
    rod = scene.target
    for modes in (50, 100, 200, 400, 1000):
        known = rod.modes(modes)
        step = 3.0 * rod.round_trip_time / STEPS
        bank = oscillator_bank(known.frequencies, known.at_contact, step)
        start = np.random.default_rng(1).standard_normal((2, modes))
        cells = STEPS * modes * 1e-9

        def bare(bank=bank, start=start):
            bare_rotation(bank.cosine, bank.sine, start[0].copy(), start[1].copy(), STEPS)

        spring = Linear(1.0 / known.residual_compliance)
        for name, law, residual in (("rigid", spring, 0.0), ("hertz", Hertz(1e12), known.residual_compliance)):
            instants = [np.zeros(STEPS + 1) for _ in range(7)]
            record = Record(np.zeros(STEPS), *instants, np.zeros((1, modes)), np.zeros((1, modes)))

            def run(law=law, residual=residual, record=record, bank=bank, modes=modes, known=known, step=step):
                record.velocity[0] = 1.0
                rest = np.zeros(modes), np.zeros(modes)
                mass = scene.impactor.mass
                march(law, Residual(residual), mass, known.rigid_mass, step, bank, *rest, STEPS + 1, 0, STEPS, record)

            floor, spent, ratio = paired_medians(bare, run, 61)
            what = f"modal kernel, {modes} modes, {name}"
            rows.append(row(f"{what}: per mode-step", spent / cells, "ns", "<= 0.6"))
            rows.append(row(f"{what}: the bare rotation beside it", floor / cells, "ns", "the floor"))
            rows.append(row(f"{what}: times the floor", ratio, "x", "<= 1.5" if name == "rigid" else ""))
    return rows


def _accuracy() -> list:
    rows = []
    scene = solvers.load("fixed-rod")
    exact = solvers.solve(scene)
    for modes in (20, 50, 100, 400):
        found = solvers.solve(scene, "modal", modes=modes)
        error = abs(found.impactor_velocity / exact.impactor_velocity - 1.0)
        rows.append(row(f"rebound error, {modes} modes, rigid, fixed rod", 100 * error, "%"))
        trip = scene.target.round_trip_time
        times = np.linspace(0.0, 2.5 * trip, 20_001)
        true = exact.motion.force(times)
        for name, force in (("raw", found.motion.force(times)), ("resolved", found.motion.resolved_force(times))):
            miss = np.sqrt(np.sum((force - true) ** 2) / np.sum(true**2))
            rows.append(row(f"force error (L2), {modes} modes, {name}", 100 * miss, "%"))
    worst = 0.0
    for modes, stiffness, steps in ((1, 1e6, 100_000), (10, 1.0, 100_000), (100, 1e6, 10_000), (1000, 1e-6, 1000)):
        changes = {"contact": {"law": "linear", "stiffness": stiffness * scene.target.stiffness}}
        found = solvers.solve(scene.replace(changes), "modal", modes=modes, steps=steps)
        worst = max(worst, abs(found.diagnostics["energy_error"]))
    rows.append(row("worst energy error of the modal kernel at the extremes", worst, "", "<= 1e-11"))
    return rows
