"""Masses in a row with a contact law between neighbours: an impact running through them, to the last parting."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

TOLERANCE = 1e-13  # of a step, relative to the speed of the impact and to what it moves in a contact time
STRETCH = 4.0  # contact times integrated before it is seen whether all have parted
MAX_STRETCHES = 5_000
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
    until: float | None = None,
) -> Course:
    """From the first touch up to `until` [s], or until no two masses will touch again.

    mass, velocity (mass,); gaps (mass - 1,) that are free at first [m]; laws between neighbours, each of its
    indentation alone; unit: a contact time [s]. The state holds the impulses, too, as the velocities follow from them.
    Error: about 1e-10 of the speed; DOP853, whose steps are short where a contact begins or ends.
    """
    from scipy.integrate import DOP853

    row = _Row(velocity, gaps, 1.0 / mass[:-1], 1.0 / mass[1:], laws)
    speed = float(velocity.max() - velocity.min())
    contacts, masses = gaps.size, mass.size
    scale = np.concatenate((np.full(mass.size, speed * unit), np.full(contacts, speed * float(mass.min()))))
    start = np.zeros(mass.size + contacts)

    def rates(_: float, state: np.ndarray) -> np.ndarray:
        scaled, found = state * scale, np.empty_like(state)
        found[:masses] = row.speeds(scaled[masses:])
        found[masses:] = row.forces(row.indentation(scaled[:masses]).tolist())
        found /= scale
        return found

    end = until if until is not None else STRETCH * unit * MAX_STRETCHES
    solver = DOP853(rates, 0.0, start, end, rtol=TOLERANCE, atol=TOLERANCE, first_step=1e-6 * unit, max_step=unit)
    times, states = [np.zeros(1)], [start[None]]
    periods = _Periods(contacts, lambda state: row.indentation(state[..., :masses] * scale[:masses]))
    parted = False
    while solver.status == "running" and not parted:
        begun = float(solver.t)
        solver.step()
        dense = solver.dense_output()
        instants = np.linspace(begun, float(solver.t), SAMPLES + 1)[1:]
        times.append(instants)
        states.append(dense(instants).T)
        periods.add(begun, instants, states[-2][-1], states[-1], dense)
        parted = until is None and row.parted(states[-1][-1] * scale, speed)
    parted = parted or row.parted(states[-1][-1] * scale, speed)
    time, state = np.concatenate(times), np.concatenate(states) * scale
    position, impulse = state[:, :masses], state[:, masses:]
    indentation = row.indentation(position)
    force = np.array([row.forces(depths) for depths in indentation.tolist()])
    before = np.zeros((time.size, 1))
    speeds = velocity + (np.hstack((before, impulse)) - np.hstack((impulse, before))) / mass
    steps = (time.size - 1) // SAMPLES
    return Course(time, position, speeds, indentation, force, impulse, steps, parted, periods.closed(float(time[-1])))


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
