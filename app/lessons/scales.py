"""Shares of what is shown of a setting: by ratios where its slider goes by them."""

import math

FAR = 10.0  # times the lowest value: sliders that go as far do so by ratios, as app/static/whatif/axes.js has it

Range = tuple[float, float]


def is_log(bounds: Range) -> bool:
    """Whether shares of a setting with these bounds are of ratios."""
    low, high = bounds
    return low > 0.0 and high >= FAR * low


def share_of(value: float, shown: Range, log: bool) -> float:
    """From 0 at the lower end of what is shown to 1; beyond them where the value is."""
    low, high = shown
    return math.log(value / low) / math.log(high / low) if log and value > 0.0 else (value - low) / (high - low)


def value_at(share: float, shown: Range, log: bool) -> float:
    """The value of a share."""
    low, high = shown
    return low * (high / low) ** share if log else low + share * (high - low)
