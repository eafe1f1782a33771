"""Lines of equal error on a measured grid, in logarithmic coordinates."""

import numpy as np


def contour(x: np.ndarray, y: np.ndarray, values: np.ndarray, level: float) -> tuple[np.ndarray, np.ndarray]:
    """Where `values` (y, x), all positive, cross `level`: points x and y of straight pieces, NaN after each.

    Straight in the logarithms of all three; cells with a corner that is not finite have no line.
    """
    with np.errstate(divide="ignore"):
        height = np.log(values) - np.log(level)
    u, w = np.log(x), np.log(y)
    across = height[:-1, :-1], height[:-1, 1:], height[1:, 1:], height[1:, :-1]  # corners, in turn
    finite = np.all([np.isfinite(corner) for corner in across], axis=0)
    crossed = finite & (np.min(across, axis=0) < 0.0) & (np.max(across, axis=0) >= 0.0)
    pieces = []
    for i, j in np.argwhere(crossed):
        corners = [(u[j], w[i]), (u[j + 1], w[i]), (u[j + 1], w[i + 1]), (u[j], w[i + 1])]
        heights = [corner[i, j] for corner in across]
        points = []
        for k in range(4):
            a, b = heights[k], heights[(k + 1) % 4]
            if (a < 0.0) != (b < 0.0):
                share = a / (a - b)
                points.append(np.array(corners[k]) + share * np.subtract(corners[(k + 1) % 4], corners[k]))
        pieces += [points[k : k + 2] for k in range(0, len(points), 2)]
    if not pieces:
        return np.zeros(0), np.zeros(0)
    lines = np.exp(np.array(pieces))  # (pieces, 2, 2)
    ends = np.full((lines.shape[0], 1, 2), np.nan)
    x, y = np.concatenate((lines, ends), axis=1).reshape(-1, 2).T
    return x, y
