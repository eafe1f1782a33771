"""Blocks of points: each point in one of them, and each of them one chunk of the arrays."""

import math

import numpy as np
import pytest
import xarray

from solvers.notebook.regions import Blocks, add_arrays, blocks_of, write_region

SHAPES = [(1,), (7,), (100_000,), (3, 5), (5, 1, 1), (1, 1, 500), (2, 3, 4, 5), (40, 7), (2, 1001), (1000, 3, 7)]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("most", [1, 6, 100, 10**6])
def test_blocks_are_one_after_the_other_and_each_is_a_region(shape, most):
    blocks = blocks_of(shape, most)
    numbers, ends = np.arange(math.prod(shape)).reshape(shape), [0]
    for start, stop in blocks:
        assert start == ends[-1] and 0 < stop - start <= most
        region = blocks.region((start, stop))
        assert numbers[region].ravel().tolist() == list(range(start, stop))
        assert all(
            each.start % size == 0 and each.stop <= each.start + size
            for each, size in zip(region, blocks.chunk, strict=True)
        )
        assert blocks.of(start) == blocks.of(stop - 1) == (start, stop)
        ends.append(stop)
    assert ends[-1] == numbers.size


def test_far_points_have_blocks_too():
    blocks = blocks_of((10_000, 10_000, 100), 20_000)
    start, stop = blocks.of(9_999_999_999)
    assert (blocks.chunk, start, stop) == ((1, 200, 100), 9_999_980_000, 10_000_000_000)
    assert blocks.region((start, stop)) == (slice(9_999, 10_000), slice(9_800, 10_000), slice(0, 100))


def test_what_is_not_written_is_not_solved(tmp_path):
    path, blocks = tmp_path / "a.zarr", Blocks((4, 3), 0, 2)
    xarray.Dataset(coords={"a": np.arange(4.0), "b": np.arange(3.0)}).to_zarr(path, consolidated=False)
    add_arrays(path, ("a", "b"), blocks, {"peak_force": "N"})
    words = {"refused": np.array(["", "failed"] * 3), "reason": np.array(["", "why"] * 3), "notes": np.full(6, "")}
    write_region(path, blocks.region((6, 12)), {"peak_force": np.arange(6.0)} | words)
    found = xarray.open_zarr(path, chunks=None, consolidated=False)
    assert found.refused.values.ravel().tolist() == ["not-solved"] * 6 + ["", "failed"] * 3
    assert found.reason.values.ravel().tolist() == [""] * 6 + ["", "why"] * 3
    assert np.isnan(found.peak_force.values[:2]).all() and found.peak_force.values[2:].ravel().tolist() == [*range(6)]
    assert found.peak_force.dims == ("a", "b") and found.peak_force.attrs["units"] == "N"
