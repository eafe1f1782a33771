"""Finite elements: what a node costs per step."""

import numpy as np

import solvers
from solvers.contact import Linear
from solvers.jit.kernels import kernel
from solvers.numerics.elements import newmark
from solvers.numerics.elements.line import highest_frequency, line
from solvers.numerics.elements.mesh import CONSISTENT, LUMPED
from solvers.numerics.law_functions import stepped

from .timing import paired_medians, row

NODES, STEPS = 1000, 2000
BEAM_STEP = 1e-8  # [s]


@kernel
def bare_explicit(gain, spring, u, v, step, steps):
    """The floor of an explicit step: the same arrays read and written, without a neighbour's pull."""
    for _ in range(steps):
        for i in range(1, u.size):
            v[i] += gain[i] * spring[i] * u[i]
        for i in range(u.size):
            u[i] += step * v[i]


def measure() -> dict[str, object]:
    scene = solvers.load("fixed-rod")
    law = Linear(scene.target.mesh(NODES).neighbour)
    meshes = {share: line(scene.impactor.mesh(1), scene.target.mesh(NODES, share)) for share in (CONSISTENT, LUMPED)}
    explicit_step = 1.6 / highest_frequency(meshes[LUMPED], law.stiffness)
    explicit = newmark.explicit(meshes[LUMPED], explicit_step)
    implicit = newmark.newmark(meshes[CONSISTENT], explicit_step)
    u, v = np.zeros(NODES + 1), np.zeros(NODES + 1)
    record = newmark.record(STEPS, STEPS, NODES + 1)

    of_law = stepped(law)

    def started():
        u[:], v[:] = 0.0, 0.0
        v[0] = 1.0

    def floor():
        started()
        bare_explicit(explicit.gain, explicit.spring, u, v, explicit_step, STEPS)

    def explicit_run():
        started()
        newmark.march_explicit(*of_law[1:], False, explicit, 0.0, explicit_step, u, v, STEPS, 0, STEPS, record)

    def implicit_run():
        started()
        still = implicit.wholes.still()
        newmark.march_implicit(*of_law, implicit, 0.0, explicit_step, u, v, still, STEPS, 0, STEPS, record)

    beam = line(scene.impactor.mesh(1), solvers.load("figure-8.9").target.mesh(NODES))
    bent, turned = np.zeros(beam.mass.shape[1]), np.zeros(beam.mass.shape[1])
    bending, of_beam = newmark.newmark(beam, BEAM_STEP), newmark.record(STEPS, STEPS, bent.size)

    def beam_run():
        bent[:], turned[:] = 0.0, 0.0
        turned[0] = 1.0
        still = bending.wholes.still()
        newmark.march_implicit(*of_law, bending, 0.0, BEAM_STEP, bent, turned, still, STEPS, 0, STEPS, of_beam)

    unit = 1e9 / (NODES * STEPS)
    bare, full, _ = paired_medians(floor, explicit_run, 15)
    _, steady, _ = paired_medians(floor, implicit_run, 15)
    _, beams, _ = paired_medians(floor, beam_run, 15)
    rows = [
        row("explicit step, per node", full * unit, "ns"),
        row("explicit step, per node, beyond the bare loop", (full - bare) * unit, "ns", "<= 0.6"),
        row("Newmark step, per node", steady * unit, "ns"),
        row("Newmark step of a beam, per node", beams * unit, "ns"),
    ]
    return dict(rows)
