"""Masses in a row with a contact law between neighbours: an impact running through them, to the last parting."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

TOLERANCE = 1e-13  # of a step, relative to the speed of the impact and to what it moves in a contact time
MAX_STEPS = 5_000  # 2 s, of a row that is followed until its last parting; a contact takes some 50
PARTED = 1e-9  # of the speed of the impact: neighbours that close up more slowly than that are taken as parted
SAMPLES = 8  # instants kept of a step


class Course(NamedTuple):
    """How the masses move: arrays (time, mass) and (time, contact), SI units."""

    time: np.ndarray
    position: np.ndarray  # from where each began [m]
    velocity: np.ndarray
    indentation: np.ndarray  # of each contact; negative: a gap
    force: np.ndarray
    impulse: np.ndarray  # of each contact so far
    steps: int
    parted: bool  # for good
    contacts: list[list[tuple[float, float]]]  # by contact: start and end of every period


def follow(
    mass: np.ndarray,
    velocity: np.ndarray,
    gaps: np.ndarray,
    laws: Sequence[Any],
    unit: float,
    limit: float,
    until: float | None = None,
) -> Course:
    """From the first touch up to `until` [s], or until no two masses will touch again, at most to `limit` [s].

    mass, velocity (mass,); gaps (mass - 1,) that are free at first [m]; laws between neighbours, each of its
    indentation alone; unit: a contact time [s]. The state holds the impulses, too, as the velocities follow from them.
    While nothing touches, the masses fly on to the next touch at once. Error: about 1e-10 of the speed; DOP853, whose
    steps are short where a contact begins or ends.
    """
    row = _Row(velocity, gaps, 1.0 / mass[:-1], 1.0 / mass[1:], laws)
    speed, contacts, masses = float(velocity.max() - velocity.min()), gaps.size, mass.size
    scale = np.concatenate((np.full(masses, speed * unit), np.full(contacts, speed * float(mass.min()))))
    periods = _Periods(contacts, lambda state: row.indentation(state[..., :masses] * scale[:masses]))
    time, state, steps = _march(row, scale, speed, unit, limit, until, periods)
    parted = row.parted(state[-1] * scale, speed)
    state = state * scale
    position, impulse = state[:, :masses], state[:, masses:]
    indentation = row.indentation(position)
    force = np.array([row.forces(depths) for depths in indentation.tolist()])
    before = np.zeros((time.size, 1))
    speeds = velocity + (np.hstack((before, impulse)) - np.hstack((impulse, before))) / mass
    return Course(time, position, speeds, indentation, force, impulse, steps, parted, periods.closed(float(time[-1])))


def _march(
    row: "_Row",
    scale: np.ndarray,
    speed: float,
    unit: float,
    limit: float,
    until: float | None,
    periods: "_Periods",
) -> tuple[np.ndarray, np.ndarray, int]:
    """Instants, states as shares of `scale`, (time, masses + contacts), and how many steps it took; see `follow`."""
    from scipy.integrate import DOP853

    masses, end = row.velocity.size, limit if until is None else until

    def rates(_: float, state: np.ndarray) -> np.ndarray:
        scaled, found = state * scale, np.empty_like(state)
        found[:masses] = row.speeds(scaled[masses:])
        found[masses:] = row.forces(row.indentation(scaled[:masses]).tolist())
        found /= scale
        return found

    def solver_from(begun: float, state: np.ndarray) -> Any:
        first = min(1e-6 * unit, 0.5 * (end - begun))
        return DOP853(rates, begun, state, end, rtol=TOLERANCE, atol=TOLERANCE, first_step=first, max_step=unit)

    start, steps = np.zeros(scale.size), 0
    solver, times, states = solver_from(0.0, start), [np.zeros(1)], [start[None]]
    while solver.status == "running" and (until is not None or steps < MAX_STEPS):
        begun = float(solver.t)
        solver.step()
        steps, dense = steps + 1, solver.dense_output()
        instants = np.linspace(begun, float(solver.t), SAMPLES + 1)[1:]
        times.append(instants)
        states.append(dense(instants).T)
        periods.add(begun, instants, states[-2][-1], states[-1], dense)
        last, begun = states[-1][-1], float(solver.t)
        if until is None and row.parted(last * scale, speed):
            break
        later = min(begun + row.flight(last * scale), end)
        if later - begun > unit:
            landed = last.copy()
            landed[:masses] += (later - begun) * row.speeds(last[masses:] * scale[masses:]) / scale[:masses]
            times.append(np.array([later]))
            states.append(landed[None])
            if later == end:
                break
            solver = solver_from(later, landed)
    return np.concatenate(times), np.concatenate(states), steps


class _Row(NamedTuple):
    """The masses at the start, and what follows from their positions and impulses."""

    velocity: np.ndarray
    gaps: np.ndarray
    slowed: np.ndarray  # of each contact: the left mass, by a unit impulse
    sped_up: np.ndarray  # the right one
    laws: Sequence[Any]

    def speeds(self, impulse: np.ndarray) -> np.ndarray:
        found = self.velocity.copy()
        found[:-1] -= self.slowed * impulse
        found[1:] += self.sped_up * impulse
        return found

    def indentation(self, position: np.ndarray) -> np.ndarray:
        return position[..., :-1] - position[..., 1:] - self.gaps

    def forces(self, depths: list[float]) -> list[float]:
        return [law.force(a, 0.0, 0.0) if a > 0.0 else 0.0 for law, a in zip(self.laws, depths, strict=True)]

    def flight(self, state: np.ndarray) -> float:
        """How long nothing touches from a state on [s]: 0 if something does; infinite if nothing will."""
        masses = self.velocity.size
        gaps, closing = -self.indentation(state[:masses]), -np.diff(self.speeds(state[masses:]))
        if np.any(gaps < 0.0):
            return 0.0
        near = closing > 0.0
        return float(np.min(gaps[near] / closing[near], initial=np.inf)) * (1.0 - 1e-12)

    def parted(self, state: np.ndarray, speed: float) -> bool:
        """Whether nothing touches and no neighbours come closer."""
        masses = self.velocity.size
        closing = -np.diff(self.speeds(state[masses:]))
        return bool(np.all(self.indentation(state[:masses]) <= 0.0) and np.all(closing <= PARTED * speed))


class _Periods:
    """Start and end of every contact, as roots of its indentation within steps."""

    def __init__(self, contacts: int, pressing: Callable[[np.ndarray], np.ndarray]):
        self._pressing = pressing
        self._open: list[float | None] = [None] * contacts
        self._found: list[list[tuple[float, float]]] = [[] for _ in range(contacts)]

    def add(self, before: float, instants: np.ndarray, last: np.ndarray, states: np.ndarray, dense: Callable) -> None:
        from scipy.optimize import brentq

        depths = self._pressing(np.vstack((last, states)))
        edges = np.append(before, instants)
        for contact, k in zip(*np.nonzero(np.diff(depths > 0.0, axis=0).T), strict=True):
            at = brentq(lambda t, i=contact: float(self._pressing(dense(t))[i]), edges[k], edges[k + 1], xtol=1e-18)
            begun = self._open[contact]
            if begun is None:
                self._open[contact] = at if depths[k, contact] < 0.0 else edges[k]
            else:
                self._found[contact].append((begun, at))
                self._open[contact] = None

    def closed(self, end: float) -> list[list[tuple[float, float]]]:
        """All of them; those still open end with the solution."""
        for contact, begun in enumerate(self._open):
            if begun is not None:
                self._found[contact].append((begun, end))
        return self._found
