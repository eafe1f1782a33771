"""A beam that turns about a pin, described in a frame that is clamped to its section there."""

import numpy as np

from ..modes import Modes
from .dispersion import BeamLine
from .modes import beam_modes
from .statics import rigid_motion, static_shape


def clamped_frame_modes(line: BeamLine, place: float, count: int) -> Modes:
    """Of a beam on a pin at x = 0, struck at `place` [m]: a frame fixed to its section at the pin turns with it, and in
    that frame the beam bends by `count` shapes of a cantilever.

    Frame and shapes are coupled by the moment of momentum of each shape about the pin, c_i = M_i(0) / omega_i^2 for
    shapes of unit mass. Taken apart they are the turning of the beam as a whole, theta' + sum c_i p_i' / I0, (10.13),
    which no inner force changes, and as many oscillators. The angle of the frame is the slope of the shapes at x = 0.
    Error: frequencies and motion converge to those of the pinned beam; the moment at the pin, which is none in truth,
    stays as large as the clamp makes it and falls with 1 / count only.
    Source: thesis 9.5, (9.43)-(9.63), without the terms of second order in the deflection, of which (9.63) has one half
    only and the other all but cancels it; 10.3.
    Differs: (9.51), (9.57) print first derivatives where the second ones belong, (9.59) divides by L_t once too often.
    """
    from scipy.linalg import eigh

    cantilever = beam_modes(line, "cantilever", place, count)
    assert cantilever.moments is not None and cantilever.shears is not None and cantilever.means is not None
    moments, shears = cantilever.moments, cantilever.shears
    whole = rigid_motion(line, "pinned-free", place)
    inertia = whole.mass * place**2  # about the pin
    coupling = moments(np.zeros(1))[:, 0] / cantilever.frequencies**2
    turning = coupling / inertia
    scaled = 1.0 / cantilever.frequencies
    periods, vectors = eigh(np.multiply.outer(scaled, scaled) * (np.eye(count) - np.multiply.outer(coupling, turning)))
    frequencies = 1.0 / np.sqrt(periods[::-1])
    rows = (scaled[:, None] * vectors[:, ::-1]).T * frequencies[:, None]  # coordinates of unit mass, (modes, shapes)

    def shapes(x):
        return rows @ (cantilever.shapes(x) - np.multiply.outer(turning, np.asarray(x, float)))

    at_contact = shapes(np.array([place]))[:, 0]
    static = static_shape(line, "pinned-free", place)
    return Modes(
        frequencies=frequencies,
        at_contact=at_contact,
        rigid_mass=whole.mass,
        residual_compliance=max(static.compliance - float(np.sum((at_contact / frequencies) ** 2)), 0.0),
        shapes=shapes,
        slopes=lambda x: rows @ (cantilever.slopes(x) - turning[:, None]),
        rigid_shape=whole.shape,
        means=rows @ (cantilever.means - 0.5 * line.length * turning),
        rigid_mean=whole.start + 0.5 * line.length * whole.slope,
        moments=lambda x: rows @ moments(x),
        shears=lambda x: rows @ shears(x),
        static_shapes=static.deflections,
        static_moments=static.moments,
        static_shears=static.shears,
    )
