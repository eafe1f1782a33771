"""What the ends of a beam demand of a harmonic motion, as rows of a matrix over its amplitudes."""

import numpy as np

from .bending_fields import BendingField

# What vanishes at either end of a beam, of displacement, turn, moment and shear force, by the name of its support
DISPLACEMENT, TURN, MOMENT, SHEAR = range(4)
CLAMPED, PINNED, FREE = (DISPLACEMENT, TURN), (DISPLACEMENT, MOMENT), (MOMENT, SHEAR)
ENDS = {
    "cantilever": (CLAMPED, FREE),
    "pinned-pinned": (PINNED, PINNED),
    "clamped-clamped": (CLAMPED, CLAMPED),
    "free-free": (FREE, FREE),
    "pinned-free": (PINNED, FREE),
}


def column_sizes(field: BendingField) -> np.ndarray:
    """Amplitudes that make motions of like size, (modes, amplitudes).

    By what each may give at the most, never by what it gives at the ends: an amplitude that meets the conditions there
    would then count by its rounding.
    """
    a, b = _wavenumbers(field)
    columns = [np.ones_like(a), 1.0 / a, np.ones_like(a), 1.0 / b]
    if field.amplitudes.shape[1] == 5:
        columns.append(2.0 * (a**2 + field.beta[:, 0]) / (a * field.gamma_b[:, 0] + b * field.gamma_a[:, 0]))
    return np.stack(columns, axis=1)


def _wavenumbers(field):
    return np.sqrt(field.alpha[:, 0]), np.maximum(np.sqrt(np.abs(field.beta[:, 0])), 1.0)


def _row_sizes(field, quantities):
    """What motions of that size may give of each quantity, (modes, quantities, 1)."""
    (a, b), gamma_a, gamma_b = _wavenumbers(field), field.gamma_a[:, 0], field.gamma_b[:, 0]
    sizes = {
        DISPLACEMENT: np.ones_like(a),
        TURN: gamma_a / a + gamma_b / b,
        MOMENT: gamma_a + gamma_b,
        SHEAR: 1.0 / a + 1.0 / b,
    }
    return np.stack([sizes[q] for q in quantities], axis=1)[:, :, None]


def raw_rows(field: BendingField, x: float, quantities: tuple[int, ...], side: float | None = None) -> np.ndarray:
    """What each amplitude of `column_sizes` gives of these at x: (modes, quantities, amplitudes); shear / square."""
    parts = field.basis(np.array([x]), side)
    seen = {
        DISPLACEMENT: field.displacement,
        TURN: field.turn,
        MOMENT: field.moment,
        SHEAR: lambda at: at.u + at.w,
    }
    found = np.stack([np.stack([seen[q](part)[:, 0] for part in parts], axis=-1) for q in quantities], axis=1)
    return found * column_sizes(field)[:, None, :]


def end_rows(field: BendingField, near: bool, support: str, end_mass: float = 0.0) -> np.ndarray:
    """What vanishes at x = 0 (`near`) or x = 1, over its size: (modes, 2, amplitudes).

    A mass on a free far end makes V = -omega^2 m y there.
    """
    quantities = ENDS[support][0 if near else 1]
    found = raw_rows(field, 0.0 if near else 1.0, quantities, -1.0 if near else 1.0)
    sizes = _row_sizes(field, quantities)
    if end_mass > 0.0 and not near:
        found[:, 1:] += end_mass * raw_rows(field, 1.0, (DISPLACEMENT,))
        sizes[:, 1] += end_mass
    return found / sizes


def null_vectors(matrices: np.ndarray) -> np.ndarray:
    """The vector that each of these matrices makes vanish."""
    return np.linalg.svd(matrices)[2][:, -1, :]
