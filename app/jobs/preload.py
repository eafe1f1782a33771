"""What workers are forked from loads this first: all that they do, and the kernels that the first pages need."""

import gc
from contextlib import suppress

from solvers.jit.compiling import NotCompiled, compiled_only
from solvers.jit.shortcuts import shorten

from .compiler import usual, works


def load() -> None:
    """Solve once, with the kernels that are compiled by now; what is not there yet each worker loads later."""
    shorten()
    do = works()
    for name, choices in usual():
        if name == "solve_frame":
            with suppress(NotCompiled), compiled_only():
                do[name](choices)
    gc.collect()


load()
