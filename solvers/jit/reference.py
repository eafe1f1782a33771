"""Tuples by reference, for kernels."""

import logging
from functools import cache
from typing import Any, NamedTuple

import numba
import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.imputils import impl_ret_borrowed, lower_getattr_generic
from numba.core.registry import cpu_target
from numba.core.typing.templates import AttributeTemplate
from numba.extending import NativeValue, infer_getattr, intrinsic, models, register_model, unbox

log = logging.getLogger("strikewave")


class Reference(types.Type):
    """A tuple of arrays by its place in memory, for as long as the kernel runs that was given it.

    As a value a tuple is all of its fields in every call: one of fifty arrays is compiled for seconds by each kernel
    that takes it. Fields that are tuples are references too.
    """

    def __init__(self, of: types.BaseNamedTuple):
        self.of = of
        super().__init__(name=f"Reference({of})")

    def field(self, name: str) -> types.Type:
        found = self.of.types[self.of.fields.index(name)]
        return Reference(found) if isinstance(found, types.BaseNamedTuple) else found


@register_model(Reference)
class _Place(models.PrimitiveModel):
    def __init__(self, manager, reference):
        super().__init__(manager, reference, manager.lookup(reference.of).get_value_type().as_pointer())


@infer_getattr
class _FieldTypes(AttributeTemplate):
    key = Reference

    def generic_resolve(self, typ, attr):
        return typ.field(attr) if attr in typ.of.fields else None


@lower_getattr_generic(Reference)
def _field(context, builder, typ, value, attr):
    index = typ.of.fields.index(attr)
    place = builder.gep(value, [ir.Constant(ir.IntType(32), each) for each in (0, index)], inbounds=True)
    kind = typ.field(attr)
    return place if isinstance(kind, Reference) else impl_ret_borrowed(context, builder, kind, builder.load(place))


@intrinsic
def refer(typing, given):
    """A tuple by reference, for the kernels that this one calls; see `Reference`. None stays None."""

    if isinstance(given, (Reference, types.NoneType)):
        return given(given), lambda context, builder, signature, arguments: arguments[0]

    def build(context, builder, signature, arguments):
        return cgutils.alloca_once_value(builder, arguments[0])

    return Reference(given)(given), build


ARRAY_FIELDS = "meminfo", "parent", "nitems", "itemsize", "data", "shape", "strides"


class Referred:
    """A tuple laid out in memory as kernels see it, for one that takes it by reference; see `referred`."""

    def __init__(self, given: NamedTuple, kind: Reference):
        self._given, self._memory = given, np.array(_words(given), np.int64)
        self._numba_type_ = kind
        self.address = self._memory.ctypes.data


def _words(given: Any) -> list[int]:
    """The words of eight bytes of a value in memory; of an array no counter and no owner, then what it is."""
    if isinstance(given, np.ndarray):
        return [0, 0, given.size, given.itemsize, given.ctypes.data, *given.shape, *given.strides]
    if isinstance(given, tuple):
        return [word for each in given for word in _words(each)]
    return [int(np.array(given, _form(given)).view(np.int64))]


def _form(given: Any) -> Any:
    """All that tells the type of a value, as a key: Numba takes 5 us an array to find it."""
    if isinstance(given, np.ndarray):
        return given.dtype, given.ndim, given.flags.c_contiguous, given.flags.writeable
    if isinstance(given, tuple):
        return type(given), *map(_form, given)
    return float if isinstance(given, float | np.floating) else int


@cache
def _type_of(form: Any) -> Reference | None:
    """None where this Numba lays such a tuple out in another way than `_words` does."""
    kind = _type(form)
    if _laid_out(kind):
        return Reference(kind)
    log.warning("kernels of links take longer to compile: Numba %s lays arrays out in another way", numba.__version__)
    return None


def _laid_out(kind: types.Type) -> bool:
    """Whether Numba's own description of a value is that of `_words`: these fields in this order, of eight bytes."""
    context = cpu_target.target_context
    model = context.data_model_manager.lookup(kind)
    if isinstance(kind, types.BaseTuple):
        return model.field_count == len(kind.types) and all(map(_laid_out, kind.types))
    if isinstance(kind, types.Array):
        words, fields = 5 + 2 * kind.ndim, tuple(model._fields)
    else:
        words, fields = 1, ARRAY_FIELDS
    return fields == ARRAY_FIELDS and context.get_abi_sizeof(context.get_value_type(kind)) == 8 * words


def _type(form: Any) -> types.Type:
    if isinstance(form, type):
        return {int: types.int64, float: types.float64}[form]
    if isinstance(form[0], np.dtype):
        dtype, dimensions, contiguous, writeable = form
        return types.Array(numba.from_dtype(dtype), dimensions, "C" if contiguous else "A", readonly=not writeable)
    kind, *fields = form
    return types.NamedTuple([_type(each) for each in fields], kind)


@unbox(Reference)
def _place_of(typ, given, c):
    number = c.pyapi.object_getattr_string(given, "address")
    place = c.pyapi.long_as_voidptr(number)
    c.pyapi.decref(number)
    return NativeValue(c.builder.bitcast(place, c.context.get_value_type(typ)))


def referred(given: Any) -> Any:
    """A tuple of arrays and numbers by reference already where a kernel is called, which then need not be compiled to
    take it apart: half a second for a hundred arrays. It costs 1.5 us an array at each call; for kernels that run
    longer. None stays None."""
    if given is None or numba.config.DISABLE_JIT:
        return given
    kind = _type_of(_form(given))
    return given if kind is None else Referred(given, kind)


if numba.config.DISABLE_JIT:
    refer = lambda given: given  # noqa: E731
