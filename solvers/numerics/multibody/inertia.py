"""Kinetic energy of links with floating frames: momenta, forces, mass matrices.

T = 1/2 m V^2 + 1/2 J(z) w^2 + 1/2 z'^T S z' + w (d^T z' + z^T G z') + V (w k x c(z) + c'(z)), with the velocity V of
the origin, the angular velocity w of the frame and the amplitudes z of all fields: those of the shapes, p, and
-1/2 p^T H p of 1 and x along the axis. It is the energy of a motion, so that no mass matrix is ever indefinite.
Source: Shabana (1998), with H of Kane, Ryan and Banerjee (1987).
"""

import numpy as np

from ...jit.kernels import inner_kernel
from .floating import add_springs


@inner_kernel
def _fill(frames, link, q, v, room):
    """Writes amplitudes and rates of all fields of a link, and by what those of its axis change with its shapes."""
    first, count = frames.start[link] + 3, frames.start[link + 1] - frames.start[link] - 3
    for k in range(2):
        room.amplitude[k], room.speed[k] = 0.0, 0.0
        for i in range(count):
            by, by_rate = 0.0, 0.0
            for j in range(count):
                by -= frames.line[link, k, i, j] * q[first + j]
                by_rate -= frames.line[link, k, i, j] * v[first + j]
            room.by[k, i], room.by_rate[k, i] = by, by_rate
            room.amplitude[k] += 0.5 * by * q[first + i]
            room.speed[k] += by * v[first + i]
    for i in range(count):
        room.amplitude[i + 2], room.speed[i + 2] = q[first + i], v[first + i]


@inner_kernel
def _centre(frames, link, values):
    """Moments of first order of the amplitudes of the fields, or of their rates, in the frame."""
    x, y = 0.0, 0.0
    for k in range(frames.start[link + 1] - frames.start[link] - 1):
        x += frames.momentum[link, k, 0] * values[k]
        y += frames.momentum[link, k, 1] * values[k]
    return x, y


@inner_kernel
def _turning(frames, link, room):
    """Moment of inertia about the origin, and moment about it of the rates of the fields."""
    inertia, own = frames.inertia[link], 0.0
    count = frames.start[link + 1] - frames.start[link] - 1
    for k in range(count):
        swollen, crossed = 2.0 * frames.radial[link, k], frames.angular[link, k]
        for i in range(count):
            swollen += frames.swelling[link, k, i] * room.amplitude[i]
            crossed += frames.crossed[link, i, k] * room.amplitude[i]
        inertia += swollen * room.amplitude[k]
        own += crossed * room.speed[k]
    return inertia, own


@inner_kernel
def actions(linkage, room, q, v, momentum, force):
    """Writes the slopes of L = T - V by the rates, M(q) v, and by the coordinates, (size,): what is quadratic in the
    rates, weight, elasticity, springs. Returns the potential energy [J]."""
    frames, energy = linkage.frames, 0.0
    for link in range(frames.mass.size):
        start, shapes = frames.start[link], frames.start[link + 1] - frames.start[link] - 3
        cosine, sine, spin, mass = np.cos(q[start + 2]), np.sin(q[start + 2]), v[start + 2], frames.mass[link]
        along, across = cosine * v[start] + sine * v[start + 1], cosine * v[start + 1] - sine * v[start]
        weight_x, weight_y = linkage.gravity[0], linkage.gravity[1]
        down_x, down_y = cosine * weight_x + sine * weight_y, cosine * weight_y - sine * weight_x
        _fill(frames, link, q, v, room)
        x, y = _centre(frames, link, room.amplitude)
        rate_x, rate_y = _centre(frames, link, room.speed)
        inertia, own = _turning(frames, link, room)
        x += frames.moment[link]
        push_x, push_y = mass * along - spin * y + rate_x, mass * across + spin * x + rate_y
        momentum[start], momentum[start + 1] = cosine * push_x - sine * push_y, sine * push_x + cosine * push_y
        momentum[start + 2] = inertia * spin + own + across * x - along * y
        force[start], force[start + 1] = mass * weight_x, mass * weight_y
        force[start + 2] = across * (rate_x - spin * y) - along * (rate_y + spin * x) + down_y * x - down_x * y
        energy -= mass * (weight_x * q[start] + weight_y * q[start + 1]) + down_x * x + down_y * y
        _of_fields(frames, link, room, spin, along, across, down_x, down_y)
        for i in range(shapes):
            pull = frames.stiffness[link, i] * q[start + 3 + i]
            energy += 0.5 * pull * q[start + 3 + i]
            momentum[start + 3 + i], force[start + 3 + i] = room.momentum[i + 2], room.push[i + 2] - pull
            for k in range(2):
                momentum[start + 3 + i] += room.by[k, i] * room.momentum[k]
                force[start + 3 + i] += room.by[k, i] * room.push[k] + room.by_rate[k, i] * room.momentum[k]
    return energy + add_springs(linkage, q, force)


@inner_kernel
def _of_fields(frames, link, room, spin, along, across, down_x, down_y):
    """The same of the fields of a link, in its frame."""
    count = frames.start[link + 1] - frames.start[link] - 1
    for k in range(count):
        axial, lateral = frames.momentum[link, k, 0], frames.momentum[link, k, 1]
        momentum, swollen = spin * frames.angular[link, k] + along * axial + across * lateral, frames.radial[link, k]
        crossed = 0.0
        for i in range(count):
            momentum += (
                frames.square[link, k, i] * room.speed[i] + spin * frames.crossed[link, i, k] * room.amplitude[i]
            )
            swollen += frames.swelling[link, k, i] * room.amplitude[i]
            crossed += frames.crossed[link, k, i] * room.speed[i]
        room.momentum[k] = momentum
        room.push[k] = spin * (spin * swollen + crossed + across * axial - along * lateral)
        room.push[k] += down_x * axial + down_y * lateral


@inner_kernel
def factor_mass(linkage, room, q, step, factor):
    """Writes the lower triangles of the mass matrices of all links, and of step^2 / 4 of their stiffness with them."""
    frames = linkage.frames
    for link in range(frames.mass.size):
        start, shapes = frames.start[link], frames.start[link + 1] - frames.start[link] - 3
        matrix, cosine, sine = factor[link], np.cos(q[start + 2]), np.sin(q[start + 2])
        _fill(frames, link, q, q, room)
        x, y = _centre(frames, link, room.amplitude)
        x += frames.moment[link]
        matrix[0, 0], matrix[1, 0], matrix[1, 1] = frames.mass[link], 0.0, frames.mass[link]
        matrix[2, 0], matrix[2, 1] = -sine * x - cosine * y, cosine * x - sine * y
        matrix[2, 2], _ = _turning(frames, link, room)
        for k in range(shapes + 2):
            room.momentum[k] = frames.angular[link, k]
            for i in range(shapes + 2):
                room.momentum[k] += frames.crossed[link, i, k] * room.amplitude[i]
        for i in range(shapes):
            axial, lateral, turning = (
                frames.momentum[link, i + 2, 0],
                frames.momentum[link, i + 2, 1],
                room.momentum[i + 2],
            )
            for k in range(2):
                axial += room.by[k, i] * frames.momentum[link, k, 0]
                lateral += room.by[k, i] * frames.momentum[link, k, 1]
                turning += room.by[k, i] * room.momentum[k]
            matrix[3 + i, 0], matrix[3 + i, 1] = cosine * axial - sine * lateral, sine * axial + cosine * lateral
            matrix[3 + i, 2] = turning
            for j in range(i + 1):
                matrix[3 + i, 3 + j] = _square(frames.square[link], room.by, i, j)
            matrix[3 + i, 3 + i] += 0.25 * step**2 * frames.stiffness[link, i]
        _decompose(matrix, shapes + 3)


@inner_kernel
def _square(square, by, i, j):
    """Mass of the rates of two shapes, with what the axis does."""
    total = square[i + 2, j + 2]
    for k in range(2):
        total += by[k, i] * square[k, j + 2] + by[k, j] * square[i + 2, k]
        for m in range(2):
            total += by[k, i] * square[k, m] * by[m, j]
    return total


@inner_kernel
def _decompose(matrix, size):
    """Cholesky, in place of the lower triangle."""
    for i in range(size):
        for j in range(i + 1):
            total = matrix[i, j]
            for k in range(j):
                total -= matrix[i, k] * matrix[j, k]
            matrix[i, j] = np.sqrt(total) if i == j else total / matrix[j, j]


@inner_kernel
def divide_by_mass(linkage, factor, right):
    """Solution in place of `right` (size,) by these factors; what is zero all over a link is left."""
    frames = linkage.frames
    for link in range(frames.mass.size):
        start, size, matrix = frames.start[link], frames.start[link + 1] - frames.start[link], factor[link]
        begin = 0
        while begin < size and right[start + begin] == 0.0:
            begin += 1
        if begin == size:
            continue
        for i in range(begin, size):
            for k in range(begin, i):
                right[start + i] -= matrix[i, k] * right[start + k]
            right[start + i] /= matrix[i, i]
        for i in range(size - 1, -1, -1):
            for k in range(i + 1, size):
                right[start + i] -= matrix[k, i] * right[start + k]
            right[start + i] /= matrix[i, i]


@inner_kernel
def as_rigid(linkage, room, q, momentum, centre, rate):
    """Writes of every link, by its momenta, places of its centre of mass and angle of its frame, and what a rigid link
    of the same momentum and angular momentum would have for velocity and spin, (3 links,) each."""
    frames = linkage.frames
    for link in range(frames.mass.size):
        start, own, mass = frames.start[link], 3 * link, frames.mass[link]
        _fill(frames, link, q, q, room)
        x, y = _centre(frames, link, room.amplitude)
        x += frames.moment[link]
        cosine, sine = np.cos(q[start + 2]), np.sin(q[start + 2])
        arm_x, arm_y = (cosine * x - sine * y) / mass, (sine * x + cosine * y) / mass
        centre[own], centre[own + 1], centre[own + 2] = q[start] + arm_x, q[start + 1] + arm_y, q[start + 2]
        rate[own], rate[own + 1] = momentum[start] / mass, momentum[start + 1] / mass
        turning = momentum[start + 2] - arm_x * momentum[start + 1] + arm_y * momentum[start]
        rate[own + 2] = turning / (frames.inertia[link] - frames.moment[link] ** 2 / mass)
