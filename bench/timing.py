"""Medians of repeated runs."""

import statistics
import time
from collections.abc import Callable


def median(work: Callable[[], object], repeats: int = 15) -> float:
    """Median wall time [s] of `work`, after one run that does not count."""
    work()
    times = []
    for _ in range(repeats):
        begun = time.perf_counter()
        work()
        times.append(time.perf_counter() - begun)
    return statistics.median(times)


def paired_medians(floor: Callable[[], object], work: Callable[[], object], repeats: int) -> tuple[float, float, float]:
    """Medians [s] of both, timed in turn, and the median of their ratios: what disturbs one disturbs the other too."""
    floor(), work()
    pairs = []
    for _ in range(repeats):
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
