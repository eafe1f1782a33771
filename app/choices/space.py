"""Bodies in space as they are drawn and struck: the box they fill, and where along it the impact falls."""

import numpy as np

from solvers import Body, Scene
from solvers.numerics.rigid.impulses import NULL_MOMENT, principal
from solvers.validation import shown

from ..text.refusals import Refused

ALIKE = 1e-6  # relative difference of components of a direction that are equal but for rounding


def has_length(scene: Scene) -> bool:
    """Whether one of the bodies has a length to be struck along."""
    return any(isinstance(body, Body) and not body.is_point for body in (scene.target, scene.impactor))


def struck_place(scene: Scene) -> float:
    """Where along the longest side of the struck body the impact falls: 0 and 1 are its ends."""
    _, body = _struck(scene)
    axis, length = _longest_side(body)
    return 0.5 - float(np.dot(body.centre, axis)) / length


def struck_at(scene: Scene, place: float) -> Scene:
    """The scene with its rod, or the longest side of its body, struck at another place from 0 to 1 along it.

    The end at 1 is the one that lies towards the positive coordinate axis. Raises ValueError for a place out of range,
    and for point masses, which have no length.
    """
    name, body = _struck(scene)
    if not isinstance(place, (int, float)) or not 0.0 <= place <= 1.0:
        raise Refused("refused.value", key="control.place", value=shown(place), allowed="wanted.place")
    axis, length = _longest_side(body)
    centre = np.array(body.centre)
    centre += ((0.5 - place) * length - centre @ axis) * axis
    return scene.replace({f"{name}.centre": centre.tolist()})


def own_frame(scene: Scene) -> np.ndarray:
    """The normal of a scene and two tangents, as rows; it leans towards the first by a `tilt_way` of 0 degrees."""
    normal = np.array(scene.normal)
    aside = np.eye(3)[int(np.argmin(np.abs(normal)))]
    along = np.cross(normal, aside) / np.linalg.norm(np.cross(normal, aside))
    return np.array([normal, along, np.cross(normal, along)])


def leaning(scene: Scene, tilt: float, way: float) -> Scene:
    """The scene with its normal leaning by a `tilt` [degrees] the `way` [degrees] about where it was."""
    if tilt == 0.0:
        return scene
    lean, turn = np.radians((tilt, way))
    shares = [np.cos(lean), np.sin(lean) * np.cos(turn), np.sin(lean) * np.sin(turn)]
    return scene.replace({"contact.normal": (shares @ own_frame(scene)).tolist()})


def _struck(scene: Scene) -> tuple[str, Body]:
    """The target, if it is long at all, or else the impactor."""
    for name in ("target", "impactor"):
        body = getattr(scene, name)
        if isinstance(body, Body) and not body.is_point:
            return name, body
    raise Refused("refused.value", key="target.inertia", value="nothing", allowed="wanted.inertia")


def _longest_side(body: Body) -> tuple[np.ndarray, float]:
    sides, axes = equivalent_box(body)
    axis = axes[:, int(np.argmax(sides))]
    return axis * np.sign(axis[int(np.argmax(np.abs(axis)))]), float(np.max(sides))


def equivalent_box(body: Body) -> tuple[np.ndarray, np.ndarray]:
    """Sides [m] of the uniform box of this mass and inertia, and their directions as columns; a thin rod has one side.

    From I1 = m (b^2 + c^2) / 12 and its like. The largest component of a direction is positive: its sign is else that
    of the last bits.
    """
    moments, axes = principal(np.array(body.inertia))
    largest = np.argmax(np.abs(axes) > (1.0 - ALIKE) * np.abs(axes).max(axis=0), axis=0)
    axes = axes * np.where(axes[largest, range(3)] < 0.0, -1.0, 1.0)
    squares = 6.0 / body.mass * (moments.sum() - 2.0 * moments)
    return np.sqrt(np.where(squares > 10.0 * NULL_MOMENT * squares.max(), squares, 0.0)), axes


def in_space(scene: Scene) -> bool:
    """Whether the bodies are not on one axis but in space."""
    return scene.normal is not None
