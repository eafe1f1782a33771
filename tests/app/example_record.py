"""How the example of a record was made: `python -m tests.app.example_record` writes it again.

It comes with the library, and once more with the page, which browsers fetch file by file.
"""

import numpy as np

import solvers
from app.page.lab import STATIC
from solvers import records
from solvers.records import expected

FILES = records.example(), STATIC / "example-record.csv"
FILE = FILES[0]
PLACE = 1.0  # [m] of the gauge
LATE = 37e-6  # [s]: what the clock of the record shows at first touch
FIRST, ROWS, STEP = -100, 1_600, 1e-6
NOISE, RANGE, BITS = 0.003, 2.4, 12  # noise and range of the converter, in greatest strains
SEED = 7


def example() -> np.ndarray:
    """(rows, 2): time [us] and strain [um/m], as the file gives them."""
    solution = solvers.solve(solvers.load("bronze-rod-steel-ball"), duration=2e-3)
    time = (FIRST + np.arange(ROWS)) * STEP
    strain = expected(solution, "strain", time, PLACE)
    greatest = np.abs(strain).max()
    bit = RANGE * greatest / 2**BITS
    noisy = strain + np.random.default_rng(SEED).normal(0.0, NOISE * greatest, ROWS)
    return np.column_stack((1e6 * (time + LATE), 1e6 * bit * np.round(noisy / bit)))


def text() -> str:
    lines = [
        "# Synthetic, not measured: computed by strikewave, scene bronze-rod-steel-ball, strain 1.0 m from the struck",
        f"# end; 1 us steps, {BITS} bits, noise of {100 * NOISE:g} % of the greatest strain, first touch at 37 us.",
        "time_us,microstrain",
    ]
    return "\n".join([*lines, *(f"{t:.0f},{strain:.4f}" for t, strain in example())]) + "\n"


if __name__ == "__main__":
    for file in FILES:
        file.write_text(text(), encoding="utf-8")
