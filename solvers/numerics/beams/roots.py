"""Natural frequencies of uniform beams, counted: none is missed and none found twice.

How many frequencies lie below a trial one follows from signs of the exact dynamic stiffness (Wittrick and Williams
1971): those of the beam with more held, which are counted first, and the negative pivots of the stiffness of what is
let go. Halving an interval by that count finds each root to rounding, above the cut-off and at double roots too.
The unknown is z, the fourth root of omega^2 rho A L^4 / (E I), which is k L in Euler-Bernoulli theory.
"""

import numpy as np

from ...jit.kernels import allocating_kernel, inner_kernel, kernel
from .dispersion import wave_numbers_kernel

# Half of a symmetric beam, about its middle: displacement even or odd, ends pinned, clamped or free. The odd free half
# is also a beam pinned at the middle. And the whole cantilever.
EVEN_PINNED, ODD_PINNED, EVEN_CLAMPED, ODD_CLAMPED, EVEN_FREE, ODD_FREE, CANTILEVER = range(7)


@inner_kernel
def _difference(a2, b2, half):
    """sin(a h) cosh(b h) / a - cos(a h) sinh(b h) / b by its series, for small arguments; a2, b2 squared, signed."""
    u, v = -a2 * half**2, b2 * half**2
    total, first, odd_first = 0.0, 1.0, 1.0  # u^i / (2 i)! and u^i / (2 i + 1)!
    for i in range(9):
        second, odd_second = 1.0, 1.0
        for j in range(9 - i):
            if i != j:
                total += odd_first * second - first * odd_second
            second *= v / ((2 * j + 1) * (2 * j + 2))
            odd_second *= v / ((2 * j + 2) * (2 * j + 3))
        first *= u / ((2 * i + 1) * (2 * i + 2))
        odd_first *= u / ((2 * i + 2) * (2 * i + 3))
    return half * total


@inner_kernel
def _at_end(alpha, beta, half):
    """cos, sin / a, cosh, sinh / b at the end and sin cosh / a - cos sinh / b; hyperbolic ones over cosh, if real."""
    a, b = np.sqrt(alpha), np.sqrt(abs(beta))
    cos, sin = np.cos(a * half), np.sin(a * half) / a
    if beta > 0.0:
        cosh = 1.0
        sinh = np.tanh(b * half) / b
    else:
        cosh = np.cos(b * half)
        sinh = np.sin(b * half) / b if b > 0.0 else half
    if max(alpha, abs(beta)) * half**2 > 0.25:
        return cos, sin, cosh, sinh, sin * cosh - cos * sinh
    scale = np.cosh(b * half) if beta > 0.0 else 1.0
    return cos, sin, cosh, sinh, _difference(alpha, beta, half) / scale


@inner_kernel
def _count(problem, z, half, shear, rotary, end_mass):
    """How many natural frequencies lie below z^2, motions as a whole included."""
    square = z**4
    alpha, beta, gamma_a, gamma_b = wave_numbers_kernel(square, shear, rotary)
    cos, sin, cosh, sinh, difference = _at_end(alpha, beta, half)
    total, bent, turned = alpha + beta, shear * square, rotary * square
    # Numbers of pinned-pinned frequencies, known as such; the odd one at the cut-off is pure shear.
    turns = np.sqrt(alpha) * half / np.pi
    even, odd = np.floor(turns + 0.5), np.floor(turns)
    if beta < 0.0:
        turns = np.sqrt(-beta) * half / np.pi
        even, odd = even + np.floor(turns + 0.5), odd + np.floor(turns) + 1.0
    if problem == EVEN_PINNED:
        return even
    if problem == ODD_PINNED:
        return odd
    # Determinants of the end's displacements, and stiffness of an end against turning alone.
    even_end = gamma_b * cos * sinh + gamma_a * sin * cosh
    odd_end = bent * total * sin * cosh + beta * gamma_a * difference
    even_turn = cos * cosh / even_end
    odd_turn = alpha * beta * sin * sinh / odd_end
    if even_turn < 0.0:
        even -= 1.0
    if odd_turn < 0.0:
        odd -= 1.0
    if problem == EVEN_CLAMPED:
        return even
    if problem == ODD_CLAMPED:
        return odd
    # Determinants of the end's stiffness
    even_free = -square * (gamma_b * sin * cosh + gamma_a * sinh * cos)
    odd_free = -square * (alpha * gamma_a * difference + turned * total * sinh * cos)
    if problem == EVEN_FREE:
        return even + _negative(even_free / even_end, even_turn)
    if problem == ODD_FREE:
        return odd + _negative(odd_free / odd_end, odd_turn)
    both = even_free * odd_end + odd_free * even_end
    both += square * total**2 * ((cos * cosh) ** 2 - alpha * beta * (sin * sinh) ** 2)
    both += 2.0 * square**2 * difference * (alpha * sin * cosh + beta * sinh * cos)
    turn = cos * cosh * odd_end + alpha * beta * sin * sinh * even_end
    determinant = both - 2.0 * end_mass * square * total * turn
    return even + odd + _negative(determinant * even_end * odd_end, even_turn + odd_turn)


@kernel
def count_below(problem, z, half, shear, rotary, end_mass):
    """The same, for Python."""
    return _count(problem, z, half, shear, rotary, end_mass)


@inner_kernel
def _negative(determinant, pivot):
    """Negative eigenvalues of a symmetric 2 x 2 matrix with this determinant and this element on its diagonal."""
    if determinant < 0.0:
        return 1.0
    return 2.0 if pivot < 0.0 else 0.0


def slender_roots(problem: int, count: int, half: float) -> np.ndarray:
    """The same as `roots` of Euler-Bernoulli beams without an end mass, (count,), by Newton: x = z half is
    start +- atan(tanh x). Error: rounding."""
    n = np.arange(1, count + 1)
    if problem == CANTILEVER:
        start, sign = np.pi * ((n + 1) // 2 - 0.5), np.where(n % 2, -1.0, 1.0)
    else:  # clamped or free ends make no difference
        start, sign = np.pi * n, -1.0 if problem in (EVEN_CLAMPED, EVEN_FREE) else 1.0
    x = start + 0.25 * np.pi * sign
    for _ in range(5):
        end = np.tanh(x)
        x -= (x - start - sign * np.arctan(end)) / (1.0 - sign * (1.0 - end**2) / (1.0 + end**2))
    return x / half


@allocating_kernel
def roots(problem, count, rigid, half, shear, rotary, end_mass):
    """The lowest `count` roots z above the `rigid` first, which are zero; (count,) ascending."""
    found = np.empty(count)
    low, step = 1e-8, 1.0
    for i in range(count):
        wanted = rigid + i + 1
        high = low + step
        while _count(problem, high, half, shear, rotary, end_mass) < wanted:
            step *= 2.0
            low, high = high, high + step
        start = low
        while True:
            middle = 0.5 * (low + high)
            if middle <= low or middle >= high:
                break
            if _count(problem, middle, half, shear, rotary, end_mass) < wanted:
                low = middle
            else:
                high = middle
        found[i] = 0.5 * (low + high)
        step = max(found[i] - (found[i - 1] if i > 0 else 0.0), 1e-6 * found[i])  # the next may even be the same
        low = start
    return found
