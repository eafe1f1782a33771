"""Methods of tuples that kernels call exactly as plain Python does."""

import numba
from numba.extending import overload_method

from .reference import Reference

PART = {"error_model": "numpy", "_nrt": False, "no_cfunc_wrapper": True}  # as other kernels that only kernels call


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


@overload_method(numba.types.BaseNamedTuple, "unloading")
def _unloading(self, deepest):
    return self.instance_class.unloading


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
