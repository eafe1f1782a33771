"""Medians of repeated runs."""

import statistics
import time
from collections.abc import Callable, Sequence

from .size import of


def median(work: Callable[[], object], repeats: int = 15) -> float:
    """Median wall time [s] of `work`, after one run that does not count."""
    work()
    times = []
    for _ in range(of(repeats, 1)):
        begun = time.perf_counter()
        work()
        times.append(time.perf_counter() - begun)
    return statistics.median(times)


def processor_times(works: Sequence[Callable[[], object]], repeats: int = 7) -> list[float]:
    """Median time of a processor [s] of each work, all in turn: what disturbs the machine disturbs them alike."""
    for work in works:
        work()
    times: list[list[float]] = [[] for _ in works]
    for _ in range(of(repeats, 1)):
        for work, own in zip(works, times, strict=True):
            begun = time.thread_time()
            work()
            own.append(time.thread_time() - begun)
    return [statistics.median(own) for own in times]


def paired_medians(floor: Callable[[], object], work: Callable[[], object], repeats: int) -> tuple[float, float, float]:
    """Medians [s] of both, timed in turn, and the median of their ratios: what disturbs one disturbs the other too."""
    floor(), work()
    pairs = []
    for _ in range(of(repeats, 1)):
        times = [time.perf_counter()]
        for run in (floor, work):
            run()
            times.append(time.perf_counter())
        pairs.append((times[1] - times[0], times[2] - times[1]))
    floors, works = zip(*pairs, strict=True)
    ratios = [second / first for first, second in pairs]
    return statistics.median(floors), statistics.median(works), statistics.median(ratios)


def row(name: str, value: float, unit: str, target: str = "") -> tuple[str, dict[str, object]]:
    print(f"  {name:62}{value:12.4g} {unit:10}{target}")
    return name, {"value": value, "unit": unit, "target": target}
