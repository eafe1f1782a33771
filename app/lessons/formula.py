"""Arithmetic over figures of an impact, as `answer = "{impulse} / 2"` has it: numbers, + - * /, parentheses, figures in
braces, and quantities in braces such as {20 µs}."""

import math
import re
from collections.abc import Callable, Mapping
from typing import NamedTuple

from .units import NONE, TIME_UNIT, Dimension, alike, dimension_of

LONGEST = 120  # characters, which bounds how deep parentheses are
NUMBER = r"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
TOKEN = re.compile(
    rf"\s*(?:(?P<number>{NUMBER})|\{{(?P<figure>[a-z][a-z0-9_-]{{0,39}})\}}"
    rf"|\{{(?P<quantity>{NUMBER} [^{{}}]{{1,10}})\}}|(?P<sign>[-+*/()]))"
)


class Quantity(NamedTuple):
    """In SI units; `dimension`: None where it is not known."""

    value: float
    dimension: Dimension | None = NONE


class Mixed(ValueError):
    """Quantities of unlike dimensions are added."""


Evaluated = Callable[[Mapping[str, Quantity]], Quantity]


class Formula(NamedTuple):
    """As it is written, the figures in it, and how it is worked out. `of` raises Mixed; a division by zero is NaN."""

    text: str
    figures: tuple[str, ...]
    of: Evaluated


def formula(text: str) -> Formula:
    """Raises ValueError where it is none."""
    if len(text) > LONGEST:
        raise ValueError
    reader = _Reader(text)
    evaluated = reader.sum()
    if reader.left:
        raise ValueError
    return Formula(text, tuple(dict.fromkeys(reader.figures)), evaluated)


class _Reader:
    """Recursive descent: a sum of products of signed numbers, figures and sums in parentheses."""

    def __init__(self, text: str):
        self.left = _tokens(text)
        self.figures: list[str] = []

    def sum(self) -> Evaluated:
        found = self.product()
        while self._next() in ("+", "-"):
            found = _both(self.left.pop(0)[1], found, self.product())
        return found

    def product(self) -> Evaluated:
        found = self.factor()
        while self._next() in ("*", "/"):
            found = _both(self.left.pop(0)[1], found, self.factor())
        return found

    def factor(self) -> Evaluated:
        if not self.left:
            raise ValueError
        kind, word = self.left.pop(0)
        if kind in ("number", "quantity"):
            number = _quantity(*word.split(" ", 1)) if kind == "quantity" else Quantity(float(word))
            return lambda _: number
        if kind == "figure":
            self.figures.append(word)
            return lambda figures: figures[word]
        if word in "+-":
            return _both("*", lambda _: Quantity(1.0 if word == "+" else -1.0), self.factor())
        found = self.sum()
        if word != "(" or self._next() != ")":
            raise ValueError
        self.left.pop(0)
        return found

    def _next(self) -> str:
        kind, word = self.left[0] if self.left else ("", "")
        return word if kind == "sign" else ""


def _quantity(number: str, unit: str) -> Quantity:
    factor = alike(unit).get(unit)
    if factor is None or unit == TIME_UNIT:  # which each scene has its own of
        raise ValueError
    return Quantity(float(number) * factor, dimension_of(unit))


def _tokens(text: str) -> list[tuple[str, str]]:
    found, place, text = list[tuple[str, str]](), 0, text.rstrip()
    while place < len(text):
        match = TOKEN.match(text, place)
        if match is None:
            raise ValueError
        found.append((match.lastgroup or "", match[match.lastgroup or 0]))
        place = match.end()
    return found


def _both(sign: str, first: Evaluated, second: Evaluated) -> Evaluated:
    def found(figures: Mapping[str, Quantity]) -> Quantity:
        a, b = first(figures), second(figures)
        return Quantity(VALUES[sign](a.value, b.value), DIMENSIONS[sign](a.dimension, b.dimension))

    return found


def _alike(a: Dimension | None, b: Dimension | None) -> Dimension | None:
    if a is not None and b is not None and a != b:
        raise Mixed
    return b if a is None else a


def _powers(sign: int) -> Callable[[Dimension | None, Dimension | None], Dimension | None]:
    def found(a: Dimension | None, b: Dimension | None) -> Dimension | None:
        return None if a is None or b is None else (a[0] + sign * b[0], a[1] + sign * b[1], a[2] + sign * b[2])

    return found


VALUES: dict[str, Callable[[float, float], float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b if b else math.nan,
}
DIMENSIONS = {"+": _alike, "-": _alike, "*": _powers(1), "/": _powers(-1)}
