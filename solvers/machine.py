"""What wall times are worth: the machine they were measured on, and the state of the library."""

import os
import platform
from importlib import metadata
from pathlib import Path

from .jit import sources_key


def machine() -> dict[str, object]:
    """Processor, cores and Python, as results name them."""
    model = platform.processor() or platform.machine() or "unknown"
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
        model = next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), model)
    except OSError:
        pass  # not Linux: what Python knows must do
    return {"processor": model, "cores": os.cpu_count(), "python": platform.python_version()}


def version() -> str:
    """Of the library, with the state of its sources: measured once, valid for these only."""
    try:
        number = metadata.version("strikewave")
    except metadata.PackageNotFoundError:  # run from its sources, not installed
        number = "0"
    return f"{number}+{sources_key()}"
