"""Impulses between rigid bodies with full tensors, many at once."""

import numpy as np

import solvers
from solvers.numerics.rigid.friction import rub
from solvers.numerics.rigid.impulses import kinetic_energy, point_velocity, residuals, strike
from tests.solvers.numerics.rigid.test_impulses import held, random_pairs

from .size import of
from .timing import median, row

PAIRS = 100_000


def measure() -> dict[str, object]:
    pairs = of(PAIRS, 1_000)
    first, second, normal, restitution = random_pairs(1, pairs)
    spent = median(lambda: strike(first, second, normal, restitution), 9)
    found = strike(first, second, normal, restitution)
    parting = np.vecdot(normal, point_velocity(found.second) - point_velocity(found.first))
    momentum, angular = (
        float(np.max(np.linalg.norm(gained, axis=1) / (held(first) + held(second))))
        for gained in residuals((first, second), found, normal)
    )
    scene = solvers.load("note-rod")
    friction = np.random.default_rng(2).uniform(0.0, 1.0, pairs)
    rubbing = median(lambda: rub(first, second, normal, friction, restitution), 9)
    rubbed = rub(first, second, normal, friction, restitution)
    before, after = (sum(map(kinetic_energy, pair)) for pair in ((first, second), (rubbed.first, rubbed.second)))
    return dict(
        [
            row("rigid impulses, random full tensors", pairs / spent, "a second", ">= 1e5"),
            row(
                "rigid impulses: worst miss of the restitution",
                np.abs(parting - restitution * found.approach).max(),
                "m/s",
            ),
            row("rigid impulses: worst residual of momentum", momentum, "", "<= 1e-12"),
            row("rigid impulses: worst residual of angular momentum", angular, "", "<= 1e-12"),
            row("impulses with friction, random full tensors", pairs / rubbing, "a second", ">= 1e5"),
            row("impulses with friction: most energy made, relative", (after / before - 1.0).max(), "", "<= 1e-12"),
            row("one scene of two bodies, whole solve()", 1e3 * median(lambda: solvers.solve(scene), 50), "ms"),
        ]
    )
