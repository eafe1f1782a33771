"""A mass on a fixed rod that bends as a spring does, for the browser."""

from numba import carray

from solvers.numerics import spring_drawn
from solvers.numerics.single_degree import LONGEST_FLIGHT, SAMPLES, Response, half_swing, instants_of
from solvers.numerics.waves.drawn import NO_ROOM

from .entry import INSTANTS, Entry

ROOM = int((1.0 + LONGEST_FLIGHT) * SAMPLES) + 3  # of instants
FEW, PLACES = 110, 31  # of the fields, as `app.messages.axial` has them
FORCES = SAMPLES + 3


def spring(
    striker, carried, stiffness, duration, response, mass, end, force_time, force, stress, velocity, displacement, out
):  # fmt: skip
    """`solvers.numerics.spring_drawn.answer`, in units T, v and Z v.

    carried: what goes with the end of the spring; duration [T], in which the bodies part.
    """
    parting = half_swing(striker, carried, stiffness)
    n = instants_of(parting, duration, 1.0)
    if n > ROOM or parting >= duration:
        return NO_ROOM
    r, fields = carray(response, (7, n)), (FEW, PLACES)
    drawn = spring_drawn.Drawn(
        carray(mass, (INSTANTS,)), carray(end, (INSTANTS,)), carray(force_time, (FORCES,)), carray(force, (FORCES,)),
        carray(stress, fields), carray(velocity, fields), carray(displacement, fields),
    )  # fmt: skip
    solved = Response(r[0], r[1], r[2], r[3], r[4], r[5], r[6])
    columns = carray(out, (spring_drawn.COLUMNS,))
    return spring_drawn.answer(striker, carried, stiffness, parting, duration, solved, drawn, columns)


SPRING_ENTRIES = {
    "spring": Entry(
        spring,
        4,
        {
            "response": 7 * ROOM,
            "mass": INSTANTS,
            "end": INSTANTS,
            "forceTime": FORCES,
            "force": FORCES,
            "stress": FEW * PLACES,
            "velocity": FEW * PLACES,
            "displacement": FEW * PLACES,
            "out": spring_drawn.COLUMNS,
        },
        {},
        {
            "impulse": spring_drawn.IMPULSE,
            "final": spring_drawn.FINAL,
            "apart": spring_drawn.APART,
            "compressing": spring_drawn.COMPRESSING,
            "energy": spring_drawn.STRUCK,
            "dissipated": spring_drawn.DISSIPATED,
            "parting": spring_drawn.END,
            "peak": spring_drawn.PEAK,
            "atOnce": spring_drawn.AT_ONCE,
            "root": spring_drawn.ROOT,
            "steps": spring_drawn.STEPS,
        },
    ),
}
