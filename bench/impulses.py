"""Impulses between rigid bodies with full tensors, many at once."""

import numpy as np

import solvers
from solvers.numerics.rigid.impulses import point_velocity, residuals, strike
from tests.solvers.numerics.rigid.test_impulses import held, random_pairs

from .timing import median, row

PAIRS = 100_000


def measure() -> dict[str, object]:
    first, second, normal, restitution = random_pairs(1, PAIRS)
    spent = median(lambda: strike(first, second, normal, restitution), 9)
    found = strike(first, second, normal, restitution)
    parting = np.vecdot(normal, point_velocity(found.second) - point_velocity(found.first))
    momentum, angular = (
        float(np.max(np.linalg.norm(gained, axis=1) / (held(first) + held(second))))
        for gained in residuals((first, second), found, normal)
    )
    scene = solvers.load("note-rod")
    return dict(
        [
            row("rigid impulses, random full tensors", PAIRS / spent, "a second", ">= 1e5"),
            row(
                "rigid impulses: worst miss of the restitution",
                np.abs(parting - restitution * found.approach).max(),
                "m/s",
            ),
            row("rigid impulses: worst residual of momentum", momentum, "", "<= 1e-12"),
            row("rigid impulses: worst residual of angular momentum", angular, "", "<= 1e-12"),
            row("one scene of two bodies, whole solve()", 1e3 * median(lambda: solvers.solve(scene), 50), "ms"),
        ]
    )
