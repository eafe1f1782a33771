"""What Numba does again and again while it compiles, done once or not at all: a fifth of the time of compiling."""

import functools

from llvmlite import ir
from llvmlite.binding import ffi
from numba.core import cpu, errors, targetconfig
from numba.core.ir import Inst, Loc, Var
from numba.core.types import functions


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


targetconfig.TargetConfig.__eq__ = _same_flags
targetconfig.TargetConfig.__hash__ = _hash_of_flags


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


functions.BaseFunction.get_call_type = _call_type


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
Inst._rec_list_vars = _variables

# Sizes of a type in memory: LLVM is asked by way of a module in text.
for _size in ("get_abi_size", "get_abi_alignment"):
    setattr(ir.Type, _size, functools.cache(getattr(ir.Type, _size)))

# Its own declarations are looked for anew for each call of a function.
cpu.CPUContext.load_additional_registries = functools.cache(cpu.CPUContext.load_additional_registries)


class _Plain:
    """Reasons why a function does not fit, of which there are thousands, as they are: without colours."""

    def __getattr__(self, _):
        return lambda text: text


errors._termcolor_inst = _Plain()

# Who waits for LLVM is told at each call of it.
ffi.lib._lock._cblist.clear()
