"""Arrays in kernels, value by value.

Assigned as a whole, or asked for their largest value, Numba compiles the texts of errors with them: seconds, for a
message that nobody will see.
"""

from ..jit.kernels import inner_kernel


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


@inner_kernel
def dot(first, second):
    """Sum of the products of two arrays (n,)."""
    total = 0.0
    for i in range(first.size):
        total += first[i] * second[i]
    return total


@inner_kernel
def largest(values, count):
    """The largest of the first `count` values."""
    found = values[0]
    for i in range(1, count):
        found = max(found, values[i])
    return found


@inner_kernel
def multiply(found, matrix, vector):
    """Write the product of `matrix` (m, n) and `vector` (n,) into `found` (m,)."""
    for i in range(matrix.shape[0]):
        found[i] = dot(matrix[i], vector)


@inner_kernel
def multiply_by(found, vector, matrix):
    """Write the product of `vector` (m,) and `matrix` (m, n) into `found` (n,)."""
    for j in range(matrix.shape[1]):
        found[j] = 0.0
    for i in range(matrix.shape[0]):
        add_to(found, vector[i], matrix[i])
