"""What a method finds: a movement, and what some of them know besides.

`isinstance` asks for what a movement knows besides; a method says so by having these functions.
"""

from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np

from ..numerics.modes import Modes


class Motion(Protocol):
    """The movement that a method found, at any time [s] and place [m] from the struck end.

    Times may be any array; at a jump the value after it is given, or before it with `after=False`. Fields have shape
    (time, x), never (x, time); compression is positive. Of a beam displacement is across its length. In a solution each
    of these functions refuses what lies outside the duration or the bodies, or says NaN there with `outside="nan"`.
    """

    def force(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Of the contact [N]."""
        ...

    def force_history(self) -> tuple[np.ndarray, np.ndarray]:
        """Times [s] and forces [N] with every jump kept: there a time stands twice."""
        ...

    def impactor_position(self, time: np.ndarray) -> np.ndarray:
        """How far it has come [m]."""
        ...

    def impactor_velocity(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Of its centre of mass [m/s]."""
        ...

    def end_position(self, time: np.ndarray) -> np.ndarray:
        """How far the struck face has come [m]."""
        ...

    def end_velocity(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Of the struck face [m/s]."""
        ...

    def rigid_velocity(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Of the target's centre of mass [m/s]."""
        ...

    def stress(self, time: np.ndarray, x: np.ndarray) -> np.ndarray:
        """[Pa]; of a beam on the side that is struck."""
        ...

    def velocity(self, time: np.ndarray, x: np.ndarray) -> np.ndarray:
        """[m/s]."""
        ...

    def displacement(self, time: np.ndarray, x: np.ndarray) -> np.ndarray:
        """[m]."""
        ...

    def impulse(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Of the contact so far [N s]."""
        ...

    def energies(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """By parts [J], as `Solution.energy` names them, (time,) each."""
        ...


class BoundedMotion(Motion, Protocol):
    """Of a solution: its functions refuse instants and places outside of it, or say NaN with `outside="nan"`."""

    def force(self, time: np.ndarray, after: bool = True, *, outside: str = "refuse") -> np.ndarray: ...
    def impactor_position(self, time: np.ndarray, *, outside: str = "refuse") -> np.ndarray: ...
    def impactor_velocity(self, time: np.ndarray, after: bool = True, *, outside: str = "refuse") -> np.ndarray: ...
    def end_position(self, time: np.ndarray, *, outside: str = "refuse") -> np.ndarray: ...
    def end_velocity(self, time: np.ndarray, after: bool = True, *, outside: str = "refuse") -> np.ndarray: ...
    def rigid_velocity(self, time: np.ndarray, after: bool = True, *, outside: str = "refuse") -> np.ndarray: ...
    def stress(self, time: np.ndarray, x: np.ndarray, *, outside: str = "refuse") -> np.ndarray: ...
    def velocity(self, time: np.ndarray, x: np.ndarray, *, outside: str = "refuse") -> np.ndarray: ...
    def displacement(self, time: np.ndarray, x: np.ndarray, *, outside: str = "refuse") -> np.ndarray: ...
    def impulse(self, time: np.ndarray, after: bool = True, *, outside: str = "refuse") -> np.ndarray: ...
    def energies(self, time: np.ndarray, *, outside: str = "refuse") -> dict[str, np.ndarray]: ...


def knows_field(motion: Motion) -> bool:
    """Whether it tells places of the target apart; else all of it moves, or stays, as one."""
    return getattr(motion, "has_field", True)


@runtime_checkable
class ResolvesForce(Protocol):
    """Knows the contact force averaged over the finest that its method can resolve: the rest is chatter."""

    def resolved_force(self, time: np.ndarray) -> np.ndarray: ...


@runtime_checkable
class MovesFace(Protocol):
    """Knows the velocity of the impactor where it strikes, which is not that of all of it."""

    def face_velocity(self, time: np.ndarray, after: bool = True) -> np.ndarray: ...


@runtime_checkable
class SplitsTarget(Protocol):
    """Knows the energy of the target as `kinetic` and `strain` [J]."""

    def target_energies(self, time: np.ndarray) -> dict[str, np.ndarray]: ...


@runtime_checkable
class SendsWaves(Protocol):
    """Knows the waves that each rod's ends send, in units of Z v, over time [T]."""

    def sent(self, rod: int, right_going: bool, t: np.ndarray, after: bool = True) -> np.ndarray: ...
    def sent_total(self, rod: int, right_going: bool, t: np.ndarray) -> np.ndarray: ...
    def jumps(self, rod: int, right_going: bool, until: float) -> np.ndarray: ...


@runtime_checkable
class Pushes(Protocol):
    """Knows the work of a prescribed force up to a time [s], in J."""

    def work(self, time: float) -> float: ...


@runtime_checkable
class Bends(Protocol):
    """Knows the bending moment [N m] and the shear force [N] of a beam, (time, x)."""

    def moment(self, time: np.ndarray, x: np.ndarray) -> np.ndarray: ...
    def shear(self, time: np.ndarray, x: np.ndarray) -> np.ndarray: ...


class TargetState(NamedTuple):
    """Of a target as a whole, where it is struck, and of its modes that an impact can move: position (time,) [m] and
    velocity (time,) [m/s], mass-normalised coordinates (time, modes) and their rates."""

    position: np.ndarray
    velocity: np.ndarray
    coordinates: np.ndarray
    rates: np.ndarray


@runtime_checkable
class KnowsModes(Protocol):
    """Knows the modal coordinates of the target."""

    def target_state(self, time: np.ndarray) -> TargetState: ...


@runtime_checkable
class ShowsModes(KnowsModes, Protocol):
    """Knows besides what shapes and frequencies these modes have, in the places of the target."""

    @property
    def target_modes(self) -> Modes: ...


@runtime_checkable
class Joined(Protocol):
    """Is the motion of a mechanism: knows its links, and the reactions at its joints, as `Solution` says them."""

    def link_rates(self, time: float) -> dict[str, dict[str, Any]]: ...
    def reactions(self, until: float) -> list[dict[str, Any]]: ...


@runtime_checkable
class ChangesModes(Protocol):
    """Knows what becomes of the nodes of a link where its modes change to those of the link and the mass."""

    def mode_change(self) -> Any: ...


@runtime_checkable
class Balances(Protocol):
    """Is made of impulses without duration: (2, balances), times [s] and impulses [N s]."""

    @property
    def impulses(self) -> tuple[np.ndarray, np.ndarray]: ...


@runtime_checkable
class Lasts(Protocol):
    """Knows whether the impact takes any time, in which what moves by itself moves on."""

    @property
    def lasts(self) -> bool: ...
