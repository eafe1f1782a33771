"""Compromises between two figures: which points no other beats in both, and a search that spreads along them.

The search is differential evolution whose survivors are sorted by what beats them and by how close their neighbours are
(Kukkonen and Lampinen, GDE3, 2005; Deb et al., NSGA-II, 2002), then a bound on the one figure, half-way over the widest
gap that is left, while the other is searched for its best.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from .searching import LEAST_LEFT, PEOPLE, Limit, Search

DIGITS = 10  # of figures that are compared: what differs less is rounding
SINGLE, SPREAD = 0.25, 0.75  # of the solves: for each of both figures alone; up to which the population spreads
FEWEST, MOST = 24, 96  # candidates
STILL = 20  # generations without a new point, after which there is none
LEAST_GAP = 1e-6  # of the front: smaller ones are not looked into
CROSSED = 0.9  # of the keys that come from others
STEPS = (0.4, 0.9)  # times the difference of two others

Aims = list[tuple[int, bool]]  # of both figures: the place among those of the work, and whether it is to be large


class Front:
    """What a search finds, seen by two figures."""

    def __init__(self, search: Search, aims: Aims):
        self.search, self.aims = search, aims
        self.limits, self.solves = search.limits, search.solves

    def run(self, points: int, seed: int, cancelled: Callable[[], bool]) -> list[str]:
        """The best of both figures, then what lies between: at most so many, by name, from the first one's best on."""
        for number, (place, largest) in enumerate(self.aims):
            if number == 0 or not cancelled():
                self.search.aim(place, largest, self.limits, int(SINGLE * (number + 1) * self.solves))
                self.search.run(seed, cancelled)
        self._evolve(SPREAD * self.solves, seed, cancelled)
        return self._spread(points, cancelled)

    def unbeaten(self) -> list[str]:
        """All points that keep the limits and that no other beats, from the best of the first figure on."""
        names = list(self.search.found)
        aims, over = self._judged(names)
        order = [place for place in np.lexsort((aims[:, 1], aims[:, 0])) if over[place] == 0.0]
        kept, least = [], np.inf
        for place in order:
            if aims[place, 1] < least:
                least = aims[place, 1]
                kept.append(names[place])
        return kept

    def at(self, names: Sequence[str]) -> np.ndarray:
        """(points, 2) both figures, small ones better."""
        found = np.array([self.search.found[name] for name in names]).reshape(len(names), -1)
        signs = [-1.0 if largest else 1.0 for _, largest in self.aims]
        return rounded(found[:, [place for place, _ in self.aims]]) * signs

    def _judged(self, names: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
        """Both figures, and by how much the limits are violated; inf where a figure does not exist."""
        aims = self.at(names)
        self.search.limits = self.limits
        over = self.search.violated(np.stack([self.search.found[name] for name in names], 1))
        return aims, np.where(np.isnan(aims).any(1), np.inf, over)

    def _evolve(self, until: float, seed: int, cancelled: Callable[[], bool]) -> None:
        """Along the whole front."""
        rng = np.random.default_rng(seed)
        names, unbeaten = list(self.search.found), self.unbeaten()
        size = min(max(FEWEST, PEOPLE * len(self.search.axes)), MOST)
        step = max(1, len(names) // (2 * size))  # some from all over, beside those that none beats
        begin = list(dict.fromkeys([*unbeaten[:: max(1, len(unbeaten) // size)], *names[::step]]))
        people = self._survivors(begin, size)
        still = 0
        while len(self.search.found) < until and still < STILL and len(people) > 3 and not cancelled():
            before, shares = len(self.search.found), np.array([self.search.shares[name] for name in people])
            picked = np.array([rng.permutation(len(people))[:3] for _ in people])
            one, two, three = shares[picked].transpose(1, 0, 2)
            changed = one + rng.uniform(*STEPS, (len(people), 1)) * (two - three)
            taken = rng.random(shares.shape) < CROSSED
            taken[np.arange(len(people)), rng.integers(shares.shape[1], size=len(people))] = True
            tried = np.clip(np.where(taken, changed, shares), 0.0, 1.0)
            self.search.figures(tried)
            children = [repr(self.search.row(share)) for share in tried]
            people = self._survivors(list(dict.fromkeys([*people, *children])), size)
            still = 0 if len(self.search.found) > before else still + 1

    def _survivors(self, names: list[str], size: int) -> list[str]:
        """Those that the fewest beat; among the last of these the ones that stand alone."""
        aims, over = self._judged(names)
        level = levels(aims, over)
        alone = np.zeros(len(names))
        for each in np.unique(level):
            alone[level == each] = solitude(aims[level == each])
        return [names[place] for place in np.lexsort((-alone, level))[:size]]

    def _spread(self, points: int, cancelled: Callable[[], bool]) -> list[str]:
        """From both ends on, the middle of the widest gap, again and again."""
        empty: dict[tuple[str, int], float] = {}  # up to where nothing lies beside a point, of which figure
        for place, largest in self.aims:
            if not cancelled():
                self.search.aim(place, largest, self.limits, self._until(points))
                self.search.closer()
        unbeaten = self.unbeaten()
        chosen = list(dict.fromkeys([*unbeaten[:1], *unbeaten[-1:]]))
        while 1 < len(chosen) < points and not cancelled():
            gaps, middles = self._gaps(chosen, empty)
            widest, along = map(int, np.unravel_index(gaps.argmax(), gaps.shape))
            if gaps[widest, along] < LEAST_GAP:
                break
            ends, middle = (chosen[widest], chosen[widest + 1]), float(middles[widest, along])
            best = self._bounded(middle, along, points - len(chosen))
            unbeaten = self.unbeaten()
            between = self._between(best, unbeaten, ends)
            if between is None:  # a front that jumps
                empty[ends[along], along] = middle
            # An end may be beaten by now, as may others.
            kept = {*chosen, unbeaten[0], unbeaten[-1], *([between] if between else [])}
            chosen = [name for name in unbeaten if name in kept]
        return chosen

    def _gaps(self, chosen: Sequence[str], empty: Mapping[tuple[str, int], float]) -> tuple[np.ndarray, np.ndarray]:
        """(gaps, 2) between neighbours, as shares of the whole front, less what is known to be empty; their middles."""
        aims = self.at(chosen)
        gaps, middles = np.empty((2, len(chosen) - 1, 2))
        for along in (0, 1):  # the first figure rises, the other one falls
            better = range(along, len(chosen) - 1 + along)
            start = np.array([max(aims[n, along], empty.get((chosen[n], along), -np.inf)) for n in better])
            end = aims[1:, 0] if along == 0 else aims[:-1, 1]
            gaps[:, along] = (end - start) / max(abs(aims[-1, along] - aims[0, along]), 1e-300)
            middles[:, along] = 0.5 * (start + end)
        return gaps, middles

    def _bounded(self, middle: float, along: int, others: int) -> str | None:
        """The best of the one figure that is found with the other, small ones better, up to a bound."""
        place, largest = self.aims[along]
        figure = self.search.work.figures[place]
        bound = Limit(figure, ">=", -middle) if largest else Limit(figure, "<=", middle)
        self.search.aim(*self.aims[1 - along], [*self.limits, bound], self._until(others))
        self.search.closer()
        best = self.search.best()
        self.search.limits = self.limits
        return best

    def _until(self, others: int) -> int:
        """Solves, after an even share of those that are left."""
        left = self.solves - len(self.search.found)
        return len(self.search.found) + max(left // others, min(left, LEAST_LEFT))

    def _between(self, best: str | None, unbeaten: Sequence[str], ends: tuple[str, str]) -> str | None:
        """That, or what beats it by rounding, if it lies between both."""
        if best is None:
            return None
        aims, (aim, one, other) = self.at(unbeaten), self.at((best, *ends))
        as_good = (aims <= aim).all(1)
        within = (aims[:, 0] > one[0]) & (aims[:, 0] < other[0])
        found = np.flatnonzero(as_good & within)
        return unbeaten[int(found[0])] if found.size else None


def rounded(figures: np.ndarray) -> np.ndarray:
    """To the digits that count."""
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = 10.0 ** (DIGITS - 1 - np.floor(np.log10(np.abs(figures))))
        return np.where(np.isfinite(scale) & (scale > 0.0), np.round(figures * scale) / scale, figures)


def levels(aims: np.ndarray, over: np.ndarray) -> np.ndarray:
    """Of points (points, 2): 0 for those that no other beats, 1 for those that only these beat, and so on.

    Who keeps the limits (`over` is 0) beats who does not, who violates them less beats who does so more.
    """
    below = (aims[:, None] <= aims[None]).all(-1) & (aims[:, None] < aims[None]).any(-1)
    kept = over == 0.0
    beats = np.where(kept[:, None] & kept[None], below, over[:, None] < over[None])
    found, left, level = np.zeros(len(aims), int), np.ones(len(aims), bool), 0
    while left.any():
        best = left & ~(beats & left[:, None]).any(0)
        found[best] = level
        left &= ~best
        level += 1
    return found


def solitude(aims: np.ndarray) -> np.ndarray:
    """(points,) how far the neighbours of each are apart, as shares of the whole; inf for those at an end."""
    found = np.zeros(len(aims))
    for values in aims.T:
        order = np.argsort(values, kind="stable")
        wide = values[order[-1]] - values[order[0]]
        found[order[[0, -1]]] = np.inf
        if len(aims) > 2 and wide > 0.0:
            found[order[1:-1]] += (values[order[2:]] - values[order[:-2]]) / wide
    return found
