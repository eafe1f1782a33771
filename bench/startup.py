"""Import of the library, and the first solve in a new process with kernels compiled before."""

import statistics
import subprocess
import sys

from .size import of
from .timing import row

IMPORT = "import time; t = time.perf_counter(); import solvers; print(time.perf_counter() - t)"
FIRST = (
    "import time, solvers; s = solvers.load('fixed-rod'); t = time.perf_counter(); "
    "solvers.solve(s, {method!r}); print(time.perf_counter() - t)"
)


def measure() -> dict[str, object]:
    def timed(code: str) -> float:
        run = [sys.executable, "-c", code]
        for _ in range(of(1, 0)):  # does not count
            subprocess.run(run, check=True, capture_output=True)
        times = [float(subprocess.run(run, check=True, capture_output=True, text=True).stdout) for _ in range(of(7, 1))]
        return statistics.median(times)

    return dict(
        [
            row("import solvers", timed(IMPORT), "s", "<= 0.6"),
            row("first solve, waves, kernels from the disk", timed(FIRST.format(method="waves")), "s", "<= 0.3"),
            row("first solve, modal, kernels from the disk", timed(FIRST.format(method="modal")), "s", "<= 0.3"),
        ]
    )
