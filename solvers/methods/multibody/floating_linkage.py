"""A mechanism with flexible links as the integrator takes it."""

from typing import NamedTuple

import numpy as np

from ...bodies import Mechanism
from ...jit.reference import referred
from ...numerics.multibody.floating import Face, Ties, begin_at
from ...numerics.multibody.frozen import null_space
from ...numerics.multibody.integrals import frames_of, shortening, stations_of
from ...numerics.multibody.system import FIXED, PRISMATIC, System
from ...numerics.multibody.variational import Floating, Work, work
from .linkage import Rows, rows_of

MAX_CLOSINGS = 30  # of the joints of bent links; three or four do
CLOSED = 1e-15  # of the unit of every coordinate
PLACES_PER_WAVE = 32  # half waves of the shapes of a struck link, cubic in between: to 3e-7


def floating_linkage(mechanism: Mechanism) -> tuple[Floating, Rows]:
    """Links by their first ends, joints, held drives as constraints, and springs; the last station is struck."""
    system = mechanism.system
    places = [(link, joint.at) for joint in system.joints for link in (joint.first, joint.second)]
    places.append((_struck(mechanism), mechanism.contact_point))
    ties: list[list[_Tie]] = [[], [], [], [], []]
    pins, lines, angles, coils, twists = ties
    for number, joint in enumerate(system.joints):
        if joint.kind == PRISMATIC:
            lines.append(_Tie(number, np.array([-joint.axis[1], joint.axis[0]])))
        else:
            pins.append(_Tie(number, joint.axis))
        if joint.kind in (PRISMATIC, FIXED):
            angles.append(_Tie(number, joint.axis, turns=True))
    for drive in system.drives:
        if drive.held:
            slides = system.joints[drive.joint].kind == PRISMATIC
            kind = lines if slides else angles
            kind.append(_Tie(drive.joint, system.joints[drive.joint].axis, drive.rate, not slides))
    for spring in mechanism.springs:
        slides = system.joints[spring.joint].kind == PRISMATIC
        kind = coils if slides else twists
        kind.append(_Tie(spring.joint, system.joints[spring.joint].axis, spring.stiffness, not slides))
    found = Floating(
        frames_of(system.links),
        stations_of(system.links, places),
        _tied(system, ties),
        system.gravity,
        _units(mechanism),
        struck_face(mechanism),
    )
    return found, rows_of(
        [tie.joint for tie in pins],
        [(tie.joint, tie.rate) for tie in lines],
        [(tie.joint, tie.rate) for tie in angles],
    )


class _Tie(NamedTuple):
    """Between both links of a joint: a direction in the laboratory, rate or stiffness, and whether it is an angle."""

    joint: int
    direction: np.ndarray
    rate: float = 0.0
    turns: bool = False


def _tied(system: System, kinds: list[list[_Tie]]) -> Ties:
    """As kernels take them."""
    ties = [tie for kind in kinds for tie in kind]
    directions, offsets = np.zeros((len(ties), 2)), np.zeros(len(ties))
    for row, tie in enumerate(ties):
        joint = system.joints[tie.joint]
        first, second = (None if link < 0 else system.links[link] for link in (joint.first, joint.second))
        directions[row] = tie.direction if first is None else first.axes @ tie.direction
        if tie.turns:
            offsets[row] = (0.0 if second is None else second.angle) - (0.0 if first is None else first.angle)
    joints = np.array([tie.joint for tie in ties], np.int64)
    rates = np.array([tie.rate for tie in ties], float)
    ends = np.cumsum([len(kind) for kind in kinds])
    return Ties(ends, 2 * joints, 2 * joints + 1, directions, offsets, rates)


def _units(mechanism: Mechanism) -> np.ndarray:
    """Of every coordinate: the size of the mechanism, one turn, and that size by the mass of the link."""
    size = mechanism.extent
    return np.concatenate(
        [
            np.append((size, size, 1.0), np.full(link.size - 3, size * np.sqrt(link.mass)))
            for link in mechanism.system.links
        ]
    )


def room_of(linkage: Floating, rows: Rows) -> Work:
    """Room for a step of it."""
    start = linkage.frames.start
    return work(rows.joint.size, int(start[-1]), start.size - 1, int(np.diff(start).max()))


def bent_start(mechanism: Mechanism, linkage: Floating, rows: Rows) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Coordinates and rates (size,) and the struck point (2,) before the impact: links bent steadily by their weight
    and inertia, as the frozen mechanism has them, the joints closed by moving the frames, and no shape changing.
    Springs of the linkage have no force there."""
    system, frozen, room = mechanism.system, mechanism.frozen, room_of(linkage, rows)
    q, v, rigid = frozen.bent.copy(), frozen.rates.copy(), system.rigid
    for link, start in zip(system.links, system.offsets, strict=False):
        q[start : start + 3] = *link.origin, link.angle
    given = referred(linkage)
    for _ in range(MAX_CLOSINGS):
        begin_at(given, q, room.gap, room.jacobian, room.moving)
        change = _least(room.jacobian[:, rigid], linkage.unit[rigid], room.gap)
        q[rigid] -= change
        if not np.any(np.abs(change) > CLOSED * linkage.unit[rigid]):
            break
    struck = np.array(begin_at(given, q, room.gap, room.jacobian, room.moving))
    v[rigid] -= _least(room.jacobian[:, rigid], linkage.unit[rigid], room.jacobian @ v - room.moving)
    return q, v, struck


def _least(rows: np.ndarray, units: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """The least change, in these units, by which rows (rows, size) change as wanted (rows,)."""
    return units * np.linalg.lstsq(rows * units, wanted, rcond=None)[0] if wanted.size else np.zeros(units.size)


def fastest_vibration(mechanism: Mechanism) -> float:
    """Of the mechanism on its springs, in its first configuration [rad/s]; zero if nothing vibrates."""
    from scipy.linalg import eigh

    system = mechanism.system
    stiffness = np.diag(system.stiffness)
    for spring in mechanism.springs:
        joint = system.joints[spring.joint]
        if joint.kind == PRISMATIC:
            row = joint.axis @ (system.point(joint.second, joint.at) - system.point(joint.first, joint.at))
        else:
            row = system.turn(joint.second, joint.at) - system.turn(joint.first, joint.at)
        stiffness += spring.stiffness * np.outer(row, row)
    basis = null_space(mechanism.frozen.jacobian)
    if not basis.shape[1]:
        return 0.0
    squares = eigh(basis.T @ stiffness @ basis, basis.T @ system.mass @ basis, eigvals_only=True)
    return float(np.sqrt(max(squares[-1], 0.0)))


def struck_face(mechanism: Mechanism) -> Face:
    """What the mass meets of the struck link."""
    link = mechanism.system.links[_struck(mechanism)]
    shapes = link.shapes
    at = mechanism.struck.at * link.length
    normal = link.axes @ np.array(mechanism.struck.normal)
    waves = shapes.frequencies.size + 1
    places = np.unique([*np.linspace(0.0, link.length, PLACES_PER_WAVE * waves + 1), at])
    values = np.ascontiguousarray((shapes.displacements(places) @ normal).T)
    return Face(
        at, places, values, np.ascontiguousarray(normal[1] * shapes.slopes(places).T), normal[0] * shortening(link, at)
    )


def _struck(mechanism: Mechanism) -> int:
    return [link.name for link in mechanism.links].index(mechanism.struck.link)
