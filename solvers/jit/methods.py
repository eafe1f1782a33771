"""Methods of tuples that kernels call exactly as plain Python does."""

from collections.abc import Callable
from typing import Any

import numba
from numba.core.typing.templates import infer_getattr, make_overload_method_template
from numba.extending import overload, overload_method

from .reference import Reference

PART = {"error_model": "numpy", "_nrt": False, "no_cfunc_wrapper": True}  # as other kernels that only kernels call


def _method(name: str, **options: Any) -> Callable:
    """As Numba's `overload_method`, for tuples that have such a method: a field of that name of others is one still."""

    def register(choose: Callable) -> Callable:
        template = make_overload_method_template(numba.types.BaseNamedTuple, name, choose, inline="never", **options)
        of_numba = template._resolve
        template._resolve = lambda self, kind, attribute: of_numba(self, kind, attribute) if has(kind) else None
        infer_getattr(template)
        return overload(choose, **options)(choose)

    def has(kind: numba.types.BaseNamedTuple) -> bool:
        return name not in kind.fields and hasattr(kind.instance_class, name)

    return register


# Let kernels call these methods of any contact law (a NamedTuple) exactly as plain Python does.
@_method("force")
def _force(self, indentation, rate, deepest):
    return self.instance_class.force


@_method("slopes")
def _slopes(self, indentation, rate, deepest):
    return self.instance_class.slopes


@_method("stored")
def _stored(self, indentation, deepest):
    return self.instance_class.stored


@_method("dent")
def _dent(self, deepest):
    return self.instance_class.dent


@_method("unloading")
def _unloading(self, deepest):
    return self.instance_class.unloading


@_method("corner")
def _corner(self, indentation, deepest):
    return self.instance_class.corner


@_method("mean")
def _mean(self, start, end, rate, deepest):
    return self.instance_class.mean


@_method("mean_force", jit_options={"forceinline": True})
def _mean_force(self, start, free, compliance, rate, expected, deepest, memory):
    return self.instance_class.mean_force


@_method("loading_mean")
def _loading_mean(self, start, end):
    return self.instance_class.loading_mean


@_method("unloading_mean")
def _unloading_mean(self, start, end, deepest):
    return self.instance_class.unloading_mean


# The same for any integrator (a NamedTuple).
@_method("advance")
def _advance(self, law, state):
    return self.instance_class.advance


# The same of what moves and is struck (a NamedTuple of links and joints), by reference.
@overload_method(Reference, "take_step", jit_options=PART)
def _take_step(self, w, stages, q, v, time, step, reactions):
    return self.of.instance_class.take_step


@overload_method(Reference, "joints_at", jit_options=PART)
def _joints_at(self, q, time, gap, jacobian, moving):
    return self.of.instance_class.joints_at


@overload_method(Reference, "face_at", jit_options=PART)
def _face_at(self, contact, q, place, row):
    return self.of.instance_class.face_at


@overload_method(Reference, "look", jit_options=PART)
def _look(self, w, time, coordinates, rates, count, seen):
    return self.of.instance_class.look


@overload_method(Reference, "respond", jit_options=PART)
def _respond(self, w, q, time, change):
    return self.of.instance_class.respond
