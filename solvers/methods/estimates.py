"""The error that is left in a figure, from how it differs at other resolutions."""

import math
from collections.abc import Iterable


def error_left(differences: Iterable[tuple[float, float]], order: float) -> float:
    """Of a figure at a resolution: the root mean square of what each of its differences leaves, if the error falls as
    resolution^-order.

    differences: pairs of the other resolution, as a share of this one, and the difference to it. Finer ones have shares
    above 1; one of just 1 tells nothing. Two or more are asked for, as one may agree with this one by chance.
    """
    left = [difference / (share**-order - 1.0) for share, difference in differences if share != 1.0]
    return math.sqrt(sum(part * part for part in left) / len(left)) if left else 0.0
