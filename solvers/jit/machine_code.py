"""Machine code only of what is called from outside of kernels: a part of the shortcuts."""

from typing import Any

from numba.core import codegen
from numba.core.environment import lookup_environment


class Library(codegen.JITCodeLibrary):
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


def unoptimised(payload: Any) -> bool:
    """Whether what the cache holds of a function is the code that this leaves to be optimised when it is asked for."""
    (_, form, _), *_ = payload
    return form == "bitcode"


def set_environment(self, name, environment, of_numba=codegen.JITCPUCodegen.set_env):
    """In place of the code's own: of a function that has no machine code there is none to set."""
    if self._engine.is_symbol_defined(name):
        of_numba(self, name, environment)
