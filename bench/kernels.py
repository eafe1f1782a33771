"""Kernels against what they cannot beat, and answers against exact ones."""

from time import perf_counter

import numpy as np

import solvers
from solvers.contact import (
    Hertz,
    HuntCrossley,
    KelvinVoigt,
    LankaraniNikravesh,
    LeeWang,
    Linear,
    PlasticLinear,
    PlasticPower,
    Power,
    YigitChristoforou,
)
from solvers.jit.kernels import kernel
from solvers.numerics.oscillators import Record, Residual, march, oscillator_bank
from solvers.numerics.waves import rigid as rigid_waves
from solvers.numerics.waves import stepped as stepped_waves

from .size import of, some
from .timing import median, paired_medians, row

STEPS = 4000
EXTREMES = ((1, 1e6, 100_000), (10, 1.0, 100_000), (100, 1e6, 10_000), (1000, 1e-6, 1000))  # modes, stiffness, steps


@kernel
def bare_rotation(cosine, sine, displacement, velocity, steps):
    """The floor: turn every oscillator, nothing else."""
    for _ in range(steps):
        for i in range(displacement.size):
            turned = cosine[i] * displacement[i] + sine[i] * velocity[i]
            velocity[i] = cosine[i] * velocity[i] - sine[i] * displacement[i]
            displacement[i] = turned


LAW_STEPS, LAW_STEP = 10_000_000, 2.0**-7
BOUNCING = {  # in units of the mass and the weight that presses it on them; the plastic ones yield many times over
    "linear": Linear(1.0),
    "hertz": Hertz(1.0),
    "power": Power(1.0, 1.3),
    "kelvin-voigt": KelvinVoigt(1.0, 1e-3),
    "lee-wang": LeeWang(1.0, 1e-3),
    "hunt-crossley": HuntCrossley(1.0, 1e-3),
    "lankarani-nikravesh": LankaraniNikravesh(1.0, 1e-3),
    "yigit-christoforou": YigitChristoforou(1.0, 0.1),
    "plastic-linear": PlasticLinear(1.0, 0.1),
    "plastic-power": PlasticPower.through(1.0, 0.1, 3.0),
}


@kernel
def bounce(law, step, steps):
    """A unit mass that bounces on a law for ever, under a weight that slowly grows and falls. `step`: a power of two.

    Returns by how much the energy ever exceeded what the weight had put in, and the largest part of it that is neither
    there nor lost by the law, both relative to all that there is.
    """
    compliance, rate, memory = 0.5 * step * step, 1.0 / step, law.unloading(0.0)
    x, v, deepest, lost, given, created, missing, force = -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(steps):
        weight = 1.0 + 0.9 * np.sin(1e-3 * k * step)
        free = x + step * v + compliance * weight
        force, end, loss, memory = law.mean_force(x, free, compliance, rate, force, deepest, memory)
        v += step * (weight - force)
        given += weight * (end - x)
        x, lost, deepest = end, lost + loss, max(deepest, end)
        energy = 0.5 * v * v + law.stored(x, deepest)
        scale = max(abs(given), 1.0)
        created = max(created, (energy - given) / scale)
        missing = max(missing, abs(energy + lost - given) / scale)
    return created, missing


def laws() -> list:
    """Energy created by each law over ten million steps, of which each may round by 1e-16, and the time of one."""
    rows = []
    steps = of(LAW_STEPS, 1_000)
    for name, law in some(BOUNCING).items():
        bounce(law, LAW_STEP, 10)
        begun = perf_counter()
        created, missing = bounce(law, LAW_STEP, steps)
        spent = 1e9 * (perf_counter() - begun) / steps
        rows.append(row(f"law {name}, 1e7 steps: energy created", max(created, 0.0), "of all put in", "<= 1e-9"))
        rows.append(row(f"law {name}, 1e7 steps: energy not accounted for", missing, "of all put in", "<= 1e-9"))
        rows.append(row(f"law {name}: per step", spent, "ns"))
    return rows


def measure() -> dict[str, object]:
    return dict(_waves() + _modal() + laws() + _accuracy())


def _waves() -> list:
    scene = solvers.load("fixed-rod")
    trip = scene.target.round_trip_time
    ball = solvers.load("bronze-rod-steel-ball")
    times = np.linspace(0.0, 3.0 * trip, 500)
    wave, total = np.empty(500), np.empty(500)

    def exact():
        sent = rigid_waves.Pieces.of(400, 40, 400)
        _, count, contacts = rigid_waves.strike(1.0, 1.0, 3.0, sent)
        *pieces, _ = sent.first(count, contacts)
        rigid_waves.sample(times / trip, True, 2.0, *pieces, wave, total)

    return [
        row(
            "waves, stepping form, 500 output times",
            1e6 * median(lambda: stepped_waves.strike(1.0, 1.0, 166, 500, True, 50), 200),
            "us",
            "<= 20",
        ),
        row("waves, event-exact kernel, 500 output times", 1e3 * median(exact, 200), "ms", "<= 1"),
        row("waves, event-exact, whole solve() with its figures", 1e3 * median(lambda: solvers.solve(scene), 50), "ms"),
        row("waves with Hertz contact, whole solve()", 1e3 * median(lambda: solvers.solve(ball), 50), "ms"),
    ]


def _modal() -> list:
    rows = []
    scene = solvers.load("fixed-rod")
    rod = scene.target
    for modes in some((50, 100, 200, 400, 1000)):
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
                march(
                    law,
                    Residual(residual),
                    mass,
                    known.rigid_mass,
                    0.0,
                    0.0,
                    step,
                    bank,
                    *rest,
                    STEPS + 1,
                    0,
                    STEPS,
                    record,
                )

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
    for modes in some((20, 50, 100, 400)):
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
    for modes, stiffness, steps in some(EXTREMES):
        changes = {"contact": {"law": "linear", "stiffness": stiffness * scene.target.stiffness}}
        found = solvers.solve(scene.replace(changes), "modal", modes=modes, steps=steps)
        worst = max(worst, abs(found.diagnostics["energy_error"]))
    rows.append(row("worst energy error of the modal kernel at the extremes", worst, "", "<= 1e-11"))
    return rows
