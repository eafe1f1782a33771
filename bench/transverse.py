"""Beams struck across: the kernel against its floor, answers against finer ones, energy at the extremes."""

import numpy as np

import solvers
from solvers import Modal
from solvers.numerics.oscillators import Record, Residual, march, oscillator_bank

from .kernels import bare_rotation
from .size import of, some
from .timing import median, paired_medians, row

MODES, STEPS = 40, 20_000
FIRM = ("figure-8.13", "figure-8.21", "figure-8.24")  # well conditioned: plastic contact


def measure() -> dict[str, object]:
    return dict(_kernel() + _accuracy() + _energy())


def _kernel() -> list:
    """The whole impact of thesis 8.4, several contacts and flights between them, in one march."""
    rows = []
    for law in some(("plastic-linear", "plastic-power", "hertz")):
        scene = solvers.load("figure-8.21").replace({"contact.law": law})
        known = scene.target.modes(MODES).excited()
        step = 5e-3 / STEPS
        bank = oscillator_bank(known.frequencies, known.at_contact, step)
        start = np.random.default_rng(1).standard_normal((2, MODES))
        record = Record(
            np.zeros(STEPS), *(np.zeros(STEPS + 1) for _ in range(7)), np.zeros((1, MODES)), np.zeros((1, MODES))
        )
        residual = Residual(known.residual_compliance, 0.5 * step / known.shortest_period)

        def bare(bank=bank, start=start):
            bare_rotation(bank.cosine, bank.sine, start[0].copy(), start[1].copy(), STEPS)

        def run(scene=scene, residual=residual, record=record, bank=bank, step=step):
            record.velocity[0] = 1.0
            rest = np.zeros(MODES), np.zeros(MODES)
            march(scene.contact, residual, 2.133, np.inf, 0.0, 0.0, step, bank, *rest, STEPS + 1, 0, STEPS, record)

        _, spent, ratio = paired_medians(bare, run, 61)
        what = f"beam, {MODES} modes, {STEPS} steps, {law}"
        rows.append(row(f"{what}: a march", 1e3 * spent, "ms"))
        rows.append(row(f"{what}: times the bare rotation", ratio, "x", "<= 2.5" if "plastic" in law else ""))
    return rows


def _accuracy() -> list:
    rows = []
    for name in some(FIRM):
        scene = solvers.load(name)
        fine = solvers.solve(scene, steps=of(400_000, STEPS), duration=6e-3)
        usual = solvers.solve(scene)
        rows.append(
            row(
                f"{name}: final velocity, usual steps against 400 000",
                abs(usual.impactor_velocity - fine.impactor_velocity),
                "m/s",
                "<= 1e-6",
            )
        )
        more = scene.replace({"method.residual": True})
        finest, forty = (
            Modal(modes=modes, steps=of(200_000, STEPS), estimate=False).solve(more, 6e-3).impactor_velocity
            for modes in (160, 40)
        )
        rows.append(row(f"{name}: final velocity, 40 modes against 160", abs(forty - finest), "m/s"))
        rows.append(row(f"{name}: whole solve()", 1e3 * median(lambda scene=scene: solvers.solve(scene), 15), "ms"))
    pendulum = solvers.load("figure-9.11")
    spent = 1e3 * median(lambda: solvers.solve(pendulum).table(), 15)
    rows.append(row("pendulum on rod, 5 + 30 coordinates: whole solve() with its table", spent, "ms", "<= 20"))
    return rows


def _energy() -> list:
    worst = 0.0
    scene = solvers.load("figure-8.21").replace({"method.residual": True})
    for law in some(("plastic-power", "plastic-linear", "hertz", "linear")):
        for stiffness in some((1e-6, 1.0, 1e6)):
            table = {"law": law, "stiffness": (1e9 if law == "linear" else 2.4e10) * stiffness}
            if "plastic" in law:
                table["yield_indentation"] = 1e-6
            for modes in some((1, 10, 100, 500)):
                found = Modal(modes=modes, steps=2_000, estimate=False).solve(scene.replace({"contact": table}), 6e-3)
                worst = max(worst, abs(found.diagnostics["energy_error"]))
    return [row("worst energy error, stiffness x 1e-6 to 1e6, 1 to 500 modes", worst, "", "<= 1e-10")]
