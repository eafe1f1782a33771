"""Impulses between pairs of rigid bodies with dry friction, on arrays; bodies, normals and signs as in `impulses`.

Three laws of restitution. Energetic (Stronge): the normal force gives back e^2 of the work that it took, and no energy
can be made. By impulses (Poisson): e times the normal impulse of compression follows. By velocities (Newton), with the
impulse of sticking cut off at the cone of friction: one algebraic step, which can make energy.
Source: Stronge, Impact Mechanics (2000), chapters 3 to 5 and 8; thesis 11.3.2 names the subject.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from ...jit.kernels import kernel
from .impulses import Bodies, arm, inverse_inertia, point_velocity
from .sliding import COMPRESSED, COMPRESSION, FOLLOWS, FOUND, ORDER, ROWS, STOPPED, STRONGE, Felt, clamp, slide, starts

NEWTON = 2  # beside STRONGE and POISSON, which `slide` knows
NO_PATH = np.zeros((0, 4))
NO_APPROACH = 1e-14  # of the speeds that it is the difference of: a slower approach is rounding


class Rubbed(NamedTuple):
    """What an impulse with friction did to every pair; nothing where the bodies were not approaching, unless they slide
    and friction jams."""

    impulse: np.ndarray  # (..., 3), on the second body, its opposite on the first [N s]
    effective_mass: np.ndarray  # along the normal, as without friction [kg]
    approach: np.ndarray  # of the touching points along the normal [m/s]; negative: they part
    compression: np.ndarray  # normal impulse when the bodies are closest [N s]; NaN by Newton's law
    stopped: np.ndarray  # normal impulse at which the first sliding ends [N s]; infinite if it does not
    compressed: np.ndarray  # work of the normal force while the bodies come closer [J], positive
    restored: np.ndarray  # and while they part
    rubbed: np.ndarray  # lost in sliding [J]; negative where Newton's law makes energy
    follows: np.ndarray  # the first sliding: STICK or REVERSAL; SLIP if it does not end
    jams: np.ndarray  # whether friction presses the bodies closer as they slide
    steps: np.ndarray  # taken; negative where the end was not found
    first: Bodies  # afterwards
    second: Bodies

    @property
    def lost(self) -> np.ndarray:
        """Work of the normal force that is not given back [J]."""
        return self.compressed - self.restored


def felt_inverse(bodies: Bodies, inverse: np.ndarray) -> np.ndarray:
    """What a body adds to W (..., 3, 3) [1/kg]: where it is touched its velocity changes by W P; `inverse` is I^-1."""
    across = np.cross(arm(bodies)[..., None, :], np.eye(3))  # rows: c x the axes
    return across @ inverse @ np.swapaxes(across, -1, -2) + np.eye(3) / np.asarray(bodies.mass)[..., None, None]


def rub(
    first: Bodies,
    second: Bodies,
    normal: np.ndarray,
    friction: np.ndarray | float,
    restitution: np.ndarray | float,
    law: int = STRONGE,
) -> Rubbed:
    """One impulse per pair with Coulomb friction; `law` of restitution: STRONGE, POISSON or NEWTON.

    Points that slide without approaching have an impact, too, where friction exceeds `jamming_friction`: the limit of
    ever slower approach.
    Error: some 1e-12 of the impulse, beside rounding times the ratio of the eigenvalues of W.
    Raises ValueError where neither body of a pair can move.
    """
    inverses = inverse_inertia(first), inverse_inertia(second)
    contact = _contact(first, second, inverses, normal)
    shape = np.broadcast_shapes(contact.velocity.shape[:-1], np.shape(friction), np.shape(restitution))
    found = np.zeros((*shape, FOUND))
    _rub(*_in_rows(contact, shape, friction, restitution), law, NO_PATH, found.reshape(-1, FOUND))
    impulse = np.vecdot(found[..., None, :3], np.swapaxes(contact.frame, -1, -2))
    after = _pushed(first, inverses[0], -impulse), _pushed(second, inverses[1], impulse)
    columns = [found[..., column] for column in range(COMPRESSION, FOUND)]
    return Rubbed._make([impulse, 1.0 / contact.felt[..., 0], -contact.velocity[..., 0], *columns, *after])


def jamming_friction(first: Bodies, second: Bodies, normal: np.ndarray) -> np.ndarray:
    """The friction above which sliding, as it begins, presses the bodies closer: n W n / (n W s), or infinite.

    Source: Painlevé (1895), for his rod (1 + 3 cos^2 a) / (3 sin a cos a).
    """
    contact = _contact(first, second, (inverse_inertia(first), inverse_inertia(second)), normal)
    slides, coupled = contact.velocity[..., 1:], np.vecdot(contact.felt[..., 1:3], contact.velocity[..., 1:])
    with np.errstate(divide="ignore", invalid="ignore"):
        found = contact.felt[..., 0] * np.sqrt(np.vecdot(slides, slides)) / coupled
    return np.where(coupled > 0.0, found, np.inf)


def sliding_path(
    first: Bodies, second: Bodies, normal: np.ndarray, friction: float, restitution: float, law: int, points: int
) -> tuple[np.ndarray, np.ndarray]:
    """How one pair slides, from the first touch on: at most `points` rows of the normal impulse [N s] and of the
    velocity at which the touching points part [m/s], along the normal and two tangents; and these directions, as rows.

    By Newton's law, which knows no course, that of STRONGE.
    """
    contact = _contact(first, second, (inverse_inertia(first), inverse_inertia(second)), normal)
    path, found = np.full((points, 4), np.nan), np.zeros((1, FOUND))
    _rub(*_in_rows(contact, (1,), friction, restitution), STRONGE if law == NEWTON else law, path, found)
    return path[np.isfinite(path[:, 0])], contact.frame


class _Contact(NamedTuple):
    """Contacts on axes of their own."""

    frame: np.ndarray  # (..., 3, 3), rows: the normal and two tangents, along which W has no element between them
    felt: np.ndarray  # (..., 5), of W there: n n, n 1, n 2, 1 1, 2 2 [1/kg]
    velocity: np.ndarray  # (..., 3), of parting [m/s]


def _contact(first: Bodies, second: Bodies, inverses: tuple[np.ndarray, np.ndarray], normal: np.ndarray) -> _Contact:
    matrix = felt_inverse(first, inverses[0]) + felt_inverse(second, inverses[1])
    parting = point_velocity(second) - point_velocity(first)
    if not np.all(np.einsum("...ii->...", matrix) > 0.0):
        raise ValueError("both bodies of a pair are immovable")
    normal = np.asarray(normal, float)
    aside = np.eye(3)[np.argmin(np.abs(normal), axis=-1)]
    along = np.cross(normal, aside)
    along /= np.sqrt(np.vecdot(along, along))[..., None]
    across = np.cross(normal, along)
    one, two, both = _between(along, matrix, along), _between(across, matrix, across), _between(along, matrix, across)
    angle = 0.5 * np.arctan2(2.0 * both, one - two)[..., None]
    along, across = np.cos(angle) * along + np.sin(angle) * across, np.cos(angle) * across - np.sin(angle) * along
    pairs = ((normal, normal), (normal, along), (normal, across), (along, along), (across, across))
    felt = np.stack([_between(left, matrix, right) for left, right in pairs], axis=-1)
    frame = np.stack(np.broadcast_arrays(normal, along, across), axis=-2)
    velocity = np.vecdot(frame, parting[..., None, :])
    rounding = NO_APPROACH * sum(_speed(body) for body in (first, second))
    velocity[..., 0] = np.where(np.abs(velocity[..., 0]) <= rounding, 0.0, velocity[..., 0])
    return _Contact(frame, felt, velocity)


def _speed(body: Bodies) -> np.ndarray:
    """Of the centre, and about it where the body is touched [m/s]."""
    size = np.linalg.norm
    return size(body.velocity, axis=-1) + size(arm(body), axis=-1) * size(body.spin, axis=-1)


def _between(left: np.ndarray, matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    return np.vecdot(left, (matrix @ right[..., None])[..., 0])


def _in_rows(contact: _Contact, shape: tuple[int, ...], friction: Any, restitution: Any) -> list[np.ndarray]:
    """What `_rub` takes: one row a pair."""
    rows = [np.broadcast_to(each, (*shape, each.shape[-1])).reshape(-1, each.shape[-1]) for each in contact[1:]]
    rows += [np.broadcast_to(np.asarray(each, float), shape).reshape(-1) for each in (friction, restitution)]
    return [np.array(each, order="C") for each in rows] + [np.empty((ROWS, ORDER + 1))]


def _pushed(bodies: Bodies, inverse: np.ndarray, impulse: np.ndarray) -> Bodies:
    """The body after an impulse P (..., 3): dv = P / m, dw = -I^-1 (c x P)."""
    turn = (inverse @ np.cross(arm(bodies), impulse)[..., None])[..., 0]
    velocity = bodies.velocity + impulse / np.asarray(bodies.mass, float)[..., None]
    return bodies._replace(velocity=velocity, spin=bodies.spin - turn)


@kernel
def _rub(felt, velocity, friction, restitution, series, law, path, found):
    """Every pair, in units of its first velocity and of n . W n; `path` is that of the last."""
    for i in range(len(felt)):
        k, w = felt[i, 0], velocity[i]
        size = math.sqrt(w[0] ** 2 + w[1] ** 2 + w[2] ** 2)
        scaled = Felt(felt[i, 1] / k, felt[i, 2] / k, felt[i, 3] / k, felt[i, 4] / k, friction[i], restitution[i], law)
        if not starts(scaled, w):
            found[i, STOPPED] = math.inf
            continue
        for j in range(3):
            w[j] /= size
        points = 0
        if law == NEWTON:
            clamp(scaled, w, found[i])
        else:
            points = slide(scaled, w, series, path, found[i])
        for j in range(FOLLOWS):
            found[i, j] *= size / k if j < COMPRESSED else size * size / k
        for j in range(points):
            path[j, 0] *= size / k
            for column in range(1, 4):
                path[j, column] *= size
