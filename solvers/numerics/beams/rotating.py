"""A slender beam that turns at a constant speed about an axis through its root, bending in the plane of rotation.

v_tt + (E I / rho A) v'''' - (Omega^2 / 2) ((L^2 - x^2) v')' - Omega^2 v = 0: the centrifugal force pulls the beam
straight, and pushes what is off the radius farther out. Both are of one order, and the first is the larger.
Source: thesis 5.6. Differs: (5.55) leaves the first out, so that (5.56) falls to zero where the beam is stiffest.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..modes import Modes
from ..quadrature import gauss
from .dispersion import BeamLine

SPARE = 24  # polynomials beyond the modes asked for, of which the higher ones are not yet exact
SPREAD = 2  # polynomials for each mode


class Bent(NamedTuple):
    """Deflections of the beam of unit length whose curvatures are Legendre's polynomials, of unit norm: clamped at 0.

    By these the bending stiffness is the unit matrix, so that low frequencies do not suffer from high ones.
    """

    degree: int  # how many

    def at(self, x: np.ndarray) -> np.ndarray:
        """Deflections, slopes, curvatures and their slopes, (4, degree, x)."""
        t = 2.0 * np.asarray(x, float) - 1.0
        count = self.degree + 2
        legendre = np.zeros((count + 1, t.size))
        slope = np.zeros((count + 1, t.size))
        legendre[0], legendre[1], slope[1] = 1.0, t, 1.0
        for n in range(1, count):
            legendre[n + 1] = ((2 * n + 1) * t * legendre[n] - n * legendre[n - 1]) / (n + 1)
            slope[n + 1] = slope[n - 1] + (2 * n + 1) * legendre[n]
        once = _integrated(legendre)
        twice = np.vstack((0.5 * (t + 1.0) ** 2, _of_difference(once))) if count > 1 else once
        norms = np.sqrt(2.0 * np.arange(self.degree) + 1.0)[:, None]
        rows = slice(0, self.degree)
        fields = (0.25 * twice[rows], 0.5 * once[rows], legendre[rows], 2.0 * slope[rows])
        return np.array([norms * field for field in fields])


def _integrated(legendre: np.ndarray) -> np.ndarray:
    """Integrals from -1 of every polynomial but the last."""
    n = np.arange(1, legendre.shape[0] - 1)[:, None]
    return np.vstack((legendre[:1] + legendre[1:2], (legendre[2:] - legendre[:-2]) / (2 * n + 1)))


def _of_difference(once: np.ndarray) -> np.ndarray:
    """Integrals of these from -1, but that of the first: each is a difference of two of them."""
    n = np.arange(1, once.shape[0] - 1)[:, None]
    before = once[:-2].copy()
    return (once[2:] - before) / (2 * n + 1)


class Spectrum(NamedTuple):
    """Of the beam of unit length, mass and bending stiffness."""

    squares: np.ndarray  # of the frequencies, ascending (modes,)
    vectors: np.ndarray  # coordinates of `Bent`, of unit mass (modes, degree)
    stiffness: np.ndarray  # with what the rotation adds (degree, degree)
    bent: Bent


def rotating_spectrum(speed: float, count: int, degree: int | None = None) -> Spectrum:
    """The lowest `count` frequencies of the clamped beam of unit length, mass and stiffness; `speed` likewise.

    Error: falls faster than any power of `degree`, the number of polynomials; to 1e-12 with those taken unless given.
    Source: Rayleigh and Ritz.
    """
    from scipy.linalg import eigh

    bent = Bent(SPREAD * count + SPARE if degree is None else degree)
    nodes, weights = gauss(bent.degree + 6)
    x, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    deflections, slopes = bent.at(x)[:2]
    mass = (deflections * weights) @ deflections.T
    tension = (slopes * (0.5 * weights * (1.0 - x**2))) @ slopes.T
    stiffness = np.eye(bent.degree) + speed**2 * (tension - mass)
    inverses, vectors = eigh(mass, stiffness)
    inverses, vectors = inverses[::-1][:count], vectors[:, ::-1][:, :count]
    return Spectrum(1.0 / inverses, (vectors / np.sqrt(inverses)).T, stiffness, bent)


def rotating_frequencies(line: BeamLine, speed: float, count: int) -> np.ndarray:
    """The lowest frequencies of bending in the plane of rotation [rad/s], in the turning frame; `speed` [rad/s]."""
    unit = line.frequency_unit
    return unit * np.sqrt(rotating_spectrum(speed / unit, count).squares)


def simplified_squares(frequencies: np.ndarray, speed: float) -> np.ndarray:
    """omega^2 by (5.56) from the frequencies of the beam at rest: negative where it makes the beam unstable."""
    return np.asarray(frequencies) ** 2 - speed**2


@lru_cache(maxsize=64)  # for who solves an impact on it again, only faster or by another mass
def rotating_beam_modes(line: BeamLine, place: float, speed: float, count: int) -> Modes:
    """Modes of the beam clamped at x = 0, struck in the plane of rotation at `place` [m]; frequencies as seen by an
    observer who turns with it.

    Assumes: a slender beam, Euler-Bernoulli; axially stiff, so that its tension is that of the undeformed beam.
    """
    spectrum = rotating_spectrum(speed / line.frequency_unit, count)
    per_mass, bent = 1.0 / np.sqrt(line.mass), spectrum.bent
    frequencies = line.frequency_unit * np.sqrt(spectrum.squares)
    unit = line.length**3 / line.bending_stiffness

    def field(quantity: int, factor: float, rows: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
        return lambda x: factor * (rows @ bent.at(np.atleast_1d(np.asarray(x, float)) / line.length)[quantity])

    shapes = field(0, per_mass, spectrum.vectors)
    at_contact = shapes(np.array([place]))[:, 0]
    load = bent.at(np.array([place / line.length]))[0][:, 0]
    static = np.linalg.solve(spectrum.stiffness, load)
    moment, shear = line.bending_stiffness / line.length**2, line.bending_stiffness / line.length**3
    nodes, weights = gauss(bent.degree + 6)
    return Modes(
        frequencies=frequencies,
        at_contact=at_contact,
        rigid_mass=np.inf,
        residual_compliance=max(unit * float(load @ static) - float(np.sum((at_contact / frequencies) ** 2)), 0.0),
        shapes=shapes,
        slopes=field(1, per_mass / line.length, spectrum.vectors),
        means=per_mass * (spectrum.vectors @ (bent.at(0.5 * (nodes + 1.0))[0] @ (0.5 * weights))),
        moments=field(2, moment * per_mass, spectrum.vectors),
        shears=field(3, shear * per_mass, spectrum.vectors),
        static_shapes=field(0, unit, static),
        static_moments=field(2, unit * moment, static),
        static_shears=field(3, unit * shear, static),
    )
