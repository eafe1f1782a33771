"""What makes a kernel of a function.

A kernel is compiled once per machine and releases the interpreter lock while it runs, so that a server can solve on
several threads. `parallel=True` is never used: concurrent parallel regions abort the process.
"""

import warnings
from collections.abc import Callable
from typing import Any

import numba
import scipy.linalg  # noqa: F401  (Numba wants it for its first kernel: better here than inside the first solve)

from . import cache, compiling, methods  # noqa: F401  (what they change in Numba holds for every kernel)

# A kernel works in the arrays that it is given, and returns none. So arrays need no counting of references, which for
# tuples of many of them takes half the time of a step, and a part of that of compiling.
kernel = numba.njit(cache=True, nogil=True, error_model="numpy", _nrt=False)

# One that only other kernels call: what would take its arguments from Python is not compiled.
_INNER = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
inner_kernel = numba.njit(cache=True, nogil=True, error_model="numpy", _nrt=False, **_INNER)

# One that makes arrays of its own, or returns any; so called by one that does not, too.
allocating_kernel = numba.njit(cache=True, nogil=True, error_model="numpy", _nrt=True)

# What a contact law does within a step becomes part of the loop over steps: a call costs as much as the work in it.
inlined_kernel = numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True, _nrt=False)

# Sums over modes may be reordered, so that they run on vector registers; NaN and infinity keep their meaning.
_SUMS = {"fastmath": {"reassoc", "contract"}}
summing_kernel = numba.njit(cache=True, nogil=True, error_model="numpy", _nrt=False, **_SUMS)
inner_summing_kernel = numba.njit(cache=True, nogil=True, error_model="numpy", _nrt=False, **_SUMS, **_INNER)


def address(function: Callable, signature: Any) -> Any:
    """A kernel, compiled for one signature, as a value that other kernels take without being compiled for it."""
    if numba.config.DISABLE_JIT:
        return function
    pointer = numba.types.CompileResultWAP(function.get_compile_result(signature))
    pointer._numba_type_ = numba.typeof(pointer)  # else Numba finds it out at every call, for 15 us
    return pointer


warnings.filterwarnings("ignore", "First-class function", numba.NumbaExperimentalFeatureWarning)
