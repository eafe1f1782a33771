"""Small systems of linear equations, by elimination with pivots."""

from ...jit.kernels import inner_kernel


@inner_kernel
def decompose(matrix, order):
    """Factors of a small matrix (n, n), in its place, by elimination with pivots, and their `order` (n,)."""
    count = order.size
    for k in range(count):
        pivot = k
        for i in range(k + 1, count):
            if abs(matrix[i, k]) > abs(matrix[pivot, k]):
                pivot = i
        order[k] = pivot
        for j in range(count):
            matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
        inverse = 1.0 / matrix[k, k]
        for i in range(k + 1, count):
            matrix[i, k] *= inverse
            for j in range(k + 1, count):
                matrix[i, j] -= matrix[i, k] * matrix[k, j]


@inner_kernel
def resolve(matrix, order, right):
    """Solution in place of `right` (n,), by these factors."""
    count = right.size
    for k in range(count):
        pivot = order[k]
        right[k], right[pivot] = right[pivot], right[k]
    for k in range(count):
        for j in range(k):
            right[k] -= matrix[k, j] * right[j]
    for k in range(count - 1, -1, -1):
        for j in range(k + 1, count):
            right[k] -= matrix[k, j] * right[j]
        right[k] /= matrix[k, k]
