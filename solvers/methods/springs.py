"""Structures that bend in one shape only, the static one under the impact: a spring that carries some of their mass."""

import math
from collections.abc import Callable
from functools import lru_cache, singledispatch
from typing import NamedTuple

import numpy as np

from ..bodies import AnyBody, Bending, Rod, SpringMass
from ..numerics.beams.statics import rigid_motion, static_shape
from ..numerics.quadrature import gauss
from ..numerics.single_degree import Response, half_swing, straight
from ..solution.sampled_motion import ShapeField


class Spring(NamedTuple):
    """A body that bends by `bent`, the displacement of the struck place against its motion as a whole.

    whole_mass: that moves on as a whole, infinite if none does; rigid_mean, mean: of the motion as a whole and of the
    bent shape over the mass, each 1 where it is struck. field: of (response, position as a whole, its rate), if any.
    """

    stiffness: float  # [N/m]
    carried: float  # [kg]
    whole_mass: float = math.inf
    mean: float = 1.0
    rigid_mean: float = 1.0
    field: Callable[[Response, np.ndarray, np.ndarray], ShapeField] | None = None

    def half_swing(self, mass: float) -> float:
        """Half a period [s] with this mass on it [kg]."""
        reduced = 1.0 / (1.0 / mass + 1.0 / self.whole_mass)
        return half_swing(reduced, self.carried, self.stiffness)


@singledispatch
def spring_of(target: AnyBody) -> Spring:
    """Of a body that bends as a spring, see `is_spring`; a kind of its own shape registers here."""
    raise TypeError(f"a {target.kind} is no spring")


def is_spring(body: AnyBody) -> bool:
    """Whether the body is known as a spring."""
    known = spring_of.dispatch(type(body)) is not spring_of.dispatch(AnyBody)
    return known and (body.fixed or body.bends)


@spring_of.register
def _(target: SpringMass) -> Spring:
    return Spring(target.stiffness, target.mass)


@spring_of.register
def _(target: Rod) -> Spring:
    """Which carries a third of its mass. Source: thesis (3.18)."""
    return Spring(target.stiffness, target.mass / 3.0, mean=0.5, field=_straight(target))


@spring_of.register
def _(target: Bending) -> Spring:
    """Source: thesis (8.13)."""
    return _bent_beam(target)


def _straight(rod: Rod) -> Callable[[Response, np.ndarray, np.ndarray], ShapeField]:
    def shapes(x):
        return straight(x / rod.length)[None, :]

    def slopes(x):
        return np.full((1, x.size), -1.0 / rod.length)

    return lambda response, *_: ShapeField(
        response.time, response.bent[:, None], response.bent_rate[:, None], shapes, slopes, rod.material.young
    )


@lru_cache(maxsize=64)  # asked for several times in a solve, and again when a slider of the impactor moves
def _bent_beam(beam: Bending) -> Spring:
    """Static shape of the beam under the impact, held by its supports or by its own inertia.

    At the tip of a cantilever 3 E I / L^3 and 33/140 of the mass, in the middle of a beam on two pins 48 E I / L^3 and
    17/35. Differs: thesis 8.4.3 leaves the mass of the beam out.
    """
    line, place = beam.line, beam.place
    shape, whole = static_shape(line, beam.support, place), rigid_motion(line, beam.support, place)
    nodes, weights = gauss(8)  # exact for the squares of these polynomials
    halves = [(0.5 * place, 0.5 * place), (0.5 * (beam.length + place), 0.5 * (beam.length - place))]
    x = np.concatenate([middle + half * nodes for middle, half in halves])
    weights = np.concatenate([half * weights for _, half in halves])
    bent = shape.deflections(x) / shape.compliance
    turned = (shape.slopes(x) + shape.shears(x) / line.shear_stiffness) / shape.compliance
    tip = float(shape.deflections(np.array([beam.length]))[0]) / shape.compliance
    carried = float(weights @ (line.mass_per_length * bent**2 + line.rotary_inertia * turned**2))
    mean = (line.mass_per_length * float(weights @ bent) + beam.end_mass * tip) / beam.mass

    def shapes(x):
        free = np.zeros_like(x) if beam.fixed else whole.shape(x)
        return np.stack((shape.deflections(x) / shape.compliance, free, np.ones_like(x)))

    def resultant(of):
        return lambda x: np.stack((of(x) / shape.compliance, np.zeros_like(x), np.zeros_like(x)))

    def field(response, moved, rate):
        drift = beam.velocity
        coordinates = np.stack((response.bent, moved, drift * response.time), axis=1)
        rates = np.stack((response.bent_rate, rate, np.full_like(rate, drift)), axis=1)
        moments, fibre = resultant(shape.moments), beam.half_depth / beam.second_moment
        return ShapeField(response.time, coordinates, rates, shapes, moments, fibre, moments, resultant(shape.shears))

    rigid_mean = 1.0 if beam.fixed else float(whole.shape(np.array([0.5 * beam.length]))[0])
    return Spring(1.0 / shape.compliance, carried + beam.end_mass * tip**2, whole.mass, mean, rigid_mean, field)
