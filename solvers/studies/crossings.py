"""Where a function of one number takes a value: looked for among samples, with jumps over the value kept apart."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

SAME = 1e-12  # of the wanted value: no difference
NEAR = 2.0  # a dip is looked at where its distance from the value is within so many times what it rises to its sides
TOUCH = 1e-9  # of the wanted value or of the dip's sides: it touches
CLOSE, CLOSER = 1e-7, 1e-9  # of the distance of two samples, either side of what may be a jump
LEAST_JUMP = 1e-7  # of the wanted value: smaller ones are rounding
EDGE = 14  # halvings towards a value that has no answer
APART = (1e-3, 1e-4, 1e-5, 1e-6)  # of the distance of two samples: differences for a slope
EVEN = 0.01  # by which slopes on both sides may differ
DEEPEST = 6  # pieces within pieces
Pair = tuple[float, float]


class _Missing(Exception):
    """The function has no value here."""

    def __init__(self, at: float):
        super().__init__(at)
        self.at = at


class _Passed(Exception):
    """The other side of the wanted value is reached here."""

    def __init__(self, at: float):
        super().__init__(at)
        self.at = at


@dataclass
class Crossings:
    """Of `function`, NaN where it has no value, with the value `wanted`.

    `roots`; `jumps`, which pass over the value, each with the function on both sides; `stretches`, from and to where
    it has the value all along. Roots to 1e-10 or so of themselves, ends of stretches and jumps to 1e-8 of the
    distance of the samples.
    """

    function: Callable[[float], float]
    wanted: float
    roots: list[float] = field(default_factory=list)
    jumps: list[tuple[float, float, float]] = field(default_factory=list)
    stretches: list[Pair] = field(default_factory=list)

    def search(self, samples: Sequence[float]) -> None:
        """Among these values, in rising order."""
        for piece in self._pieces(samples):
            self._stretches_among(piece)
            for a, b in pairwise(piece):
                if self.offset(a) * self.offset(b) < 0.0:
                    self._between(a, b)
            self._dips(piece)
        self.roots, self.jumps, self.stretches = (sorted(set(found)) for found in self._all())

    def look_closer(self, samples: Sequence[float]) -> None:
        """Beside the sample that comes nearest, however far that is."""
        pieces = [piece for piece in self._pieces(samples) if len(piece) > 1]
        if pieces:
            best = min(pieces, key=lambda piece: min(abs(self.offset(x)) for x in piece))
            self._dip(best, min(range(len(best)), key=lambda i: abs(self.offset(best[i]))))

    def slope(self, x: float, spacing: float, low: float, high: float) -> float | None:
        """By differences that cross no jump; at a kink the mean of its sides. None where nothing is beside it."""
        best: Pair | None = None
        for part in APART:
            step = part * spacing
            here = self.function(x)
            sides = [
                (self.function(x + way * step) - here) / (way * step)
                for way in (-1, 1)
                if low <= x + way * step <= high
            ]
            sides = [side for side in sides if not math.isnan(side)]
            if not sides:
                continue
            uneven = abs(sides[0] - sides[-1])
            if best is None or uneven < best[0]:
                best = uneven, sum(sides) / len(sides)
            if uneven <= EVEN * max(map(abs, sides)):
                return sum(sides) / len(sides)
        return None if best is None else best[1]

    def offset(self, x: float) -> float:
        """The function less the value wanted; zero where only rounding differs."""
        apart = self.function(x) - self.wanted
        return 0.0 if abs(apart) <= SAME * abs(self.wanted) else apart

    def _all(self) -> tuple[list, list, list]:
        return self.roots, self.jumps, self.stretches

    def _known(self, x: float) -> float:
        apart = self.offset(x)
        if math.isnan(apart):
            raise _Missing(x)
        return apart

    def _pieces(self, samples: Sequence[float]) -> Iterator[list[float]]:
        """Neighbours that have values, out to where these end."""
        piece: list[float] = []
        for i, x in enumerate(samples):
            if not math.isnan(self.offset(x)):
                before = samples[i - 1] if i else None
                piece += [self._edge(x, before)] if not piece and before is not None else []
                piece += [] if piece and piece[-1] == x else [x]
            elif piece:
                edge = self._edge(piece[-1], x)
                yield piece + ([edge] if edge != piece[-1] else [])
                piece = []
        if piece:
            yield piece

    def _edge(self, inside: float, outside: float) -> float:
        """The last value with an answer towards one that has none."""
        for _ in range(EDGE):
            middle = 0.5 * (inside + outside)
            inside, outside = (inside, middle) if math.isnan(self.offset(middle)) else (middle, outside)
        return inside

    # --- samples that have the value ---

    def _stretches_among(self, piece: Sequence[float]) -> None:
        """Of all samples with the value: alone they are roots, else parts of a stretch."""
        until = -math.inf
        for i, x in enumerate(piece):
            if x > until and self.offset(x) == 0.0:
                until = self._at(x, piece[max(i - 1, 0)], piece[min(i + 1, len(piece) - 1)], piece)

    def _at(self, x: float, before: float, after: float, piece: Sequence[float]) -> float:
        """Take a place with the value as a root or as a stretch, which may go on over further samples; its end."""
        beside = [x + 1e-3 * (other - x) for other in (before, after) if other != x]
        if all(self.offset(each) != 0.0 for each in beside):
            self.roots.append(x)
            return x
        first, last = x, x
        for other in [each for each in piece if each > x] or [after]:
            if self.offset(other) == 0.0 == self.offset(0.5 * (last + other)):
                last = other
                continue
            last = self._last_zero(last, other)
            break
        if before != first:
            first = self._last_zero(first, before)
        self.stretches.append((first, last))
        return last

    def _last_zero(self, inside: float, outside: float) -> float:
        least = CLOSER * abs(outside - inside)
        while abs(outside - inside) > max(least, 4.0 * math.ulp(inside)):
            middle = 0.5 * (inside + outside)
            inside, outside = (middle, outside) if self.offset(middle) == 0.0 else (inside, middle)
        return inside

    # --- changes of sign ---

    def _between(self, a: float, b: float, depth: int = 0) -> None:
        """All roots and jumps that show between two values on different sides."""
        from scipy.optimize import brentq  # a third of a second, which nothing else here needs

        width = b - a
        try:
            x = float(brentq(self._known, a, b, xtol=max(1e-11 * width, 5e-324), rtol=1e-15))
        except _Missing as hole:
            if depth < DEEPEST:
                self._in_parts([(a, self._edge(a, hole.at)), (self._edge(b, hole.at), b)], depth)
            return
        if self.offset(x) == 0.0 and any(self.offset(x + 1e-3 * (end - x)) == 0.0 for end in (a, b)):
            self._at(x, a, b, (a, b))
            first, last = self.stretches[-1]
        else:
            first, last = self._root_or_jump(x, a, b)
        if depth < DEEPEST:
            self._in_parts([(a, first), (last, b)], depth)

    def _in_parts(self, parts: Sequence[Pair], depth: int = 0) -> None:
        for a, b in parts:
            if a < b and self.offset(a) * self.offset(b) < 0.0:
                self._between(a, b, depth + 1)

    def _root_or_jump(self, x: float, a: float, b: float) -> Pair:
        """Take it as what it is; what lies just before it and just behind it."""
        closer = max(CLOSER * (b - a), 16.0 * math.ulp(x))
        close = closer * CLOSE / CLOSER
        inner, outer = ((max(a, x - step), min(b, x + step)) for step in (closer, close))
        below, above = map(self.offset, inner)
        step = abs(above - below)
        least = LEAST_JUMP * max(abs(self.wanted), abs(self.offset(a)), abs(self.offset(b)))
        if below * above < 0.0 and step > least and step > 0.5 * abs(self.offset(outer[1]) - self.offset(outer[0])):
            self.jumps.append((x, below + self.wanted, above + self.wanted))
        else:
            self.roots.append(x)
        return outer

    # --- dips between samples ---

    def _dips(self, piece: Sequence[float]) -> None:
        """Where three samples on one side come near the value in their middle, or two at an end of a piece."""
        for i, x in enumerate(piece):
            sides = [self.offset(piece[j]) for j in (i - 1, i + 1) if 0 <= j < len(piece)]
            here = self.offset(x)
            away = [abs(side) - abs(here) for side in sides if side * here > 0.0]
            if sides and len(away) == len(sides) and min(away) >= 0.0 and abs(here) <= NEAR * max(away):
                self._dip(piece, i)

    def _dip(self, piece: Sequence[float], i: int) -> None:
        """Between the neighbours of a sample: two roots, one that touches, or none."""
        a, b = piece[max(i - 1, 0)], piece[min(i + 1, len(piece) - 1)]
        way = math.copysign(1.0, self.offset(piece[i]))
        sides = [self.offset(each) * way for each in (a, b)]
        if a == b or min(sides) <= 0.0:
            return

        from scipy.optimize import minimize_scalar  # likewise

        def distance(x: float) -> float:
            apart = way * self._known(float(x))
            if apart < 0.0:
                raise _Passed(float(x))
            return apart

        try:
            found = minimize_scalar(distance, bounds=(a, b), method="bounded", options={"xatol": 1e-8 * (b - a)})
        except _Missing:
            return
        except _Passed as other:
            self._in_parts([(a, other.at), (other.at, b)])
            return
        x, least = float(found.x), distance(float(found.x))
        if least <= TOUCH * max(abs(self.wanted), *sides) and not any(
            first <= x <= last for first, last in self.stretches
        ):
            self.roots.append(x)
