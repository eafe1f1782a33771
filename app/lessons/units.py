"""Units that an answer may be in, by what they measure: factors to SI."""

import math

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


def alike(unit: str) -> dict[str, float]:
    """Units of the same quantity; none for a word that is no unit."""
    return next((units for units in UNITS if unit in units), {})
