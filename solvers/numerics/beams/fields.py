"""Harmonic motions of a beam of unit length, mass and bending stiffness, from two potentials (see bending_waves).

The hyperbolic functions are divided by their value at the end, so nothing overflows at any number of modes.
"""

from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from .dispersion import wave_numbers


class Values(NamedTuple):
    """Potentials and their derivatives, (modes, x) each."""

    u: np.ndarray
    du: np.ndarray
    w: np.ndarray
    dw: np.ndarray


@dataclass(frozen=True)
class BendingField:
    """Motions at the squared frequencies `square` (modes,), with potentials of the amplitudes `amplitudes` (modes, 4).

    u = A0 sin(a xi) / a + A1 cos(a xi), w = A2 sinh(b xi) / b + A3 cosh(b xi) over cosh(b reach), xi = x - centre; on
    top, with `forces` / square in A4 if amplitudes are (modes, 5), the motion about a harmonic force at `place`.
    """

    square: np.ndarray
    shear: float
    rotary: float
    amplitudes: np.ndarray
    centre: float = 0.5
    reach: float = 0.5
    place: float = 0.0
    alpha: np.ndarray = field(init=False, repr=False, compare=False)
    beta: np.ndarray = field(init=False, repr=False, compare=False)
    gamma_a: np.ndarray = field(init=False, repr=False, compare=False)
    gamma_b: np.ndarray = field(init=False, repr=False, compare=False)

    def __post_init__(self):
        numbers = wave_numbers(self.square[:, None], self.shear, self.rotary)
        for name, number in zip(("alpha", "beta", "gamma_a", "gamma_b"), numbers, strict=True):
            object.__setattr__(self, name, number)

    def scaled(self, factors: np.ndarray) -> "BendingField":
        """Each motion times its factor."""
        return replace(self, amplitudes=self.amplitudes * factors[:, None])

    # -- the functions the motions are made of ------------------------------------------------------------------------

    def basis(self, x: np.ndarray, side: np.ndarray) -> list[Values]:
        """Potentials of each amplitude alone; `side` of the force (-1, 1) for an x at its place."""
        cos, sin, cosh, sinh = self._functions(x)
        nothing = np.zeros_like(cos)
        found = [
            Values(sin, cos, nothing, nothing),
            Values(cos, -self.alpha * sin, nothing, nothing),
            Values(nothing, nothing, sinh, cosh),
            Values(nothing, nothing, cosh, self.beta * sinh),
        ]
        return found if self.amplitudes.shape[1] == 4 else [*found, self._about_force(x, side)]

    def potentials(self, x: np.ndarray, side: float | None = None) -> Values:
        """Of the motions; `side` of the force (-1, 1) for an x at its place, else the one inside the beam."""
        cos, sin, cosh, sinh = self._functions(x)
        a0, a1, a2, a3, *force = self.amplitudes.T[:, :, None]
        found = Values(
            a0 * sin + a1 * cos,
            a0 * cos - a1 * (self.alpha * sin),
            a2 * sinh + a3 * cosh,
            a2 * cosh + a3 * (self.beta * sinh),
        )
        if not force:
            return found
        inner = 1.0 if self.place == 0.0 else -1.0
        about = self._about_force(x, inner if side is None else side)
        return Values(*(own + force[0] * more for own, more in zip(found, about, strict=True)))

    def _functions(self, x):
        """cos, sin / a and, over their end value, cosh, sinh / b."""
        xi, a = x - self.centre, np.sqrt(self.alpha)
        return np.cos(a * xi), np.sin(a * xi) / a, *self._hyperbolic(xi)

    def _hyperbolic(self, xi):
        """cosh and sinh / b over cosh(b reach), or cos and sin / b above the cut-off."""
        b = np.sqrt(np.abs(self.beta))
        distance, end = b * np.abs(xi), b * self.reach
        grown = np.exp(np.minimum(distance - end, 0.0)) / (1.0 + np.exp(-2.0 * end))
        cosh = grown * (1.0 + np.exp(-2.0 * distance))
        sinh = np.sign(xi) * grown * -np.expm1(-2.0 * distance) / np.maximum(b, 1e-100)
        travels = self.beta[:, 0] <= 0.0
        if travels.any():
            angle = b[travels] * xi
            cosh[travels], sinh[travels] = np.cos(angle), xi * np.sinc(angle / np.pi)
        return cosh, sinh

    def _about_force(self, x, side):
        """V jumps by square at the force; u' and w' are smooth there, and gamma_b w - gamma_a u continuous."""
        distance = np.abs(x - self.place)
        sign = np.where(distance == 0.0, side, np.sign(x - self.place))
        a, b = np.sqrt(self.alpha), np.sqrt(np.abs(self.beta))
        angle = b * distance
        # A decaying wave, or, where it hardly decays over the beam or travels, the standing one
        decaying, slow = np.exp(-angle), np.minimum(angle, 1.0)
        even = np.where(self.beta > 0.0, np.cosh(slow), np.cos(angle))
        odd = np.where(self.beta > 0.0, np.sinh(slow), -np.sin(angle))
        even, odd = (np.where(self.beta > 1.0, *pair) for pair in ((decaying, even), (-decaying, odd)))
        share = 0.5 / (self.alpha + self.beta)
        of_u, of_w = share * self.gamma_b, share * self.gamma_a
        return Values(
            of_u * sign * np.cos(a * distance),
            -of_u * a * np.sin(a * distance),
            of_w * sign * even,
            of_w * b * odd,
        )

    # -- what is seen of them -----------------------------------------------------------------------------------------

    def displacement(self, at: Values) -> np.ndarray:
        return at.du + at.dw

    def turn(self, at: Values) -> np.ndarray:
        """psi, the angle of the section."""
        return self.gamma_b * at.w - self.gamma_a * at.u

    def slope(self, at: Values) -> np.ndarray:
        """y'; equal to psi without shear."""
        return self.beta * at.w - self.alpha * at.u

    def moment(self, at: Values) -> np.ndarray:
        return self.gamma_b * at.dw - self.gamma_a * at.du

    def shear_force(self, at: Values) -> np.ndarray:
        return self.square[:, None] * (at.u + at.w)

    # -- integrals over the beam, in closed form ----------------------------------------------------------------------

    def integrals(self) -> tuple[np.ndarray, np.ndarray]:
        """Of the displacement, and of its square plus the rotary inertia times that of the turn; (modes,) each."""
        cuts = [0.0, 1.0] if self.amplitudes.shape[1] == 4 else [0.0, self.place, 1.0]
        first, second = np.zeros(self.square.size), np.zeros(self.square.size)
        for start, end in pairwise(cuts):
            if end > start:
                left, right = self.potentials(np.array([start]), 1.0), self.potentials(np.array([end]), -1.0)
                first += (right.u + right.w - left.u - left.w)[:, 0]
                second += self._squares(start, end, left, right)[:, 0]
        return first, second

    def _squares(self, start, end, left, right):
        """By parts, as each potential is proportional to its second derivative."""
        length, total = end - start, self.alpha + self.beta
        u_du, w_dw = right.u * right.du - left.u * left.du, right.w * right.dw - left.w * left.dw
        u_dw, w_du = right.u * right.dw - left.u * left.dw, right.w * right.du - left.w * left.du
        uu = (length * (left.du**2 + self.alpha * left.u**2) - u_du) / (2.0 * self.alpha)
        ww = self._square_of_w(start, end, right, w_dw)
        du_du, dw_dw = u_du + self.alpha * uu, w_dw - self.beta * ww
        du_dw, uw = (self.alpha * u_dw + self.beta * w_du) / total, (u_dw - w_du) / total
        turned = self.gamma_a**2 * uu - 2.0 * self.gamma_a * self.gamma_b * uw + self.gamma_b**2 * ww
        return du_du + 2.0 * du_dw + dw_dw + self.rotary * turned

    def _square_of_w(self, start, end, right, w_dw):
        half = 0.5 * (end - start)
        slow = np.abs(self.beta) * half**2 < 0.25  # the formula by parts is 0 / 0 at the cut-off
        beta = np.where(slow, 1.0, self.beta)
        mixed = np.where(beta * half**2 > 400.0, 0.0, right.dw**2 - beta * right.w**2)  # waves of the one and other end
        by_parts = (w_dw - 2.0 * half * mixed) / (2.0 * beta)
        if not slow.any():
            return by_parts
        middle = self.potentials(np.array([start + half]))
        terms = 4.0 * np.where(slow, self.beta, 0.0) * half**2
        even, odd, term = 1.0, 0.0, 1.0  # sinh(2 b h) / (2 b h) and what it exceeds 1 by, over b^2 h^2
        for i in range(1, 10):
            term = term / ((2 * i) * (2 * i + 1))
            odd, even = odd + 4.0 * term * terms ** (i - 1), even + term * terms**i
        centred = half * (1.0 + even) * middle.w**2 + half**3 * odd * middle.dw**2
        return np.where(slow, centred, by_parts)
