"""A mechanism of rigid links as the integrator takes it."""

from typing import NamedTuple

import numpy as np

from ...bodies import AnyBody, Mechanism
from ...numerics.multibody.flight import Contact
from ...numerics.multibody.moving import Angles, Lines, Linkage, Pins, Springs
from ...numerics.multibody.system import FIXED, PRISMATIC, Joint, System

# Of the length of a link: so far beside its ends a mass still meets it. It is no point; else who strikes a tip would
# miss it next time, as the link turns.
BESIDE = 0.01


class Rows(NamedTuple):
    """Of every constraint, in the order of the integrator: its joint, what kind it is (`PIN_X`, `PIN_Y`, `LINE`,
    `ANGLE`), its place among those of its kind, and the rate at which a drive moves it."""

    joint: np.ndarray
    kind: np.ndarray
    number: np.ndarray
    rate: np.ndarray


PIN_X, PIN_Y, LINE, ANGLE = range(4)


def rigid_linkage(mechanism: Mechanism) -> tuple[Linkage, Rows]:
    """Links by their centres, joints and held drives as constraints."""
    system = mechanism.system
    pins, lines, angles, rows = [], [], [], {PIN_X: [], LINE: [], ANGLE: []}
    for number, joint in enumerate(system.joints):
        pair = _pair(system, joint)
        if joint.kind == PRISMATIC:
            lines.append((*pair, _in_frame(system, joint.first, np.array([-joint.axis[1], joint.axis[0]])), 0.0))
            rows[LINE].append((number, 0.0))
        else:
            pins.append(pair)
            rows[PIN_X].append(number)
        if joint.kind in (PRISMATIC, FIXED):
            angles.append((joint.first, joint.second, _angle(system, joint), 0.0))
            rows[ANGLE].append((number, 0.0))
    for drive in system.drives:
        joint = system.joints[drive.joint]
        if not drive.held:
            continue
        if joint.kind == PRISMATIC:
            lines.append((*_pair(system, joint), _in_frame(system, joint.first, joint.axis), drive.rate))
            rows[LINE].append((drive.joint, drive.rate))
        else:
            angles.append((joint.first, joint.second, _angle(system, joint), drive.rate))
            rows[ANGLE].append((drive.joint, drive.rate))
    coils, turns, springs = [], [], {True: [], False: []}
    for spring in mechanism.springs:
        joint = system.joints[spring.joint]
        slides = joint.kind == PRISMATIC
        springs[slides].append(spring.stiffness)
        if slides:
            coils.append((*_pair(system, joint), _in_frame(system, joint.first, joint.axis), 0.0))
        else:
            turns.append((joint.first, joint.second, _angle(system, joint), 0.0))
    held = Springs(Lines(*_columns(coils, "iivvvf")), np.array(springs[True], float),
                   Angles(*_columns(turns, "iiff")), np.array(springs[False], float))  # fmt: skip
    masses = np.concatenate([(link.mass, link.mass, link.inertia) for link in system.links])
    load = np.concatenate([(*(link.mass * system.gravity), 0.0) for link in system.links])
    found = Linkage(1.0 / masses, load, Pins(*_columns(pins, "iivv")), Lines(*_columns(lines, "iivvvf")),
                    Angles(*_columns(angles, "iiff")), held, mechanism.extent)  # fmt: skip
    return found, rows_of(rows[PIN_X], rows[LINE], rows[ANGLE])


def struck_by(mechanism: Mechanism, impactor: AnyBody) -> Contact:
    """The mass or stop in front of the struck link, whose frame has its origin on its first end if any link is
    flexible."""
    system = mechanism.system
    number = [link.name for link in mechanism.links].index(mechanism.struck.link)
    link, normal = system.links[number], np.array(mechanism.struck.normal)
    along = np.array([normal[1], -normal[0]])
    ends = [
        along @ (np.array(end) - mechanism.contact_point)
        for end in (mechanism.struck_link.start, mechanism.struck_link.end)
    ]
    slack = BESIDE * max(link.length, 1e-300)
    origin = link.origin if mechanism.flexible else _centre(system, number)
    return Contact(
        number,
        _in_frame(system, number, mechanism.contact_point - origin),
        _in_frame(system, number, normal),
        float(min(ends)) - slack,
        float(max(ends)) + slack,
        impactor.mass,
        np.zeros(2) if impactor.held else system.gravity,
    )


def centres(mechanism: Mechanism) -> np.ndarray:
    """Coordinates of the integrator in the first configuration, (3 links,)."""
    system = mechanism.system
    return np.concatenate([(*_centre(system, i), link.angle) for i, link in enumerate(system.links)])


def rates_of_centres(mechanism: Mechanism) -> np.ndarray:
    """Rates of the integrator before the impact, (3 links,)."""
    system, rates = mechanism.system, mechanism.frozen.rates
    found = []
    for link, start in zip(system.links, system.offsets, strict=False):
        arm, spin = 0.5 * link.length * link.axes[0], rates[start + 2]
        found += [rates[start] - spin * arm[1], rates[start + 1] + spin * arm[0], spin]
    return np.array(found)


def _centre(system: System, link: int) -> np.ndarray:
    return system.links[link].origin + 0.5 * system.links[link].length * system.links[link].axes[0]


def _in_frame(system: System, link: int, vector: np.ndarray) -> np.ndarray:
    return vector if link < 0 else system.links[link].axes @ vector


def _pair(system: System, joint: Joint) -> tuple:
    """Both links, and the point of the joint on each."""
    places = [
        joint.at if link < 0 else _in_frame(system, link, joint.at - _centre(system, link))
        for link in (joint.first, joint.second)
    ]
    return joint.first, joint.second, *places


def _angle(system: System, joint: Joint) -> float:
    """Of the second link against the first [rad]."""
    first, second = (0.0 if link < 0 else system.links[link].angle for link in (joint.first, joint.second))
    return second - first


def _columns(rows: list, kinds: str) -> list[np.ndarray]:
    """Arrays of the entries of rows: numbers of links (i), vectors (v), values (f)."""
    shapes = {"i": ((len(rows),), np.int64), "v": ((len(rows), 2), float), "f": ((len(rows),), float)}
    found = []
    for place, kind in enumerate(kinds):
        shape, dtype = shapes[kind]
        found.append(np.array([row[place] for row in rows], dtype).reshape(shape))
    return found


def rows_of(pins: list[int], lines: list[tuple[int, float]], angles: list[tuple[int, float]]) -> Rows:
    """Of constraints by their joints, and by the rates of drives."""
    found = [(joint, kind, number, 0.0) for number, joint in enumerate(pins) for kind in (PIN_X, PIN_Y)]
    for kind, given in ((LINE, lines), (ANGLE, angles)):
        found += [(joint, kind, number, rate) for number, (joint, rate) in enumerate(given)]
    return Rows(*(np.array([row[i] for row in found], float if i == 3 else np.int64) for i in range(4)))
