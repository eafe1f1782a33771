"""Natural modes of a structure, as the modal kernel and the drawings need them."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..jit.kernels import inner_kernel, kernel

# Of the largest amplitude where a body is struck: below it a mode is at rest there, and is left out. Smaller, rounding
# divides by rounding.
AT_REST = 1e-9


def as_a_whole(x: np.ndarray) -> np.ndarray:
    """Motion of a body that only translates: 1 everywhere, (x,)."""
    return np.ones(np.size(x))


@dataclass(frozen=True)
class Modes:
    """The lowest vibration modes of a body, mass-normalised.

    frequencies (modes,) [rad/s], ascending; at_contact (modes,) [kg^-1/2], the shapes where the body is struck;
    rigid_mass [kg], the mass that moves freely as a whole, felt where the body is struck, or infinity if it is held;
    residual_compliance [m/N], static compliance of all the modes left out, at the contact;
    shapes(x) (modes, x) [kg^-1/2] and slopes(x) (modes, x) [kg^-1/2 / m]; x [m] is measured from the struck end of a
    rod, from the first support of a beam;
    rigid_shape(x) (x,), motion as a whole, 1 where the body is struck; of a beam that one force sets into translation
    and rotation, both in one;
    means (modes,) [kg^-1/2] and rigid_mean, averages of the shapes over the mass of the body; None: all zero;
    turns(x) (modes, x) [kg^-1/2 / m], of a beam: angles of the section, the slopes where it is not sheared;
    moments(x) [N m] and shears(x) [N], (modes, x), of a beam: M = E I psi', and V = M' where inertia is nothing, per
    unit of the modal coordinate [kg^1/2 m];
    numbers (modes,), from 1 on, of each among the modes of the body; None: they are all, in their order;
    static_shapes(x) [m/N] and, of a rod, static_slopes(x) [1/N], of a beam static_moments(x) [m] and static_shears(x)
    [-], (x,), by all modes under a steady force of 1 N where the body is struck, held by its inertia if it is free.
    """

    frequencies: np.ndarray
    at_contact: np.ndarray
    rigid_mass: float
    residual_compliance: float
    shapes: Callable[[np.ndarray], np.ndarray]
    slopes: Callable[[np.ndarray], np.ndarray]
    rigid_shape: Callable[[np.ndarray], np.ndarray] = as_a_whole
    means: np.ndarray | None = None
    rigid_mean: float = 1.0
    turns: Callable[[np.ndarray], np.ndarray] | None = None
    moments: Callable[[np.ndarray], np.ndarray] | None = None
    shears: Callable[[np.ndarray], np.ndarray] | None = None
    static_shapes: Callable[[np.ndarray], np.ndarray] | None = None
    static_slopes: Callable[[np.ndarray], np.ndarray] | None = None
    static_moments: Callable[[np.ndarray], np.ndarray] | None = None
    static_shears: Callable[[np.ndarray], np.ndarray] | None = None
    numbers: np.ndarray | None = None

    def left_out(self, field: str, x: np.ndarray) -> np.ndarray:
        """That field, "shapes", "slopes", "moments" or "shears", of all modes left out under a steady 1 N, (x,).

        They follow a force slower than themselves as springs do: where the body is struck it gives way by
        `residual_compliance` more, and what they carry of a support reaction is lost without it. Zero where no static
        field is known.
        """
        static, own = getattr(self, f"static_{field}"), getattr(self, field)
        if static is None or own is None:
            return np.zeros(np.size(x))
        return static(x) - (self.at_contact / self.frequencies**2) @ own(x)

    def excited(self) -> "Modes":
        """Without the modes that an impact cannot move, as they are at rest where it falls."""
        moved = self.is_excited
        return self if moved.all() else self._only(moved)

    @property
    def is_excited(self) -> np.ndarray:
        """Which modes an impact can move, (modes,) of bool."""
        return np.abs(self.at_contact) > AT_REST * np.abs(self.at_contact).max(initial=0.0)

    def lowest(self, count: int) -> "Modes":
        """The first of them; what the others give way is not in `residual_compliance`."""
        return self if count >= self.frequencies.size else self._only(np.arange(self.frequencies.size) < count)

    def _only(self, kept: np.ndarray) -> "Modes":
        fields = {
            name: _rows(getattr(self, name), kept)
            for name in ("shapes", "slopes", "turns", "moments", "shears")
            if getattr(self, name) is not None
        }
        return replace(
            self,
            frequencies=self.frequencies[kept],
            at_contact=self.at_contact[kept],
            means=None if self.means is None else self.means[kept],
            numbers=(np.arange(kept.size) + 1 if self.numbers is None else self.numbers)[kept],
            **fields,
        )

    def mean_velocity(self, before: float | np.ndarray, struck: np.ndarray) -> np.ndarray:
        """Of a body as a whole that moved at `before`, by that of the place where it is struck [m/s]; or positions."""
        return struck if self.rigid_mean == 1.0 else before + self.rigid_mean * (struck - before)

    def moving_energy(self, mass: float, before: float | np.ndarray, struck: np.ndarray) -> np.ndarray:
        """Kinetic energy of a body as a whole [J], whose mass is `mass` and which moved at `before`."""
        if not np.isfinite(self.rigid_mass):
            return np.zeros_like(struck)
        gained = struck - before
        return 0.5 * mass * before**2 + self.rigid_mass * gained * (before + 0.5 * gained)

    @property
    def shortest_period(self) -> float:
        """Period of the highest kept mode [s]: no finer detail in time is resolved; 0 without modes."""
        return 2.0 * np.pi / float(self.frequencies[-1]) if self.frequencies.size else 0.0

    def with_rigid(self, field: str = "shapes") -> Callable[[np.ndarray], np.ndarray]:
        """That field of the modes (modes, x), with the motion as a whole in front, of the same norm, if it is free.

        All zero where the body has no such field.
        """
        own = getattr(self, field) or (lambda x: np.zeros((self.frequencies.size, np.size(x))))
        if not np.isfinite(self.rigid_mass):
            return own
        shape = self.rigid_shape if field == "shapes" else (lambda x: np.zeros(np.size(x)))
        return lambda x: np.vstack((shape(x) / np.sqrt(self.rigid_mass), own(x)))

    @property
    def front_time(self) -> float:
        """See `front_time`."""
        return front_time(self.frequencies.size, self.shortest_period)


@inner_kernel
def _surplus(square, frequencies, at_contact, compliance, mobility):
    """What the body gives way beyond the mass, at a square of the angular frequency; it grows with that."""
    found = compliance - mobility / square
    for i in range(frequencies.size):
        found += at_contact[i] ** 2 / (frequencies[i] ** 2 - square)
    return found


@kernel
def half_period(frequencies, at_contact, compliance, mobility):
    """Half the longest period [s] of a body with a mass on it that it is known by these modes to carry; NaN: none.

    compliance: of the modes left out, which bend as under a load at rest; mobility: 1 / m of the mass and 1 / M of the
    body as far as it moves as a whole [1/kg]. With the mass attached the receptance of the body at the contact is that
    of the mass with the sign turned, sum phi_i^2 / (omega_i^2 - omega^2) - 1 / (M omega^2) = 1 / (m omega^2).
    """
    lowest = frequencies[0] ** 2
    low, high = 1e-13 * lowest, (1.0 - 1e-13) * lowest
    known = frequencies, at_contact, compliance, mobility
    if not _surplus(low, *known) < 0.0 < _surplus(high, *known):
        return np.nan
    while True:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            return math.pi / math.sqrt(middle)
        if _surplus(middle, *known) < 0.0:
            low = middle
        else:
            high = middle


def _rows(field: Callable[[np.ndarray], np.ndarray], kept: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    return lambda x: field(x)[kept]


def front_time(count: int, shortest_period: float, order: int = 2) -> float:
    """What a front lasts that has run through a mesh of `count` elements [s]: who is apart for less may touch.

    Dispersion of this order in the elements' size spreads it over count^(1 / (order + 1)) of the shortest periods; the
    factor is measured on chattering contacts.
    """
    return 1.1 * count ** (1.0 / (order + 1.0)) * shortest_period


def rigid_body(mass: float) -> Modes:
    """A body that moves only as a whole [kg], or, of infinite mass, not at all."""
    nothing = np.zeros(0)

    def no_shape(x: np.ndarray) -> np.ndarray:
        return np.zeros((0, np.size(x)))

    return Modes(nothing, nothing, mass, 0.0, no_shape, no_shape)


def one_mode(mass: float, frequency: float) -> Modes:
    """A mass [kg] on a spring with its other end held, of natural frequency [rad/s]."""
    amplitude = 1.0 / np.sqrt(mass)
    return Modes(
        frequencies=np.array([frequency]),
        at_contact=np.array([amplitude]),
        means=np.array([amplitude]),
        rigid_mass=np.inf,
        residual_compliance=0.0,
        shapes=lambda x: np.full((1, np.size(x)), amplitude),
        slopes=lambda x: np.zeros((1, np.size(x))),
    )
