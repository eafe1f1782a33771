"""What a joint between two links does to waves that meet it: how much goes back, how much goes on, and as what."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import validation
from ..bodies import Mechanism
from ..bodies.linkage.joints import Joint
from ..bodies.linkage.links import GROUND, Link
from ..numerics.waves.scattering import PRISMATIC, Bar, scatter
from ..scenes.library import SceneOrName, scene_of
from ..validation import SceneError, allowed

INCOMING = ("axial", "bending")
OUTGOING = ("reflected_axial", "reflected_bending", "transmitted_axial", "transmitted_bending")
FREQUENCY_RANGE = (1e-3, 1e12)  # rad/s
MAX_FREQUENCIES = 1_000
THICKNESSES = (0.01, 0.03, 0.1, 0.2, 0.4)  # radii of gyration in a radian of bending wave: of the usual frequencies
AT_END = 2e-3  # of the length of a link: nearer to its end a joint is at it


@dataclass(frozen=True)
class JointScattering:
    """Of waves that come along the first link of a joint, as if both links went on without end.

    Arrays (frequencies, in, out), in INCOMING, out OUTGOING: shares of the power, which add up to 1, and amplitudes of
    displacement over that of the incoming wave.
    """

    joint: int  # number in the scene
    kind: str
    links: tuple[str, str]
    bend: float  # by which the second link goes on turned from the first [rad]
    frequencies: np.ndarray  # [rad/s]
    powers: np.ndarray
    amplitudes: np.ndarray  # complex

    @property
    def power_error(self) -> float:
        """The largest by which the shares miss 1."""
        return float(np.abs(self.powers.sum(axis=2) - 1.0).max())

    def table(self) -> dict[str, Any]:
        """As plain tables; complex amplitudes as [real, imaginary]."""
        found: dict[str, Any] = {"joint": self.joint, "kind": self.kind, "links": list(self.links), "bend": self.bend}
        found["frequencies"] = self.frequencies.tolist()
        pairs = np.stack((np.real(self.amplitudes), np.imag(self.amplitudes)), axis=-1)
        for row, name in enumerate(INCOMING):
            found[name] = {
                "powers": {out: self.powers[:, row, k].tolist() for k, out in enumerate(OUTGOING)},
                "amplitudes": {out: pairs[:, row, k].tolist() for k, out in enumerate(OUTGOING)},
            }
        return found | {"power_error": self.power_error}


def joint_scattering(
    scene: SceneOrName, joint: int | None = None, frequencies: Sequence[float] | None = None
) -> JointScattering:
    """What a joint of two links does to axial and bending waves along the first of them.

    joint: its number; unless given the first between two links of which it is known. frequencies [rad/s];
    usually five at which the links are thin beside a bending wave.
    Assumes: Euler and Bernoulli's beams at rest, a joint without mass at the end of both links.
    Raises SceneError for scenes without such a joint, and for links without section or material.
    Source: thesis 11.3.7; see `numerics.waves.scattering`.
    """
    scene = scene_of(scene)
    if not isinstance(scene.target, Mechanism):
        raise SceneError("target.kind", scene.target.kind, allowed("joined-mechanism"))
    number = _between_links(scene.target, joint)
    pin = scene.target.joints[number]
    named = {link.name: link for link in scene.target.links}
    first, second = (named[name] for name in pin.links)
    along, away = -_away(number, first, pin), _away(number, second, pin)
    across = np.array([-along[1], along[0]])
    bend = math.atan2(float(across @ away), float(along @ away))
    bars = _bar(scene.target, first), _bar(scene.target, second)
    if frequencies is None:
        frequencies = _usual(bars[0])
    found = np.array([validation.number("frequencies", each, *FREQUENCY_RANGE, "rad/s") for each in frequencies])
    if not 1 <= found.size <= MAX_FREQUENCIES:
        reason = allowed("list", low=1, high=MAX_FREQUENCIES, of="numbers")
        raise SceneError("frequencies", f"{found.size} values", reason)
    axis = np.array(pin.axis) if pin.kind == PRISMATIC else along
    sliding = float(axis @ along), float(axis @ across)
    scattered = scatter(bars[0], bars[1], bend, pin.kind, found, sliding)
    return JointScattering(
        number, pin.kind, (first.name, second.name), bend, found, scattered.powers, scattered.amplitudes
    )


def between_bars(mechanism: Mechanism) -> list[int]:
    """Numbers of the joints of which it is known what they do to waves: at the ends of two links with section and
    material."""
    named, found = {link.name: link for link in mechanism.links}, []
    for number, pin in enumerate(mechanism.joints):
        try:
            for name in () if GROUND in pin.links else pin.links:
                _bar(mechanism, named[name])
                _away(number, named[name], pin)
        except SceneError:
            continue
        if GROUND not in pin.links:
            found.append(number)
    return found


def _between_links(mechanism: Mechanism, joint: int | None) -> int:
    """The number of a joint that is not to the ground."""
    between = [number for number, pin in enumerate(mechanism.joints) if GROUND not in pin.links]
    if not between:
        raise SceneError("target.joints", None, allowed("joined-links-only"))
    if joint is None:
        return next(iter(between_bars(mechanism)), between[0])
    joint = validation.plain(joint)
    if joint not in between:
        raise SceneError("joint", joint, allowed("choice", options=[str(number) for number in between]))
    return joint


def _bar(mechanism: Mechanism, link: Link) -> Bar:
    key = f"target.links[{1 + mechanism.links.index(link)}]"
    for word, value in (("section", link.section), ("material", link.material)):
        if value is None:
            raise SceneError(f"{key}.{word}", None, allowed("flexible-link", link=link.name))
    assert link.section is not None and link.material is not None
    if link.section.second_moment is None:
        raise SceneError(f"{key}.section.second_moment", None, allowed("second-moment"))
    young = link.material.young
    return Bar(young * link.section.area, young * link.section.second_moment, link.mass / link.length)


def _away(number: int, link: Link, pin: Joint) -> np.ndarray:
    """Unit vector along a link away from a joint at its end."""
    part = float((np.array(pin.at) - np.array(link.start)) @ link.along) / link.length
    if AT_END < part < 1.0 - AT_END:
        raise SceneError(f"target.joints[{number + 1}].at", list(pin.at), allowed("at-end-of-link", link=link.name))
    return link.along if part <= AT_END else -link.along


def _usual(bar: Bar) -> list[float]:
    """Frequencies [rad/s] at which the bending wave of a link is so many times longer than it is thick."""
    gyration = math.sqrt(bar.bending_stiffness / bar.axial_stiffness)
    speed = math.sqrt(bar.axial_stiffness / bar.mass_per_length)
    return [speed / gyration * each**2 for each in THICKNESSES]
