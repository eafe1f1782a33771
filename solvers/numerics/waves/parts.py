"""A chain of rods as nodes and what joins them: what `network` and `grid` solve."""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import inner_kernel

# what holds at a node
FREE, ABSORBING, PRESSED, BONDED, RIGID_FACES, LAW = range(6)


class Chain(NamedTuple):
    """Nodes 0 to n joined by n rods, rod i between nodes i and i + 1.

    impedance, transit, drift (rods,): Z, L / c and the velocity before the impact; kind (nodes,); mass_left, mass_right
    (nodes,): a rigid body beside the node, 0 for none, infinite for a wall; mass_drift (nodes,), its first velocity;
    gap (nodes,): between the faces before the impact; contact: the node that the impactor strikes; spring: on which the
    mass beside the last node stands, unbent before the impact, 0 for none; fall: by
    which its weight accelerates the impactor alone. All of that, left of the contact, is seen from the frame that falls
    with it.
    """

    impedance: np.ndarray
    transit: np.ndarray
    drift: np.ndarray
    kind: np.ndarray
    mass_left: np.ndarray
    mass_right: np.ndarray
    mass_drift: np.ndarray
    gap: np.ndarray
    contact: int
    spring: float = 0.0
    fall: float = 0.0


@inner_kernel
def opens(chain, node):
    """Whether faces meet at a node that can come apart."""
    return chain.kind[node] == RIGID_FACES or chain.kind[node] == LAW


@inner_kernel
def swings(chain, node):
    """Square of the frequency with which the mass beside a node swings on its spring; 0 where none does."""
    return chain.spring / chain.mass_right[node] if chain.spring > 0.0 and node == chain.kind.size - 1 else 0.0


@inner_kernel
def mobility(chain, node):
    """Of the bodies beside a node: 1 / Z summed over its rods, 1 / m over its masses."""
    rods, masses = 0.0, 0.0
    if node > 0:
        rods += 1.0 / chain.impedance[node - 1]
    if node < chain.kind.size - 1:
        rods += 1.0 / chain.impedance[node]
    for mass in (chain.mass_left[node], chain.mass_right[node]):
        if mass > 0.0:
            masses += 1.0 / mass
    return rods, masses
