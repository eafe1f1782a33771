"""Links that bend and stretch in floating frames which move far: their places, joints, springs, and a struck face.

Coordinates of a link: origin of its frame, which is on its first end, angle, amplitudes of its shapes. A point is at
R + A(angle) (x + sum p_i psi_i(x) - 1/2 p^T H(x) p e), with H the integral of the product of the slopes up to x: a link
that bends gets shorter along its axis e. By this a link that turns is stiffened as it must be.
Assumes: slopes small beside 1.
Source: thesis 6.2; Kane, Ryan and Banerjee (1987) for H; Shabana (1998).
"""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from ...jit.reference import refer


class Frames(NamedTuple):
    """Links by their integrals over the mass. Fields are of every link, up to `shapes` shapes, the others zero.

    By what a link gets shorter is, in its inertia, replaced by a straight line along the axis, s0 + s1 x, with the same
    integrals over the mass, of first and second order; so fields number two more than shapes: 1 and x along the axis,
    then the shapes.
    start (links + 1,), where the coordinates of each begin; mass [kg], moment, of first order along the link [kg m],
    and inertia about the origin [kg m2], (links,); momentum (links, fields, 2), angular, radial (links, fields), as in
    `shapes`; square (links, fields, fields), mass of the rates of fields; swelling, the same without rotary inertia, by
    which the inertia about the origin grows; crossed, along times across less the reverse; line (links, 2, shapes,
    shapes), H of the straight line; stiffness (links, shapes), squared frequencies.
    """

    start: np.ndarray
    mass: np.ndarray
    moment: np.ndarray
    inertia: np.ndarray
    momentum: np.ndarray
    angular: np.ndarray
    radial: np.ndarray
    square: np.ndarray
    swelling: np.ndarray
    crossed: np.ndarray
    line: np.ndarray
    stiffness: np.ndarray


class Stations(NamedTuple):
    """Points of links, or of the ground, link -1: `own` (stations, 2), from the origin in the frame [m]; shapes
    (stations, shapes, 2), turns of the section (stations, shapes), and H, `shortened` (stations, shapes, shapes)."""

    link: np.ndarray
    own: np.ndarray
    shapes: np.ndarray
    turns: np.ndarray
    shortened: np.ndarray


class Ties(NamedTuple):
    """Pairs of stations, by number: pins, that are one point; lines, that have a distance along a `direction` (ties, 2)
    which turns with the section of the first; angles between their sections; springs on such distances and on such
    angles. The five kinds in this order, ends (5,); a distance or an angle is offset + rate t, of springs `rate` is the
    stiffness [N/m, N m/rad]."""

    ends: np.ndarray
    first: np.ndarray
    second: np.ndarray
    direction: np.ndarray
    offset: np.ndarray
    rate: np.ndarray


class Face(NamedTuple):
    """What is struck of a link, at `at` [m] of it: values (places, shapes) of its shapes along the normal, and their
    slopes, at places [m] along it; shortened (shapes, shapes), H there, times what the normal has of the axis."""

    at: float
    places: np.ndarray
    values: np.ndarray
    tilts: np.ndarray
    shortened: np.ndarray


@inner_kernel
def place_of(linkage, q, station):
    """Of a station, x and y [m]."""
    points, start = linkage.stations, linkage.frames.start
    link, along, across = points.link[station], points.own[station, 0], points.own[station, 1]
    if link < 0:
        return along, across
    first, count = start[link] + 3, start[link + 1] - start[link] - 3
    for i in range(count):
        bent = q[first + i]
        along += bent * points.shapes[station, i, 0]
        across += bent * points.shapes[station, i, 1]
        for j in range(count):
            along -= 0.5 * bent * q[first + j] * points.shortened[station, i, j]
    angle = q[first - 1]
    cosine, sine = np.cos(angle), np.sin(angle)
    return q[first - 3] + cosine * along - sine * across, q[first - 2] + sine * along + cosine * across


@inner_kernel
def add_point(row, linkage, q, station, along_x, along_y, sign):
    """The velocity of a station in a direction, to a row of the Jacobian (size,)."""
    points, start = linkage.stations, linkage.frames.start
    link = points.link[station]
    if link < 0:
        return
    first, count = start[link] + 3, start[link + 1] - start[link] - 3
    x, y = place_of(linkage, q, station)
    row[first - 3] += sign * along_x
    row[first - 2] += sign * along_y
    row[first - 1] += sign * (along_y * (x - q[first - 3]) - along_x * (y - q[first - 2]))
    cosine, sine = np.cos(q[first - 1]), np.sin(q[first - 1])
    axial, lateral = cosine * along_x + sine * along_y, cosine * along_y - sine * along_x
    for i in range(count):
        along = points.shapes[station, i, 0]
        for j in range(count):
            along -= points.shortened[station, i, j] * q[first + j]
        row[first + i] += sign * (axial * along + lateral * points.shapes[station, i, 1])


@inner_kernel
def turn_of(linkage, q, station):
    """Angle of the section there, from the laboratory [rad]; of the ground zero."""
    points, start = linkage.stations, linkage.frames.start
    link = points.link[station]
    if link < 0:
        return 0.0
    first, count = start[link] + 3, start[link + 1] - start[link] - 3
    angle = q[first - 1]
    for i in range(count):
        angle += points.turns[station, i] * q[first + i]
    return angle


@inner_kernel
def add_turn(row, linkage, station, sign):
    """The angular velocity of the section there, to a row of the Jacobian (size,)."""
    points, start = linkage.stations, linkage.frames.start
    link = points.link[station]
    if link < 0:
        return
    first, count = start[link] + 3, start[link + 1] - start[link] - 3
    row[first - 1] += sign
    for i in range(count):
        row[first + i] += sign * points.turns[station, i]


@inner_kernel
def distance_of(linkage, tie, q):
    """Along the direction of a tie beside its offset [m], the direction, and the distance square to it [m]."""
    ties = linkage.ties
    angle = turn_of(linkage, q, ties.first[tie])
    cosine, sine = np.cos(angle), np.sin(angle)
    own_x, own_y = ties.direction[tie, 0], ties.direction[tie, 1]
    along_x, along_y = cosine * own_x - sine * own_y, sine * own_x + cosine * own_y
    x1, y1 = place_of(linkage, q, ties.first[tie])
    x2, y2 = place_of(linkage, q, ties.second[tie])
    apart_x, apart_y = x2 - x1, y2 - y1
    apart, aside = along_x * apart_x + along_y * apart_y, along_x * apart_y - along_y * apart_x
    return apart - ties.offset[tie], along_x, along_y, aside


@inner_kernel
def add_distance(row, linkage, tie, q, stiffness):
    """The rate of that distance, to a row of the Jacobian (size,); or the forces of a spring, if it has a stiffness.
    Returns the distance [m]."""
    ties = linkage.ties
    apart, along_x, along_y, aside = distance_of(linkage, tie, q)
    sign = -stiffness * apart if stiffness else 1.0
    add_point(row, linkage, q, ties.second[tie], along_x, along_y, sign)
    add_point(row, linkage, q, ties.first[tie], along_x, along_y, -sign)
    add_turn(row, linkage, ties.first[tie], sign * aside)
    return apart


@inner_kernel
def angle_of(linkage, tie, q):
    """Of the second section of a tie against the first, beside its offset [rad]."""
    ties = linkage.ties
    return turn_of(linkage, q, ties.second[tie]) - turn_of(linkage, q, ties.first[tie]) - ties.offset[tie]


@inner_kernel
def add_angle(row, linkage, tie, q, stiffness):
    """The same of an angle [rad]."""
    ties = linkage.ties
    turned = angle_of(linkage, tie, q)
    sign = -stiffness * turned if stiffness else 1.0
    add_turn(row, linkage, ties.second[tie], sign)
    add_turn(row, linkage, ties.first[tie], -sign)
    return turned


@inner_kernel
def add_pin(across, up, linkage, q, station, sign):
    """The velocity of a station along x and along y, to two rows of the Jacobian (size,); returns its place."""
    points, start = linkage.stations, linkage.frames.start
    link, x, y = points.link[station], points.own[station, 0], points.own[station, 1]
    if link < 0:
        return x, y
    first, count = start[link] + 3, start[link + 1] - start[link] - 3
    cosine, sine = np.cos(q[first - 1]), np.sin(q[first - 1])
    for i in range(count):
        along, lateral, shorter = points.shapes[station, i, 0], points.shapes[station, i, 1], 0.0
        for j in range(count):
            shorter += points.shortened[station, i, j] * q[first + j]
        x += q[first + i] * (along - 0.5 * shorter)
        y += q[first + i] * lateral
        across[first + i] += sign * (cosine * (along - shorter) - sine * lateral)
        up[first + i] += sign * (sine * (along - shorter) + cosine * lateral)
    arm_x, arm_y = cosine * x - sine * y, sine * x + cosine * y
    across[first - 3] += sign
    up[first - 2] += sign
    across[first - 1] -= sign * arm_y
    up[first - 1] += sign * arm_x
    return q[first - 3] + arm_x, q[first - 2] + arm_y


@inner_kernel
def joints_at(linkage, q, time, gap, jacobian, moving):
    """Writes how far the constraints are from being met, (constraints,), their Jacobian (constraints, size) and the
    rates at which they move by themselves, (constraints,)."""
    ties = linkage.ties
    for row in range(gap.size):
        moving[row] = 0.0
        for i in range(q.size):
            jacobian[row, i] = 0.0
    pins, lines, angles = ties.ends[0], ties.ends[1], ties.ends[2]
    for k in range(pins):
        across, up = jacobian[2 * k], jacobian[2 * k + 1]
        x1, y1 = add_pin(across, up, linkage, q, ties.first[k], -1.0)
        x2, y2 = add_pin(across, up, linkage, q, ties.second[k], 1.0)
        gap[2 * k], gap[2 * k + 1] = x2 - x1, y2 - y1
    for k in range(pins, angles):
        number = pins + k
        moving[number] = ties.rate[k]
        if k < lines:
            gap[number] = add_distance(jacobian[number], linkage, k, q, 0.0) - ties.rate[k] * time
        else:
            gap[number] = add_angle(jacobian[number], linkage, k, q, 0.0) - ties.rate[k] * time


@inner_kernel
def gaps_at(linkage, q, time, gap):
    """Writes how far the constraints are from being met, (constraints,)."""
    ties = linkage.ties
    pins, lines, angles = ties.ends[0], ties.ends[1], ties.ends[2]
    for k in range(pins):
        x1, y1 = place_of(linkage, q, ties.first[k])
        x2, y2 = place_of(linkage, q, ties.second[k])
        gap[2 * k], gap[2 * k + 1] = x2 - x1, y2 - y1
    for k in range(pins, angles):
        if k < lines:
            gap[pins + k], _, _, _ = distance_of(linkage, k, q)
        else:
            gap[pins + k] = angle_of(linkage, k, q)
        gap[pins + k] -= ties.rate[k] * time


@inner_kernel
def add_springs(linkage, q, found):
    """Adds the forces of the springs to those on all coordinates, (size,); returns their energy [J]."""
    ties, energy = linkage.ties, 0.0
    for k in range(ties.ends[2], ties.ends[4]):
        if k < ties.ends[3]:
            given = add_distance(found, linkage, k, q, ties.rate[k])
        else:
            given = add_angle(found, linkage, k, q, ties.rate[k])
        energy += 0.5 * ties.rate[k] * given**2
    return energy


@kernel
def begin_at(linkage, q, gap, jacobian, moving):
    """Of a linkage, best by reference, let the springs have no force at these coordinates, and write what `joints_at`
    does, at time zero. Returns the place of the last station [m]."""
    linkage = refer(linkage)
    ties = linkage.ties
    joints_at(linkage, q, 0.0, gap, jacobian, moving)
    for k in range(ties.ends[2], ties.ends[4]):
        if k < ties.ends[3]:
            given, _, _, _ = distance_of(linkage, k, q)
        else:
            given = angle_of(linkage, k, q)
        ties.offset[k] += given
    return place_of(linkage, q, linkage.stations.link.size - 1)


@inner_kernel
def _bend(face, q, first, place, row):
    """Writes the shapes along the normal at a place of the link, cubic between those of the table; returns their sum,
    and the slope of that."""
    low, high, moved, slope = 0, face.places.size - 1, 0.0, 0.0
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if face.places[middle] <= place else (low, middle)
    width = face.places[high] - face.places[low]
    part = min(max((place - face.places[low]) / width, 0.0), 1.0)
    inside = face.places[0] <= place <= face.places[high]
    rest = 1.0 - part
    for i in range(face.values.shape[1]):
        ahead, back = width * face.tilts[low, i], width * face.tilts[high, i]
        grown = face.values[high, i] - face.values[low, i]
        value = face.values[low, i] + grown * part**2 * (3.0 - 2.0 * part)
        row[first + i] = value + part * rest * (ahead * rest - back * part)
        moved += row[first + i] * q[first + i]
        if inside:
            change = 6.0 * grown * part * rest + ahead * rest * (1.0 - 3.0 * part) + back * part * (3.0 * part - 2.0)
            slope += change / width * q[first + i]
    return moved, slope


@inner_kernel
def face_of(linkage, contact, q, place, row):
    """Of the bent line of the struck link, which a point mass meets at `place` (2,): by how much it is in there, where
    along the line, and the normal there; writes the velocity of the link along it per unit of each rate, (size,)."""
    start, face = linkage.frames.start[contact.link], linkage.face
    shapes = linkage.frames.start[contact.link + 1] - start - 3
    for k in range(q.size):
        row[k] = 0.0
    cosine, sine = np.cos(q[start + 2]), np.sin(q[start + 2])
    away_x, away_y = place[0] - q[start], place[1] - q[start + 1]
    x, y = cosine * away_x + sine * away_y, cosine * away_y - sine * away_x
    normal_x, normal_y = contact.normal[0], contact.normal[1]
    apart_x, apart_y = x - contact.on_link[0], y - contact.on_link[1]
    along = normal_y * apart_x - normal_x * apart_y
    moved, slope = _bend(face, q, start + 3, face.at + normal_y * along, row)
    for i in range(shapes):
        for j in range(shapes):
            row[start + 3 + i] -= face.shortened[i, j] * q[start + 3 + j]
            moved -= 0.5 * face.shortened[i, j] * q[start + 3 + i] * q[start + 3 + j]
    depth, tilt = normal_x * apart_x + normal_y * apart_y - moved, slope * normal_y
    size = np.sqrt(1.0 + tilt**2)
    normal_x, normal_y = (normal_x - tilt * normal_y) / size, (normal_y + tilt * normal_x) / size
    row[start + 2] = normal_y * x - normal_x * y
    for i in range(shapes):
        row[start + 3 + i] /= size
    row[start], row[start + 1] = cosine * normal_x - sine * normal_y, sine * normal_x + cosine * normal_y
    return depth / size, along, row[start], row[start + 1]
