"""Where a function of two numbers takes a value: lines through a grid of samples, with jumps kept apart."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from .crossings import CLOSE, CLOSER, LEAST_JUMP, SAME, Crossings

BENT = 0.25  # of the largest offset at a cell's corners: with more half-way between two roots a jump is looked for
INSIDE = 1e-3  # of an edge, from an end that has the value
FINEST = 30  # halvings towards a jump: to 1e-9 of the distance of two roots
Point = tuple[float, float]
Corner = tuple[int, int]
Edge = tuple[Corner, Corner]  # along the first number or the second, upwards
Place = tuple[Edge, int]  # which crossing of an edge


@dataclass(frozen=True)
class Crossing:
    """Of an edge, whose ends lie on different sides of the value."""

    at: Point | None  # None: what is there has no value
    sides: Point | None = None  # where it jumps, the function on both sides, the smaller first


@dataclass(frozen=True)
class Line:
    """Points that follow each other, each on an edge of the grid; those of a closed one do so round to the first."""

    vertices: list[Point]
    closed: bool
    sides: list[Point]  # beside each vertex where the function jumps; else none


@dataclass
class Squares:
    """Of `function`, NaN where it has no value, with the value `wanted`, on the grid of `xs` and `ys`, rising.

    `alike` is a number that changes where the function may jump. `side_by_side` is `map`, or does the same on threads.
    Roots and jumps on edges are those of `Crossings`, whose ends lie on both sides of the value; an end that has it
    counts as above. Cells with two are joined, those with more as the side of their middle says.
    """

    function: Callable[[float, float], float]
    alike: Callable[[float, float], float]
    wanted: float
    xs: Sequence[float]
    ys: Sequence[float]
    side_by_side: Callable[..., Iterable]

    def search(self) -> tuple[list[Line], list[Line]]:
        """Lines on which it has the value, and those on which it jumps over it."""
        columns, rows = range(len(self.xs)), range(len(self.ys))
        edges = [((i, j), (i + 1, j)) for i, j in product(columns[:-1], rows)]
        edges += [((i, j), (i, j + 1)) for i, j in product(columns, rows[:-1])]
        edges = [edge for edge in edges if self._above(*edge[0]) == (not self._above(*edge[1])) and self._known(edge)]
        self.crossings: dict[Edge, list[Crossing]] = dict(
            zip(edges, self.side_by_side(self._crossings_of, edges), strict=True)
        )
        cells = [cell for cell in product(columns[:-1], rows[:-1]) if self._known(self._corners(*cell))]
        found = [*self.side_by_side(self._links, cells)]
        places = [(edge, n) for edge, listed in self.crossings.items() for n in range(len(listed))]
        roots = [place for place in places if self._of(place).at and not self._of(place).sides]
        jumps = [place for place in places if self._of(place).sides]
        links = [link for joined, _ in found for link in joined]
        torn = [Line([tear.at], False, [tear.sides]) for _, tears in found for tear in tears if tear.at and tear.sides]
        return self._lines(roots, links), sorted([*self._lines(jumps, links), *torn], key=lambda line: line.vertices)

    def areas(self) -> int:
        """Cells at all corners of which it has the value."""
        cells = product(range(len(self.xs) - 1), range(len(self.ys) - 1))
        return sum(all(self._offset(*self._point(each)) == 0.0 for each in self._corners(*cell)) for cell in cells)

    def _point(self, corner: Corner) -> Point:
        return self.xs[corner[0]], self.ys[corner[1]]

    def _corners(self, i: int, j: int) -> tuple[Corner, ...]:
        """Round a cell."""
        return (i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)

    def _known(self, corners: Iterable[Corner]) -> bool:
        return not any(math.isnan(self._offset(*self._point(each))) for each in corners)

    def _offset(self, x: float, y: float) -> float:
        """The function less the value; zero where only rounding differs, as of `Crossings`."""
        apart = self.function(x, y) - self.wanted
        return 0.0 if abs(apart) <= SAME * abs(self.wanted) else apart

    def _above(self, i: int, j: int) -> bool:
        return self._offset(*self._point((i, j))) >= 0.0

    def _of(self, place: Place) -> Crossing:
        return self.crossings[place[0]][place[1]]

    # --- edges ---

    def _crossings_of(self, edge: Edge) -> list[Crossing]:
        """In rising order, an odd number."""
        (x, y), (to_x, to_y) = map(self._point, edge)
        level = y == to_y
        low, high = (x, to_x) if level else (y, to_y)

        def point(at: float) -> Point:
            return (at, y) if level else (x, at)

        found = Crossings(lambda at: self.function(*point(at)), self.wanted)
        ends = [low, high]
        for this, other in ((0, 1), (1, 0)):  # one that has the value may be left to the far side of it
            inner = ends[this] + INSIDE * (ends[other] - ends[this])
            if found.offset(ends[this]) == 0.0 and found.offset(inner) * found.offset(ends[other]) < 0.0:
                ends[this] = inner
        found.search(ends)
        there = [(at, Crossing(point(at))) for at in found.roots]
        there += [(at, Crossing(point(at), (min(sides), max(sides)))) for at, *sides in found.jumps]
        there += [self._end_of(found, stretch, ends, point) for stretch in found.stretches]
        listed = [crossing for _, crossing in sorted(there, key=lambda each: each[0])]
        return listed if len(listed) % 2 else [*listed, Crossing(None)]

    def _end_of(
        self, found: Crossings, stretch: Point, ends: Sequence[float], point: Callable[[float], Point]
    ) -> tuple[float, Crossing]:
        """Of a stretch that has the value, the end towards what is below it."""
        last, beyond = stretch[1], ends[1]
        if found.offset(ends[0]) < 0.0:
            last, beyond = stretch[0], ends[0]
        steps = [
            min(max(part * abs(ends[1] - ends[0]), 16.0 * math.ulp(last)), abs(beyond - last))
            for part in (10.0 * CLOSER, 10.0 * CLOSE)  # the end itself is known to CLOSER
        ]
        near, far = (found.offset(last + math.copysign(step, beyond - last)) for step in steps)
        least = LEAST_JUMP * max(abs(self.wanted), abs(found.offset(beyond)))
        jumps = -near > max(least, -0.5 * far)
        return last, Crossing(point(last), (near + self.wanted, self.wanted) if jumps else None)

    # --- cells ---

    def _links(self, cell: Corner) -> tuple[list[tuple[Place, Place]], list[Crossing]]:
        """What is joined in a cell, roots with roots and jumps with jumps, and where a line of roots is torn."""
        corners = self._corners(*cell)
        a, b, c, d = corners
        round_it = [((a, b), 1), ((b, c), 1), ((d, c), -1), ((a, d), -1)]
        places = [(edge, n) for edge, way in round_it for n in range(len(self.crossings.get(edge, ())))[::way]]
        links, tears = [], []
        for one, other in self._pairs(places, cell):
            ends = self._of(one), self._of(other)
            if any(end.at is None for end in ends) or (ends[0].sides is None) != (ends[1].sides is None):
                continue
            tear = None if ends[0].sides else self._tear(ends[0], ends[1], corners)
            links += [(one, other)] if tear is None else []
            tears += [tear] if tear is not None else []
        return links, tears

    def _pairs(self, places: Sequence[Place], cell: Corner) -> Iterator[tuple[Place, Place]]:
        """Neighbours round the cell, between which lies what its middle is not joined to."""
        if len(places) == 2:
            yield places[0], places[1]
        elif places:
            (x, y), (to_x, to_y) = self._point(cell), self._point((cell[0] + 1, cell[1] + 1))
            middle = self._offset(0.5 * (x + to_x), 0.5 * (y + to_y))
            first = 0 if self._above(*cell) == (middle >= 0.0) else 1
            turned = [*places[first:], *places[:first]]
            if not math.isnan(middle):
                yield from zip(turned[::2], turned[1::2], strict=True)

    def _tear(self, one: Crossing, other: Crossing, corners: Iterable[Corner]) -> Crossing | None:
        """Between two roots of a cell, a jump or what has no value; None where nothing speaks for one."""
        assert one.at and other.at
        (x, y), (to_x, to_y) = one.at, other.at

        def point(share: float) -> Point:
            return x + share * (to_x - x), y + share * (to_y - y)

        half = abs(self._offset(*point(0.5)))
        if math.isnan(half):
            return Crossing(None)
        largest = max(abs(self._offset(*self._point(corner))) for corner in corners)
        alike = self.alike(x, y) == self.alike(to_x, to_y)
        return None if alike and half <= BENT * largest else self._jump(point, largest)

    def _jump(self, point: Callable[[float], Point], largest: float) -> Crossing | None:
        """Halve towards another kind, or else the larger step; a jump is a step that stays as it is halved."""
        low, high, wider = 0.0, 1.0, math.inf
        for halving in range(FINEST):
            middle = 0.5 * (low + high)
            if math.isnan(self._offset(*point(middle))):
                return Crossing(None)
            kinds = [self.alike(*point(share)) for share in (low, middle, high)]
            steps = [abs(self.function(*point(middle)) - self.function(*point(share))) for share in (low, high)]
            below = kinds[0] != kinds[1] if kinds[0] != kinds[2] else steps[0] > steps[1]
            low, high = (low, middle) if below else (middle, high)
            if halving == FINEST - 8:
                wider = sum(steps)
        sides = sorted(self.function(*point(share)) for share in (low, high))
        step = sides[1] - sides[0]
        if step > LEAST_JUMP * max(abs(self.wanted), largest) and step > 0.5 * wider:
            return Crossing(point(0.5 * (low + high)), (sides[0], sides[1]))
        return None

    # --- lines ---

    def _lines(self, places: Sequence[Place], links: Sequence[tuple[Place, Place]]) -> list[Line]:
        """All of these, one after the other as they are joined."""
        beside: dict[Place, list[Place]] = {place: [] for place in places}
        for one, other in links:
            if one in beside:
                beside[one].append(other)
                beside[other].append(one)
        order = sorted(places, key=lambda place: (len(beside[place]) > 1, self._of(place).at))  # ends first
        left, lines = set(places), []
        for start in order:
            at: Place | None = start if start in left else None
            chain: list[Place] = []
            while at is not None:
                left.remove(at)
                chain.append(at)
                at = next((each for each in beside[at] if each in left), None)
            if chain:
                lines.append(self._line([self._of(place) for place in chain], len(beside[start]) > 1))
        alone = {line.vertices[0] for line in lines if len(line.vertices) > 1}
        lines = [line for line in lines if len(line.vertices) > 1 or line.vertices[0] not in alone]
        unique = {tuple(line.vertices): line for line in lines}
        return sorted(unique.values(), key=lambda line: line.vertices)

    def _line(self, chain: Sequence[Crossing], closed: bool) -> Line:
        """Without vertices that follow themselves, as where a corner of cells has the value."""
        kept = [each for n, each in enumerate(chain) if n == 0 or each.at != chain[n - 1].at]
        if closed and len(kept) > 1 and kept[0].at == kept[-1].at:
            kept.pop()
        return Line(
            [each.at for each in kept if each.at],
            closed and len(kept) > 2,
            [each.sides for each in kept if each.sides],
        )
