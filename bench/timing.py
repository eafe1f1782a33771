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


def row(name: str, value: float, unit: str, target: str = "") -> tuple[str, dict[str, object]]:
    print(f"  {name:62}{value:12.4g} {unit:10}{target}")
    return name, {"value": value, "unit": unit, "target": target}
