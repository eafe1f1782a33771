"""Instantaneous impulses between pairs of rigid bodies, on arrays: the last axes are vectors (3) and tensors (3, 3).

A pair touches at one point with a unit normal n from the first body to the second, without friction. Positions are
given by c = centre of mass - contact point, so that a body moves at v + c x w where it is touched.
Source: note on rigid-body impulses, 1/mu = 1/m1 + 1/m2 + sum (c x n)^T I^-1 (c x n) and J = (1 + e) mu v_imp.
Differs: the note prints I^-1 c x J n without parentheses; read from left to right it is wrong. It is I^-1 (c x J n).
"""

from typing import Any, NamedTuple

import numpy as np

NULL_MOMENT = 1e-12  # of the largest: a smaller principal moment is zero to rounding (a thin rod about its axis)
STRAY_COUPLE = 1e-9  # of the arm: a smaller couple about an axis without moment of inertia is rounding


class Bodies(NamedTuple):
    """The first or the second body of every pair; leading axes may be any that broadcast.

    A body of infinite mass does not move, whatever its inertia; one without inertia is a point that does not turn.
    """

    mass: np.ndarray  # m [kg]
    inertia: np.ndarray  # I [kg m2], (3, 3), at the centre of mass, in world axes
    centre: np.ndarray  # c [m], (3,), from the contact point
    velocity: np.ndarray  # v [m/s], (3,), of the centre of mass
    spin: np.ndarray  # w [rad/s], (3,)


class Strike(NamedTuple):
    """What an impulse did to every pair; nothing where the bodies were not approaching."""

    impulse: np.ndarray  # J [N s], on the second body along the normal, its opposite on the first
    effective_mass: np.ndarray  # mu [kg]
    approach: np.ndarray  # v_imp [m/s], of the touching points along the normal; negative: they part
    lost: np.ndarray  # [J]
    first: Bodies  # afterwards
    second: Bodies


def principal(inertia: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Principal moments [kg m2], ascending, zero where they are so to rounding; and their axes as columns (3, 3)."""
    moments, axes = np.linalg.eigh(inertia)
    return np.where(moments > NULL_MOMENT * moments[..., -1:], moments, 0.0), axes


def point_velocity(bodies: Bodies) -> np.ndarray:
    """Velocity [m/s] of each body where it is touched."""
    return bodies.velocity + np.cross(arm(bodies), bodies.spin)


def strike(first: Bodies, second: Bodies, normal: np.ndarray, restitution: np.ndarray | float) -> Strike:
    """One frictionless impulse per pair, after which the touching points part at `restitution` times their approach.

    Error: rounding times the ratio of the principal moments. Cost: about 4 us a pair, in two eigen-decompositions.
    Raises ValueError where neither body of a pair can move, and where a body is struck beside an axis about which it
    has no moment of inertia, though it has one about another: it would turn about that axis without resisting.
    """
    normal = np.asarray(normal, float)
    turns, stray = zip(*(_solved(bodies, normal) for bodies in (first, second)), strict=True)
    if np.any(stray[0]) or np.any(stray[1]):
        raise ValueError("a body is struck beside an axis about which it has no moment of inertia")
    softness: Any = sum(
        1.0 / np.asarray(bodies.mass, float) + np.vecdot(np.cross(arm(bodies), normal), turn)
        for bodies, turn in zip((first, second), turns, strict=True)
    )
    if not np.all(softness > 0.0):
        raise ValueError("both bodies of a pair are immovable")
    approach = np.vecdot(normal, point_velocity(first) - point_velocity(second))
    closing = np.maximum(approach, 0.0)
    impulse = (1.0 + restitution) * closing / softness
    after = [
        _pushed(bodies, turn, way * impulse, normal)
        for bodies, turn, way in zip((first, second), turns, (-1.0, 1.0), strict=True)
    ]
    lost = 0.5 * (1.0 - np.square(restitution)) * closing**2 / softness
    return Strike(impulse, 1.0 / softness, approach, lost, *after)


def residuals(
    before: tuple[Bodies, Bodies], found: Strike, normal: np.ndarray, about: np.ndarray | float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """What the pairs gained of momentum [kg m/s] and of angular momentum [kg m2/s] about a point fixed in space.

    Both (..., 3), and zero but for rounding. `about`: from the contact point [m]. An immovable body takes what
    the impulse gives it.
    """
    return gained(before, (found.first, found.second), found.impulse[..., None] * normal, about)


def gained(
    before: tuple[Bodies, Bodies],
    after: tuple[Bodies, Bodies],
    impulse: np.ndarray,
    about: np.ndarray | float = 0.0,
) -> tuple[np.ndarray, np.ndarray]:
    """The same for any impulse (..., 3) on the second body, its opposite on the first [N s]."""
    momentum, angular = np.zeros(3), np.zeros(3)
    for old, new, way in zip(before, after, (-1.0, 1.0), strict=True):
        held = np.isinf(old.mass)[..., None]
        given = way * impulse
        mass = np.where(np.isinf(old.mass), 0.0, old.mass)[..., None]
        change = np.where(held, given, mass * (new.velocity - old.velocity))
        turned = _times(old.inertia, new.spin - old.spin)
        place = np.where(held, 0.0, arm(old))
        momentum = momentum + change
        angular = angular + np.cross(place - about, change) + np.where(held, 0.0, turned)
    return momentum, angular


def kinetic_energy(bodies: Bodies) -> np.ndarray:
    """Of translation and rotation [J]; 0 for a body that does not move."""
    mass = np.where(np.isinf(bodies.mass), 0.0, bodies.mass)
    moving = np.where(np.isinf(bodies.mass), 0.0, np.vecdot(bodies.spin, _times(bodies.inertia, bodies.spin)))
    return 0.5 * mass * np.vecdot(bodies.velocity, bodies.velocity) + 0.5 * moving


def unresisted(bodies: Bodies, normal: np.ndarray) -> np.ndarray:
    """Whether a body would turn about an axis about which it has no moment of inertia, though it has one elsewhere."""
    return _solved(bodies, normal)[1]


def arm(bodies: Bodies) -> np.ndarray:
    """c, and zero for a point mass: it is where it is touched."""
    return np.where(np.any(bodies.inertia, axis=(-2, -1))[..., None], bodies.centre, 0.0)


def inverse_inertia(bodies: Bodies) -> np.ndarray:
    """I^-1 (..., 3, 3) [1/(kg m2)] in the range of the tensor, zero elsewhere and for a body that does not move."""
    inverse, axes, _ = _inverted(bodies)
    return (axes * inverse[..., None, :]) @ np.swapaxes(axes, -1, -2)


def _inverted(bodies: Bodies) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """1 / principal moments, their axes as columns, and about which of them nothing resists."""
    moments, axes = principal(bodies.inertia)
    held = np.isinf(bodies.mass)[..., None]
    weightless = (moments == 0.0) & ~held
    return np.where(weightless | held, 0.0, 1.0 / np.where(moments > 0.0, moments, 1.0)), axes, weightless


def _solved(bodies: Bodies, normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """I^-1 (c x n) [rad/s per N s] in the range of the tensor, and whether c x n leaves that range."""
    c = arm(bodies)
    inverse, axes, weightless = _inverted(bodies)
    couple = _times(np.swapaxes(axes, -1, -2), np.cross(c, normal))
    stray = weightless & (np.abs(couple) > STRAY_COUPLE * np.sqrt(np.vecdot(c, c))[..., None])
    return _times(axes, inverse * couple), stray.any(axis=-1)


def _pushed(bodies: Bodies, turn: np.ndarray, impulse: np.ndarray, normal: np.ndarray) -> Bodies:
    """The body after `impulse` along the normal: P = impulse n, dv = P / m, dw = -I^-1 (c x P)."""
    speed = (impulse / np.asarray(bodies.mass, float))[..., None]
    velocity, spin = bodies.velocity + speed * normal, bodies.spin - impulse[..., None] * turn
    return bodies._replace(velocity=velocity, spin=spin)


def _times(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    return (matrix @ vector[..., None])[..., 0]
