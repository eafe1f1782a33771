"""Whether a mechanism can move as it is asked to: which joint or drive is one too many."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...numerics.multibody.frozen import RANK_TOLERANCE, rates_before
from ...numerics.multibody.system import PRISMATIC, System
from ...validation import SceneError, allowed
from .joints import Drive, Joint

SHIFT = 0.01  # of the size of a mechanism


def check_mobility(key: str, system: System, joints: Sequence[Joint], drives: Sequence[Drive], size: float) -> None:
    """Refuses what is locked, held more than once, or stands where a joint or a drive has no say.

    Links count as rigid; `size` of the mechanism [m]. Raises SceneError naming the first joint, or the first drive,
    whose constraints those before it make dependent.
    """
    rows, freedoms, reached = _rows(system, size), 3 * len(system.links), 0
    elsewhere = _rows(_moved(system, size), size)
    for number, joint in enumerate(joints):
        upto = int(np.count_nonzero(system.joint_of[: system.joint_rows] <= number))
        if _rank(rows[:upto]) < upto:
            lost, anywhere = upto - _rank(rows[:upto]), _rank(elsewhere[:upto]) < upto or upto >= freedoms
            names = list(joint.links)
            redundant, singular = (
                allowed("joint-redundant", links=names, lost=lost),
                allowed("joint-singular", links=names),
            )
            raise SceneError(f"{key}.joints[{number + 1}]", joint.table(), redundant if anywhere else singular)
        if upto == freedoms:
            raise SceneError(
                f"{key}.joints[{number + 1}]", joint.table(), allowed("joint-locks", links=list(joint.links))
            )
        reached = upto
    for number, drive in enumerate(drives):
        upto = reached + number + 1
        if _rank(rows[:upto]) < upto:
            links = list(joints[drive.joint].links)
            redundant, singular = allowed("drive-redundant", links=links), allowed("drive-singular", links=links)
            raise SceneError(f"{key}.drives[{number + 1}]", drive.table(), redundant if upto > freedoms else singular)


@dataclass(frozen=True)
class OpenStart:
    """What the drives of a mechanism leave open of how it moves before the impact, and what is assumed of it."""

    freedoms: int  # that the joints leave
    settled: int  # of them, by drives
    joints: tuple[int, ...]  # that no drive settles, by their numbers from 0 on, the fastest first
    rate: float  # of the first of them, of its second link against the first [rad/s or m/s]


def open_start(system: System, size: float) -> OpenStart | None:
    """None where joints and drives settle all that moves; `size` of the mechanism [m]."""
    constraints, freedoms = _rows(system, size), 3 * len(system.links) - system.joint_rows
    if not system.rates.any() or freedoms == len(system.drives):
        return None
    scales = np.tile([1.0, 1.0, 1.0 / size], len(system.links))
    free = np.linalg.svd(constraints)[2][_rank(constraints) :]
    opening = np.array([system.opening(number)[system.rigid] for number in range(len(system.joints))])
    joints = np.flatnonzero(np.abs(opening * scales @ free.T).max(axis=1) > RANK_TOLERANCE)
    rates = opening @ rates_before(system)[system.rigid]
    speeds = np.abs(rates) * [1.0 if joint.kind == PRISMATIC else size for joint in system.joints]
    fastest = joints[np.argsort(-speeds[joints], kind="stable")].tolist()
    if joints.size and speeds[fastest[0]] <= RANK_TOLERANCE * speeds.max():  # what is driven leaves them alone
        return None
    return OpenStart(freedoms, len(system.drives), tuple(fastest), float(rates[fastest[0]]) if fastest else 0.0)


def _rows(system: System, size: float) -> np.ndarray:
    """Of the Jacobian, of length 1; a turn counts by what it moves."""
    rows = system.jacobian[:, system.rigid] * np.tile([1.0, 1.0, 1.0 / size], len(system.links))
    return rows / np.maximum(np.linalg.norm(rows, axis=1, keepdims=True), 1e-300)


def _moved(system: System, size: float) -> System:
    """Another configuration: every joint a little elsewhere, so that what is dependent by chance is so no more."""
    shifts = np.random.default_rng(1).uniform(-SHIFT, SHIFT, (len(system.joints), 2)) * size
    return replace(
        system, joints=[joint._replace(at=joint.at + by) for joint, by in zip(system.joints, shifts, strict=True)]
    )


def _rank(rows: np.ndarray) -> int:
    return int(np.linalg.matrix_rank(rows, tol=RANK_TOLERANCE)) if rows.size else 0
