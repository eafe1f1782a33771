"""What frames fixed to a section do: that of a free rod to its end, that of a pendulum to its pivot."""

import numpy as np

from ...bodies import FlexiblePendulum, Waveguide
from ...numerics.oscillators import carried
from .motion import ModalMotion

FRAME_SAMPLES = 500  # at which the frame of a rod is watched after the contact
PIVOT_SAMPLES = 2_000  # at which the moments of a pendulum are looked at


def frame_figures(motion: ModalMotion, parting: float, struck_end: bool) -> dict[str, float | None]:
    """What a frame fixed to an end of a rod does after the contact: thesis 10.2.

    Its own velocity, which is that of its section and no velocity of the rod; and the largest stress on that end, which
    is free and has none, relative to the peak pressure of the contact: fictitious, from the clamped shapes.
    """
    rod = motion.scene.target.known_as(Waveguide)
    end = np.array([0.0 if struck_end else rod.length])
    if motion.duration <= parting + motion.pair.resolved_time:
        return {"frame_velocity": None, "fictitious_end_stress": None}
    time = np.linspace(parting, motion.duration, FRAME_SAMPLES)
    pressure = float(motion.record.contact_force.max()) / rod.area
    return {
        "frame_velocity": float(motion.velocity(time[-1:], end)[0, 0]),
        "fictitious_end_stress": float(np.abs(motion.stress(time, end)).max()) / pressure,
    }


def pivot_figures(motion: ModalMotion) -> dict[str, float]:
    """The largest bending moment at the pivot and where the bar strikes [N m], and the largest force of the pivot [N].

    A pivot bears no moment: what there is of it is fictitious, from shapes clamped there.
    Source: thesis 10.3, figures 10.11 and 10.12. Differs: (9.63) lets a deflection add to the moment of inertia, but
    not draw the bar nearer to the pivot, which takes most of it away again. Both are left out: of 5 clamped shapes
    (9.63) makes 3.9 N m out of 3.8, both together 3.7; of 10 shapes 0.88 and 0.80 out of 0.80.
    """
    modes, place = motion.pair.impactor, motion.scene.impactor.known_as(FlexiblePendulum).place
    assert modes.moments is not None and modes.shears is not None
    x = np.array([0.0, place])
    time, bent = _at_steps(motion, max(1, motion.steps // PIVOT_SAMPLES))
    smooth, q = motion.smoothed_force(time), bent[:, : motion.pair.split] / modes.at_contact
    moments, shears = (
        np.abs(q @ own(x) + np.multiply.outer(smooth, modes.left_out(name, x))).max(axis=0)
        for name, own in (("moments", modes.moments), ("shears", modes.shears))
    )
    return {
        "pivot_moment": float(moments[0]),
        "contact_moment": float(moments[1]),
        "peak_pivot_force": float(shears[0]),
    }


def _at_steps(motion: ModalMotion, stride: int) -> tuple[np.ndarray, np.ndarray]:
    """Every so many instants (instants,) [s], and at_contact * q there (instants, modes), all in one run."""
    instants, nothing = (
        np.append(np.arange(0, motion.steps, stride), motion.steps),
        np.zeros((1, motion.pair.frequencies.size)),
    )
    displacement, velocity = np.empty((2, instants.size, nothing.size))
    force = motion.record.contact_force
    carried(motion.bank, nothing, nothing, motion.steps + 1, force, instants, displacement, velocity)
    return motion.step * instants, displacement
