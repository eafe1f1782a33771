"""From where on a map has so many contacts: solved for at places across, each by a look at the whole height."""

from collections.abc import Callable

import numpy as np

from .lesson import Boundary
from .problems import Problems
from .scales import value_at
from .solving import QUANTITIES, Shown

ACROSS = 41  # places
UPWARDS = 33  # at which contacts are counted, before a change is halved
HALVINGS = 8  # of the step between two of these
DIGITS = 4  # behind the point, of a share

Now = Callable[..., Shown]


def boundary_of(part: Boundary, now: Now, problems: Problems) -> tuple[float, ...] | None:
    """Shares upwards at equal steps across; what is no single line from end to end is noted. `now` solves."""
    found = []
    for place in np.linspace(0.0, 1.0, ACROSS):
        changes = _changes(part, float(place), now)
        if len(changes) != 1:
            about = {"name": part.settings[0], "place": value_at(float(place), part.ranges[0], part.logs[0])}
            problems.add(part.line, "boundary-missing", count=len(changes), contacts=part.contacts, **about)
            return None
        found.append(round(changes[0], DIGITS))
    return tuple(found)


def _changes(part: Boundary, place: float, now: Now) -> list[float]:
    """Where, upwards, an impact comes to have so many contacts, or fewer again."""
    across, upwards = part.settings
    fixed = value_at(place, part.ranges[0], part.logs[0])

    def has(share: float) -> bool:
        """Whether it has so many; one that cannot be solved has none."""
        value = value_at(share, part.ranges[1], part.logs[1])
        try:
            shown = now(**{across: fixed, upwards: value})
        except ValueError:
            return False
        return (QUANTITIES[shown.kind]["contacts"](shown) or 0) >= part.contacts

    shares = [float(each) for each in np.linspace(0.0, 1.0, UPWARDS)]
    held = [has(each) for each in shares]
    return [_halved(has, shares[k - 1 : k + 1], held[k]) for k in range(1, UPWARDS) if held[k] != held[k - 1]]


def _halved(has: Callable[[float], bool], span: list[float], after: bool) -> float:
    low, high = span
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if has(middle) == after else (middle, high)
    return 0.5 * (low + high)
