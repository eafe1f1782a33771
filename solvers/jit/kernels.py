"""What makes a kernel of a function.

A kernel is compiled once per machine and releases the interpreter lock while it runs, so that a server can solve on
several threads. `parallel=True` is never used: concurrent parallel regions abort the process.
"""

from collections.abc import Callable
from typing import Any

import numba
import scipy.linalg  # noqa: F401  (Numba wants it for its first kernel: better here than inside the first solve)
from numba.core import compiler_lock

from . import methods  # noqa: F401  (methods of tuples, for every kernel)
from .cache import KernelCache

# A kernel works in the arrays that it is given, and returns none. So arrays need no counting of references, which for
# tuples of many of them takes half the time of a step, and a part of that of compiling.
_USUAL = {"nogil": True, "error_model": "numpy", "_nrt": False, "no_cfunc_wrapper": True}


def _decorator(**options: Any) -> Callable:
    """As `numba.njit` with these options, for kernels that are kept in this library's own cache."""

    def decorate(function: Callable) -> Any:
        made = numba.njit(**options)(function)
        if not numba.config.DISABLE_JIT:
            made._cache = KernelCache(function)
        return made

    return decorate


kernel = _decorator(**_USUAL)

# One that only other kernels call: what would take its arguments from Python is not compiled.
_INNER = _USUAL | {"no_cpython_wrapper": True}
inner_kernel = _decorator(**_INNER)

# One that they call by its `address`, so as C does.
addressed_kernel = _decorator(**_INNER | {"no_cfunc_wrapper": False})

# One that makes arrays of its own, or returns any; so called by one that does not, too.
allocating_kernel = _decorator(**_USUAL | {"_nrt": True})

# What a contact law does within a step becomes part of the loop over steps: a call costs as much as the work in it.
inlined_kernel = _decorator(**_USUAL, forceinline=True)

# Sums over modes may be reordered, so that they run on vector registers; NaN and infinity keep their meaning.
_SUMS = {"reassoc", "contract"}
summing_kernel = _decorator(**_USUAL, fastmath=_SUMS)
inner_summing_kernel = _decorator(**_INNER, fastmath=_SUMS)


def address(function: Callable, signature: Any) -> Any:
    """A kernel, compiled for one signature, as a value that other kernels take without being compiled for it."""
    if numba.config.DISABLE_JIT:
        return function
    with compiler_lock.global_compiler_lock:  # machine code is made here, which clocks leave out
        pointer = numba.types.CompileResultWAP(function.get_compile_result(signature))
    pointer._numba_type_ = numba.typeof(pointer)  # else Numba finds it out at every call, for 15 us
    return pointer
