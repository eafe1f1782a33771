"""Natural modes of beams: how exact, and what they cost."""

from functools import partial

import numpy as np

from solvers.numerics.beams.modes import attached_beam_modes, beam_modes
from tests.solvers.numerics.beams.beam_frequencies import TIMOSHENKO
from tests.solvers.numerics.beams.test_modes import CASES, LENGTH, LINES, SLENDER, THICK, characteristic, products

from .size import some
from .timing import median, row

COUNTS = {40: {"Euler-Bernoulli": "<= 2", "Timoshenko": "<= 5"}, 200: {}, 500: {}}


def slender_error(support: str, end_mass: float) -> float:
    """Largest relative distance of 200 frequencies from the roots of the text-book equation, in long doubles."""
    modes = beam_modes(SLENDER, support, LENGTH, 200, end_mass)
    z = np.sqrt(modes.frequencies.astype(np.longdouble) / SLENDER.frequency_unit)
    step = z * np.longdouble(1e-9)
    before, at, after = (characteristic(support, z + way * step, end_mass / SLENDER.mass) for way in (-1, 0, 1))
    return float(np.abs(2.0 * at / (after - before) * 2.0 * step / z).max())


def thick_error(case: str, known: tuple[float, ...]) -> float:
    support, end_mass = ("cantilever", THICK.mass) if "own mass" in case else (case, 0.0)
    found = beam_modes(THICK, support, LENGTH, len(known), end_mass).frequencies / THICK.frequency_unit
    return float(np.abs(found / np.array(known) - 1.0).max())


def measure() -> dict[str, object]:
    rows = [
        row(
            "200 Euler-Bernoulli frequencies, every support: worst",
            max(slender_error(*case) for case in some(CASES)),
            "",
            "<= 1e-12",
        ),
        row(
            "20 Timoshenko frequencies, every support: worst",
            max(thick_error(*case) for case in some(TIMOSHENKO).items()),
            "",
            "<= 1e-9",
        ),
    ]
    for theory, line in LINES.items():
        mass, stiffness, _ = products(line, beam_modes(line, "cantilever", LENGTH, 100), 0.0)
        worst = max(float(np.abs(product - np.eye(100)).max()) for product in (mass, stiffness))
        rows.append(row(f"100 {theory} modes: worst product of two", worst, ""))
        for count, targets in some(COUNTS).items():
            spent = 1e3 * max(median(partial(beam_modes, line, support, 0.2, count)) for support, _ in some(CASES))
            rows.append(row(f"{count} {theory} modes, slowest support", spent, "ms", targets.get(theory, "")))
        spent = 1e3 * median(partial(attached_beam_modes, line, "clamped-clamped", 0.1, 40, 1.0))
        rows.append(row(f"40 {theory} modes with a mass that rides on the beam", spent, "ms"))
    return dict(rows)
