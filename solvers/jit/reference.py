"""Tuples by reference, for kernels."""

import numba
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.imputils import impl_ret_borrowed, lower_getattr_generic
from numba.core.typing.templates import AttributeTemplate
from numba.extending import infer_getattr, intrinsic, models, register_model


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


if numba.config.DISABLE_JIT:
    refer = lambda given: given  # noqa: E731
