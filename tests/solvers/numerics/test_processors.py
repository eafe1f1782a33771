"""How many solves run side by side: as many as a container may, or as it is said."""

import os

import pytest

from solvers.numerics import processors as module
from solvers.numerics.processors import WORKERS, _quota, processors
from solvers.validation import SceneError


@pytest.mark.parametrize("wanted, count", [("1", 1), ("7", 7), (" 64 ", 64)])
def test_as_many_as_are_wanted(monkeypatch, wanted, count):
    monkeypatch.setenv(WORKERS, wanted)
    assert processors() == count


@pytest.mark.parametrize("wanted", ["0", "-1", "1.5", "many", "1001", "٣", "9" * 5_000])
def test_what_is_no_number_of_workers_is_refused(monkeypatch, wanted):
    monkeypatch.setenv(WORKERS, wanted)
    with pytest.raises(SceneError) as refused:
        processors()
    assert refused.value.key == WORKERS


@pytest.mark.parametrize(
    "own, of_all, found",
    [
        ("150000 100000", "max 100000", 1.5),
        ("max 100000", "400000 100000", 4.0),
        ("300000 100000", "200000 100000", 2.0),  # the narrowest above it holds too
        ("max 100000", "max 100000", float("inf")),
        ("none", "", float("inf")),
    ],
)
def test_the_quota_of_a_container_counts(tmp_path, own, of_all, found):
    inner = tmp_path / "groups/system/page"
    inner.mkdir(parents=True)
    (inner / "cpu.max").write_text(own + "\n")
    (inner.parent / "cpu.max").write_text(of_all + "\n")
    (tmp_path / "own").write_text("1:name=systemd:/x\n0::/system/page\n")
    assert _quota(tmp_path / "groups", tmp_path / "own") == found


def test_a_quota_bounds_what_is_there(monkeypatch):
    monkeypatch.delenv(WORKERS, raising=False)
    there = len(os.sched_getaffinity(0))
    for quota, count in ((0.3, 1), (1.0, 1), (1e9, there), (float("inf"), there)):
        monkeypatch.setattr(module, "_quota", lambda quota=quota: quota)
        assert processors() == count
    assert _quota(own=module.CGROUPS / "none") == float("inf")
