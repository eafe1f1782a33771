"""The only place that knows how kernels are compiled and cached.

A kernel is compiled once per machine and releases the interpreter lock while it runs, so that a server can solve on
several threads. `parallel=True` is never used: concurrent parallel regions abort the process.
"""

import os
import tempfile
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from typing import Any

import numba
import scipy.linalg  # noqa: F401  (Numba wants it for its first kernel: better here than inside the first solve)
from numba.core import event
from numba.extending import overload_method


def sources_key() -> str:
    """Twelve letters that change with any source of the library."""
    sources = sorted(Path(__file__).parent.rglob("*.py"))
    return sha256(b"".join(source.read_bytes() for source in sources)).hexdigest()[:12]


def cache_home() -> Path:
    """Where this user's programs keep what they can make again."""
    return Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")) / "strikewave"


def _cache_folder() -> str:
    """One folder per state of the sources: Numba alone misses a change in a function called from another file."""
    folder = cache_home() / (sources_key() + ("-checked" if numba.config.BOUNDSCHECK else ""))
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return tempfile.mkdtemp(prefix="strikewave-")  # compiled anew each time, but it runs
    return str(folder) if os.access(folder, os.W_OK) else tempfile.mkdtemp(prefix="strikewave-")


if "NUMBA_CACHE_DIR" not in os.environ:
    numba.config.CACHE_DIR = _cache_folder()


def all_compiled() -> Path:
    """The file that stands in the cache once every usual kernel of these sources is compiled."""
    return Path(numba.config.CACHE_DIR) / f"compiled-{sources_key()}"


class NotCompiled(Exception):
    """A kernel is wanted that is not in the cache yet, by who would rather have it compiled elsewhere."""


_thread = threading.local()


@contextmanager
def compiled_only() -> Iterator[None]:
    """Within this context, and this thread, kernels are loaded from the cache; one that is not there: NotCompiled.

    Numba compiles under one lock for all threads, for seconds: a server must not.
    """
    _thread.only_compiled = True
    try:
        yield
    finally:
        _thread.only_compiled = False


class _Refusal(event.Listener):
    """Told by Numba of every kernel that it is about to compile."""

    def on_start(self, compilation):
        if getattr(_thread, "only_compiled", False):
            raise NotCompiled(compilation.data["dispatcher"].py_func.__qualname__)

    def on_end(self, compilation):
        pass


event.register("numba:compile", _Refusal())


kernel = numba.njit(cache=True, nogil=True, error_model="numpy")

# What a contact law does within a step becomes part of the loop over steps: a call costs as much as the work in it.
inlined_kernel = numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)

# Sums over modes may be reordered, so that they run on vector registers; NaN and infinity keep their meaning.
summing_kernel = numba.njit(cache=True, nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})


def address(function: Callable, signature: Any) -> Any:
    """A kernel, compiled for one signature, as a value that other kernels take without being compiled for it."""
    if numba.config.DISABLE_JIT:
        return function
    pointer = numba.types.CompileResultWAP(function.get_compile_result(signature))
    pointer._numba_type_ = numba.typeof(pointer)  # else Numba finds it out at every call, for 15 us
    return pointer


warnings.filterwarnings("ignore", "First-class function", numba.NumbaExperimentalFeatureWarning)


# Let kernels call these methods of any contact law (a NamedTuple) exactly as plain Python does.
@overload_method(numba.types.BaseNamedTuple, "force")
def _force(self, indentation, rate, deepest):
    return self.instance_class.force


@overload_method(numba.types.BaseNamedTuple, "slopes")
def _slopes(self, indentation, rate, deepest):
    return self.instance_class.slopes


@overload_method(numba.types.BaseNamedTuple, "stored")
def _stored(self, indentation, deepest):
    return self.instance_class.stored


@overload_method(numba.types.BaseNamedTuple, "dent")
def _dent(self, deepest):
    return self.instance_class.dent


@overload_method(numba.types.BaseNamedTuple, "way_back")
def _way_back(self, deepest):
    return self.instance_class.way_back


@overload_method(numba.types.BaseNamedTuple, "corner")
def _corner(self, indentation, deepest):
    return self.instance_class.corner


@overload_method(numba.types.BaseNamedTuple, "mean")
def _mean(self, start, end, rate, deepest):
    return self.instance_class.mean


@overload_method(numba.types.BaseNamedTuple, "mean_force", jit_options={"forceinline": True})
def _mean_force(self, start, free, compliance, rate, expected, deepest, memory):
    return self.instance_class.mean_force


@overload_method(numba.types.BaseNamedTuple, "loading_mean")
def _loading_mean(self, start, end):
    return self.instance_class.loading_mean


@overload_method(numba.types.BaseNamedTuple, "unloading_mean")
def _unloading_mean(self, start, end, deepest):
    return self.instance_class.unloading_mean


# The same for any integrator (a NamedTuple).
@overload_method(numba.types.BaseNamedTuple, "advance")
def _advance(self, law, state):
    return self.instance_class.advance
