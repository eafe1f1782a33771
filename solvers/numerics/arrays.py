"""Arrays in kernels, value by value.

Assigned as a whole, or asked for their largest value, Numba compiles the texts of errors with them: seconds, for a
message that nobody will see.
"""

from ..jit.kernels import inner_kernel, kernel


@inner_kernel
def copy_to(target, source):
    """Write the values of `source` (n,) into `target` (n,)."""
    for i in range(source.size):
        target[i] = source[i]


@inner_kernel
def add_to(target, factor, source):
    """Add `factor` times the values of `source` (n,) to `target` (n,)."""
    for i in range(source.size):
        target[i] += factor * source[i]


@kernel
def dot(first, second):
    """Sum of the products of two arrays (n,)."""
    total = 0.0
    for i in range(first.size):
        total += first[i] * second[i]
    return total


@kernel
def largest(values, count):
    """The largest of the first `count` values."""
    found = values[0]
    for i in range(1, count):
        found = max(found, values[i])
    return found
