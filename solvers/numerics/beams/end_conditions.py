"""What the ends of a beam demand of a harmonic motion, as rows of a matrix over its amplitudes."""

import numpy as np

from .fields import BendingField

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


def conditions(field: BendingField, support: str, end_mass: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """What must vanish at x = 0 and x = 1, (modes, 4, amplitudes), and the sizes of the amplitudes it is given for.

    With a force among the amplitudes the displacement at its place follows as a fifth row. A mass on a free far end
    makes V = -omega^2 m y there. Amplitudes are given sizes that make motions of one size, and rows are taken over what
    such motions may give at the most, never over what they give at the ends: an amplitude that meets the conditions
    there would then count by its rounding.
    """
    points = [0.0, 1.0] if field.amplitudes.shape[1] == 4 else [0.0, 1.0, field.place]
    sizes, limits = _sizes(field)
    parts = field.basis(np.array(points), np.array([-1.0, 1.0, 1.0])[: len(points)])
    u, du, w, dw = (np.stack([part[i] for part in parts], axis=-1) * sizes[:, None, :] for i in range(4))
    gamma_a, gamma_b = field.gamma_a[:, :, None], field.gamma_b[:, :, None]
    seen = {
        DISPLACEMENT: du + dw,
        TURN: gamma_b * w - gamma_a * u,
        MOMENT: gamma_b * dw - gamma_a * du,
        SHEAR: u + w,
    }
    rows = [seen[q][:, end] / limits[q] for end in (0, 1) for q in ENDS[support][end]]
    if end_mass > 0.0:
        rows[3] = (seen[SHEAR] + end_mass * seen[DISPLACEMENT])[:, 1] / (limits[SHEAR] + end_mass)
    return np.stack(rows + [seen[DISPLACEMENT][:, end] for end in range(2, len(points))], axis=1), sizes


def _sizes(field):
    """Of the amplitudes (modes, amplitudes), and of what such motions may give of each quantity, (modes, 1) each."""
    a, b = np.sqrt(field.alpha), np.maximum(np.sqrt(np.abs(field.beta)), 1.0)
    one = np.ones_like(a)
    columns = [one, 1.0 / a, one, 1.0 / b]
    if field.amplitudes.shape[1] == 5:
        columns.append(2.0 * (field.alpha + field.beta) / (a * field.gamma_b + b * field.gamma_a))
    limits = {
        DISPLACEMENT: one,
        TURN: field.gamma_a / a + field.gamma_b / b,
        MOMENT: field.gamma_a + field.gamma_b,
        SHEAR: 1.0 / a + 1.0 / b,
    }
    return np.concatenate(columns, axis=1), limits


def null_vectors(matrices: np.ndarray) -> np.ndarray:
    """The vector that each of these matrices makes vanish."""
    return np.linalg.svd(matrices)[2][:, -1, :]
