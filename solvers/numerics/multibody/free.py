"""A linkage, rigid or flexible, that nothing strikes: its constraints and steps, asked from Python."""

from ...jit.kernels import kernel
from ...jit.reference import refer


@kernel
def joints_at(linkage, q, time, gap, jacobian, moving):
    """Writes how far the constraints are from being met, (constraints,), their Jacobian (constraints, size) and the
    rates at which they move by themselves, (constraints,)."""
    refer(linkage).joints_at(q, time, gap, jacobian, moving)


@kernel
def look(linkage, w, time, coordinates, rates, seen):
    """Writes what is seen at instants (instants,) of coordinates and rates (instants, size)."""
    refer(linkage).look(refer(w), time, coordinates, rates, time.size, refer(seen))


@kernel
def step_on(linkage, w, stages, q, v, time, step, reactions):
    """One step in place, in these stages, see `moving.STAGES`; adds the impulses of the constraints to `reactions`."""
    refer(linkage).take_step(refer(w), stages, q, v, time, step, reactions)
