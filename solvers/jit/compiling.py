"""How Numba is let compile: by whom, and no more than is needed."""

import gc
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from numba.core import codegen, event
from numba.core.environment import lookup_environment


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
        if getattr(_thread, "only_compiled", False):  # then too the end is told
            raise NotCompiled(compilation.data["dispatcher"].py_func.__qualname__)

    def on_end(self, compilation):
        self._depth -= 1
        if not self._depth and self._collecting:
            gc.enable()


event.register("numba:compile", _Compiling())


class _Library(codegen.JITCodeLibrary):
    """Code of a function that becomes machine code when that is asked for.

    Numba optimises each function, with all those it calls, and makes machine code of them, also of what is only ever
    part of another function: so of what is deep in a tree of calls many times, most of the time that compiling takes.
    """

    _asked = False

    def _optimize_final_module(self):
        if self._asked:
            super()._optimize_final_module()

    def _finalize_final_module(self):
        if self._asked or getattr(self, "_compiled_object", None) is not None:  # the latter: from the cache
            self._asked = True
            super()._finalize_final_module()
        else:
            self._finalize_dynamic_globals()
            self._finalized = True

    def get_pointer_to_function(self, name):
        self._ensure_finalized()
        if not self._asked and name in (function.name for function in self.get_defined_functions()):
            self._asked = True
            self._optimize_final_module()
            super()._finalize_final_module()
            for variable in self._final_module.global_variables:
                known = lookup_environment(variable.name)
                if known is not None:
                    self.codegen.set_env(variable.name, known)
        return super().get_pointer_to_function(name)

    def serialize_using_object_code(self):
        return super().serialize_using_object_code() if self._asked else self.serialize_using_bitcode()


def _set_environment(self, name, environment, of_numba=codegen.JITCPUCodegen.set_env):
    if self._engine.is_symbol_defined(name):
        of_numba(self, name, environment)


codegen.JITCPUCodegen._library_class = _Library
codegen.JITCPUCodegen.set_env = _set_environment
