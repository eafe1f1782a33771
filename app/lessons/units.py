"""Units that an answer may be in, by what they measure: factors to SI."""

import math

Dimension = tuple[int, int, int]  # powers of m, kg and s
NONE: Dimension = (0, 0, 0)

UNITS: tuple[dict[str, float], ...] = (
    {"s": 1.0, "ms": 1e-3, "µs": 1e-6},
    {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "µm": 1e-6},
    {"m/s": 1.0, "mm/s": 1e-3, "km/s": 1e3, "km/h": 1 / 3.6},
    {"N": 1.0, "kN": 1e3, "MN": 1e6},
    {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
    {"kg": 1.0, "g": 1e-3},
    {"N s": 1.0, "kg m/s": 1.0, "mN s": 1e-3},
    {"J": 1.0, "mJ": 1e-3, "kJ": 1e3},
    {"1": 1.0, "%": 1e-2},
    {"T": 1.0},
    {"rad/s": 1.0, "Hz": 2.0 * math.pi, "rpm": math.pi / 30.0},
    {"rad": 1.0, "°": math.pi / 180.0},
    {"N m": 1.0, "kN m": 1e3},
    {"N/m": 1.0, "kN/m": 1e3, "MN/m": 1e6},
)
TIME_UNIT = "T"  # that of a scene
DIMENSIONS: dict[str, Dimension] = {  # by the first unit of each
    **{"s": (0, 0, 1), "m": (1, 0, 0), "m/s": (1, 0, -1), "N": (1, 1, -2), "Pa": (-1, 1, -2), "kg": (0, 1, 0)},
    **{"N s": (1, 1, -1), "J": (2, 1, -2), "1": NONE, TIME_UNIT: (0, 0, 1), "rad/s": (0, 0, -1), "rad": NONE},
    **{"N m": (2, 1, -2), "N/m": (0, 1, -2)},
}


def alike(unit: str) -> dict[str, float]:
    """Units of the same quantity; none for a word that is no unit."""
    return next((units for units in UNITS if unit in units), {})


def dimension_of(unit: str) -> Dimension:
    return DIMENSIONS[next(iter(alike(unit)), "1")]
