"""Natural modes of a structure, as the modal kernel and the drawings need them."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

STILL = 1e-9  # of the largest amplitude where a body is struck: below it a mode is at rest there


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
    moments(x) [N m] and shears(x) [N], (modes, x), of a beam: M = E I psi', and V = M' where inertia is nothing, per
    unit of the modal coordinate [kg^1/2 m];
    static_shapes(x) [m/N] and, of a beam, static_moments(x) [m] and static_shears(x) [-], (x,), by all modes under a
    steady force of 1 N where the body is struck, held by its inertia if it is free.
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
    moments: Callable[[np.ndarray], np.ndarray] | None = None
    shears: Callable[[np.ndarray], np.ndarray] | None = None
    static_shapes: Callable[[np.ndarray], np.ndarray] | None = None
    static_moments: Callable[[np.ndarray], np.ndarray] | None = None
    static_shears: Callable[[np.ndarray], np.ndarray] | None = None

    def left_out(self, field: str, x: np.ndarray) -> np.ndarray:
        """That field, "shapes", "moments" or "shears", of all modes left out under a steady force of 1 N, (x,).

        They follow a force slower than themselves as springs do: where the body is struck it gives way by
        `residual_compliance` more, and what they carry of a support reaction is lost without it. Zero where no static
        field is known.
        """
        static, own = getattr(self, f"static_{field}"), getattr(self, field)
        if static is None or own is None:
            return np.zeros(np.size(x))
        return static(x) - (self.at_contact / self.frequencies**2) @ own(x)

    def felt(self) -> "Modes":
        """Without the modes that a blow cannot move, as they are at rest where it falls."""
        moved = np.abs(self.at_contact) > STILL * np.abs(self.at_contact).max(initial=0.0)
        return self if moved.all() else self._only(moved)

    def lowest(self, count: int) -> "Modes":
        """The first of them; what the others give way is not in `residual_compliance`."""
        return self if count >= self.frequencies.size else self._only(np.arange(self.frequencies.size) < count)

    def _only(self, kept: np.ndarray) -> "Modes":
        fields = {
            name: _rows(getattr(self, name), kept)
            for name in ("shapes", "slopes", "moments", "shears")
            if getattr(self, name) is not None
        }
        return replace(
            self,
            frequencies=self.frequencies[kept],
            at_contact=self.at_contact[kept],
            means=None if self.means is None else self.means[kept],
            **fields,
        )

    def mean_velocity(self, before: float, struck: np.ndarray) -> np.ndarray:
        """Of a body as a whole that moved at `before`, by that of the place where it is struck [m/s]; or positions."""
        return struck if self.rigid_mean == 1.0 else before + self.rigid_mean * (struck - before)

    def moving_energy(self, mass: float, before: float, struck: np.ndarray) -> np.ndarray:
        """Kinetic energy of a body as a whole [J], whose mass is `mass` and which moved at `before`."""
        if not np.isfinite(self.rigid_mass):
            return np.zeros_like(struck)
        gained = struck - before
        return (0.5 * mass * before**2 if before else 0.0) + self.rigid_mass * gained * (before + 0.5 * gained)

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


def _rows(field: Callable[[np.ndarray], np.ndarray], kept: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    return lambda x: field(x)[kept]


def front_time(count: int, shortest_period: float, order: int = 2) -> float:
    """What a front lasts that has run through a mesh of `count` elements [s]: who is apart for less may touch.

    Dispersion of this order in the elements' size spreads it over count^(1 / (order + 1)) of the shortest periods; the
    factor is measured on chattering contacts.
    """
    return 1.1 * count ** (1.0 / (order + 1.0)) * shortest_period


def rod_modes(length: float, mass: float, wave_speed: float, fixed: bool, count: int) -> Modes:
    """Modes of a uniform rod, free where it is struck and fixed or free at the far end.

    `count` vibration modes; the rigid-body motion of a free rod comes on top.
    Source: thesis (5.2) with the end conditions of 5.3 and 9.3; residual compliance sum_{i>N} phi_i^2 / omega_i^2.
    """
    from scipy.special import zeta  # here, as it costs a fifth of the time allowed for importing the library

    halves = np.arange(1, count + 1) - (0.5 if fixed else 0.0)  # k L / pi
    wavenumbers = np.pi * halves / length
    amplitude = np.sqrt(2.0 / mass)
    left_out = 2.0 / mass * (length / (np.pi * wave_speed)) ** 2 * zeta(2.0, count + (0.5 if fixed else 1.0))
    return Modes(
        frequencies=wave_speed * wavenumbers,
        at_contact=np.full(count, amplitude),
        rigid_mass=np.inf if fixed else mass,
        residual_compliance=float(left_out),
        means=amplitude * np.sinc(halves) if fixed else None,
        shapes=lambda x: amplitude * np.cos(np.multiply.outer(wavenumbers, x)),
        slopes=lambda x: -amplitude * wavenumbers[:, None] * np.sin(np.multiply.outer(wavenumbers, x)),
        static_shapes=static_rod_shape(length, length**2 / (mass * wave_speed**2), fixed),
    )


def static_rod_shape(length: float, compliance: float, fixed: bool) -> Callable[[np.ndarray], np.ndarray]:
    """Displacement (x,) [m/N] of a rod of compliance L / (E A) under a steady force on its end, fixed at the other.

    Of a free rod, while the force accelerates it, less the motion of its centre of mass.
    """

    def shape(x: np.ndarray) -> np.ndarray:
        place = np.asarray(x, float) / length
        return compliance * (1.0 - place if fixed else 1.0 / 3.0 - place + 0.5 * place**2)

    return shape


def composite_rod_modes(
    length: float, mass: float, wave_speed: float, fixed: bool, count: int, attached_mass: float
) -> Modes:
    """Modes of a uniform rod with a rigid mass on its struck end, fixed or free at the far end.

    Normalised by the mass of both; `rigid_mass` is that of both if they are free; the residual compliance is that of
    the rod under a force on the mass, against the inertia of both if they are free.
    Source: thesis (5.11), z tan z = m2 / m1, and (9.19), with z = omega L / c.
    Differs: (9.19) prints -tan(z) / z = m2 / m1; it is m1 / m2, so that tan z = -(m1 / m2) z.
    Error: `count` of any size, as each root is found near its limit for a light mass, z = (i - 1/2) pi or i pi.
    """
    ratio = mass / attached_mass
    limits = np.pi * (np.arange(1, count + 1) - (0.5 if fixed else 0.0))
    roots = limits - np.arctan(limits / ratio)
    if fixed:
        roots[0] = np.sqrt(ratio / (1.0 + 4.0 * ratio / np.pi**2))
    for _ in range(100):  # Newton on a rising concave function: from below it never overshoots
        change = (roots - limits + np.arctan(roots / ratio)) / (1.0 + ratio / (roots**2 + ratio**2))
        roots = roots - change
        if np.all(np.abs(change) <= 4e-16 * roots):
            break
    wave, slope = (np.sin, np.cos) if fixed else (np.cos, lambda angle: -np.sin(angle))
    half = 0.5 - np.sinc(2.0 * roots / np.pi) * (0.5 if fixed else -0.5)  # mean square of the shape over the length
    amplitudes = 1.0 / np.sqrt(mass * half + attached_mass * wave(roots) ** 2)
    wavenumbers, at_contact = roots / length, amplitudes * wave(roots)
    frequencies = wave_speed * wavenumbers
    whole = length**2 / (mass * wave_speed**2)  # L / (E A)
    if not fixed:
        whole *= (mass / (mass + attached_mass)) ** 2 / 3.0
    return Modes(
        frequencies=frequencies,
        at_contact=at_contact,
        rigid_mass=np.inf if fixed else mass + attached_mass,
        residual_compliance=float(max(whole - np.sum((at_contact / frequencies) ** 2), 0.0)),
        shapes=lambda x: amplitudes[:, None] * wave(np.multiply.outer(wavenumbers, length - np.asarray(x, float))),
        slopes=lambda x: (
            -(amplitudes * wavenumbers)[:, None] * slope(np.multiply.outer(wavenumbers, length - np.asarray(x, float)))
        ),
    )


def attached_rod_modes(length: float, mass: float, wave_speed: float, count: int, struck_end: bool) -> Modes:
    """A free rod in a frame fixed to one of its ends, which bends by `count` shapes of a rod clamped there.

    Frame and shapes are coupled by mass, m_i = 2 m / ((2 i - 1) pi); taken apart they are the motion of the mean, which
    no inner force changes, and as many oscillators. So the velocity of the rod as a whole is
    X' + sum 2 / ((2 i - 1) pi) q_i', (10.7), never X' alone: that of the end to which the frame is fixed.
    Error: frequencies and motion converge to those of the free rod with the third power of 1 / count; the stress at the
    end with the frame stays as large as its clamp makes it after the contact, and falls with 1 / count only.
    Source: thesis 10.2, (10.1)-(10.7). Differs: the thesis finds no quiet periods at mid-length; they are there.
    """
    from scipy.linalg import eigh

    odd = 2.0 * np.arange(1, count + 1) - 1.0
    wavenumbers = 0.5 * np.pi * odd / length
    coupling = 2.0 / (np.pi * odd)  # m_i / m
    inertia = mass * (0.5 * np.eye(count) - np.multiply.outer(coupling, coupling))  # about the mean
    squares, vectors = eigh(np.diag(0.5 * mass * (wave_speed * wavenumbers) ** 2), inertia)

    def from_frame(x):
        return np.asarray(x, float) if struck_end else length - np.asarray(x, float)

    def shapes(x):
        return vectors.T @ (np.sin(np.multiply.outer(wavenumbers, from_frame(x))) - coupling[:, None])

    def slopes(x):
        cosine = np.cos(np.multiply.outer(wavenumbers, from_frame(x)))
        return vectors.T @ ((wavenumbers if struck_end else -wavenumbers)[:, None] * cosine)

    frequencies, at_contact = np.sqrt(squares), shapes(np.zeros(1))[:, 0]
    static = static_rod_shape(length, length**2 / (mass * wave_speed**2), False)
    whole = float(static(0.0))  # L / (3 E A), against the rod's own inertia
    return Modes(
        frequencies=frequencies,
        at_contact=at_contact,
        rigid_mass=mass,
        residual_compliance=float(max(whole - np.sum((at_contact / frequencies) ** 2), 0.0)),
        shapes=shapes,
        slopes=slopes,
        static_shapes=static,
    )


def rigid_body(mass: float) -> Modes:
    """A body that moves only as a whole [kg], or, of infinite mass, not at all."""
    nothing = np.zeros(0)
    return Modes(nothing, nothing, mass, 0.0, *(lambda x: np.zeros((0, np.size(x))) for _ in range(2)))


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
