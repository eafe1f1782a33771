"""What Numba does again and again while it compiles, done once or not at all: half to two thirds of its time.

They change Numba for all of a process, so only the program's own processes take them: see `shorten`. What they are
worth each, and as patches of Numba itself: docs/numba-upstream.md.
"""

import functools
import gc
import logging

import numba
from llvmlite import ir
from numba.core import codegen, event, targetconfig
from numba.core.ir import Inst, Loc, Var
from numba.core.types import functions

from . import machine_code

TESTED = "0.61", "0.62", "0.63", "0.64", "0.65", "0.66", "0.67", "0.68"  # of Numba, by tests
log = logging.getLogger("strikewave")
_state = {"asked": False, "applied": False}


def shorten() -> None:
    """Have kernels compiled in less time from now on, in this process, where Numba is one of the `TESTED`.

    For processes that do nothing else: commands, workers, who compiles for them. Elsewhere all works without, slower.
    """
    if _state["asked"]:
        return
    _state["asked"] = True
    if not known(numba.__version__):
        log.warning("kernels take longer to compile: Numba %s is none of %s", numba.__version__, ", ".join(TESTED))
        return
    targetconfig.TargetConfig.__eq__ = _same_flags
    targetconfig.TargetConfig.__hash__ = _hash_of_flags
    functions.BaseFunction.get_call_type = _call_type
    Inst._rec_list_vars = _variables
    for size in ("get_abi_size", "get_abi_alignment"):  # of a type in memory: LLVM is asked by way of a module in text
        setattr(ir.Type, size, functools.cache(getattr(ir.Type, size)))
    event.register("numba:compile", _Compiling())
    codegen.JITCPUCodegen._library_class = machine_code.Library
    codegen.JITCPUCodegen.set_env = machine_code.set_environment
    _state["applied"] = True


def known(version: str) -> bool:
    """Whether the shortcuts have been tried on a version of Numba."""
    return ".".join(version.split(".")[:2]) in TESTED


def applied() -> bool:
    """Whether this process compiles with them."""
    return _state["applied"]


class _Compiling(event.Listener):
    """Called by Numba for every kernel that it is about to compile, and has compiled.

    Meanwhile no garbage is collected: among the many objects of a compiler, looking for some takes a twelfth of it.
    """

    def __init__(self):
        self._depth = 0  # kernels under way: one may wait for those that it calls; under Numba's lock
        self._collecting = True

    def on_start(self, compilation):
        if not self._depth:
            self._collecting = gc.isenabled()
            gc.disable()
        self._depth += 1

    def on_end(self, compilation):
        self._depth -= 1
        if not self._depth and self._collecting:
            gc.enable()


def _same_flags(self, other, of_numba=targetconfig.TargetConfig.__eq__):
    """Flags of compilation are alike if those that were set are, or are what they would be if nobody had set them:
    Numba reads all of them, each time."""
    if type(self) is not type(other):
        return of_numba(self, other)
    mine, others = self._values, other._values
    return mine == others or all(getattr(self, name) == getattr(other, name) for name in mine.keys() | others.keys())


def _hash_of_flags(self):
    """Flags differ between few functions, and are a part of keys that differ in more."""
    return hash(type(self))


def _call_type(self, context, args, kws, of_numba=functions.BaseFunction.get_call_type):
    """The types of a call of one of Numba's own functions, such as of a product of two numbers.

    Numba tries all that it has for products at each of them, until one fits; here, once for each pair of types.
    """
    known = self.__dict__.setdefault("_known_calls", {})
    key = context, tuple(args), tuple(kws.items()), targetconfig.ConfigStack.top_or_none()
    if key not in known:
        found = of_numba(self, context, args, kws)
        if found is None:
            return None
        known[key] = found
    return known[key]


def _variables(self, val):
    """Variables in a value of an instruction, whose fields are mostly of a few types."""
    listed = []
    _list_variables(val, listed)
    return listed


def _list_variables(found, listed):
    kind = type(found)
    if kind is Var:
        listed.append(found)
    elif kind is dict or kind is list or kind is tuple:
        for value in found.values() if kind is dict else found:
            if type(value) not in _PLAIN:
                _list_variables(value, listed)
    elif isinstance(found, Inst):
        listed += found.list_vars()


_PLAIN = {Loc, str, int, bool, type(None)}
