"""A study in a zarr store is the same study, whoever writes its regions, however often it is interrupted."""

import json
from types import SimpleNamespace

import numpy as np
import pytest
import xarray
from distributed import Client

from solvers import SceneError, study
from solvers.notebook import study_tables
from solvers.notebook.datasets import read_study
from solvers.notebook.study_tables import summary
from solvers.studies.study import stored
from solvers.studies.study.parts import Parts, Receipt
from solvers.studies.study.stored import Regions, receipts

from .test_cluster import begun
from .test_study import VARY, same

GRID = {"impactor.mass": "0.5..5:40", "impactor.velocity": "0.5..3:50"}
QUICK = {"notes": False, "figures": ["peak_force", "contact_time"]}
MIXED = {
    "impactor.velocity": "0.5..3:31",
    "contact.law": ["rigid", "hertz", "nonsense"],
    "impactor.mass,target.length": [(1, 1), (2, 3)],
}


@pytest.fixture
def small(monkeypatch):
    """Blocks of few points."""
    for name, value in {"SMALLEST": 1, "BLOCKS": 10**9}.items():
        monkeypatch.setattr(stored, name, value)

    def of(most: int) -> None:
        monkeypatch.setattr(stored, "SMALLEST", most)

    return of


@pytest.fixture
def kept(monkeypatch):
    """What comes back, by span."""
    found, keep = {}, Regions.keep

    def note(self, span, part):
        found[span] = part
        keep(self, span, part)

    monkeypatch.setattr(Regions, "keep", note)
    return found


@pytest.mark.parametrize(
    "scene, options",
    [
        ("bronze-rod-steel-ball", {"vary": VARY}),
        ("fixed-rod", {"vary": {"impactor.mass": "0.5..5:9", "impactor.velocity": "0.5..3:21"}, **QUICK}),
        ("bronze-rod-steel-ball", {"vary": MIXED}),
        ("fixed-rod", {"vary": {"impactor.mass": "5%", "impactor.velocity": "uniform(1,2)"}, "points": 101}),
        ("fixed-rod", {"vary": {"method.name": ["waves", "modal", "rigid"]}}),
    ],
)
@pytest.mark.parametrize("most", [9, 10_000])
def test_it_is_the_one_in_memory(tmp_path, small, scene, options, most):
    small(most)
    path, whole = tmp_path / "map.zarr", study(scene, **options, workers=2)
    found = study(scene, **options, out=path, workers=2)
    assert same(found, whole) and list(found.data_vars) == list(whole.data_vars) and found.attrs == whole.attrs
    assert [each.name for each in tmp_path.iterdir()] == ["map.zarr"]
    assert same(read_study(path), whole) and summary(read_study(path)) == summary(whole)
    with xarray.open_zarr(path, chunks=None, consolidated=False) as plain:
        assert set(plain.variables) == set(whole.variables) and plain.sizes == whole.sizes
        for name, array in plain.variables.items():
            assert array.attrs == whole[name].attrs and array.dims == whole[name].dims
            assert array.values.astype(object).astype(str).tolist() == whole[name].values.astype(str).tolist()


def test_whole_blocks_are_written_by_who_solves_them(tmp_path, small, kept):
    small(100)
    found = study("fixed-rod", GRID, **QUICK, out=tmp_path / "map.zarr", workers=2)
    receipted = [span for span, part in kept.items() if isinstance(part, Receipt)]
    assert len(receipted) >= 10 and all((start % 100, stop - start) == (0, 100) for start, stop in receipted)
    assert all(stop - start < 100 for start, stop in kept.keys() - set(receipted))
    assert same(found, study("fixed-rod", GRID, **QUICK, workers=1))


@pytest.mark.parametrize("seen", [True, False])
def test_workers_of_a_cluster_write_where_they_see_the_folder(tmp_path, small, kept, monkeypatch, seen):
    small(100)
    if not seen:  # as where another disk has that path
        begin = Regions.begin

        def elsewhere(self, *given):
            begin(self, *given)
            (self.folder / stored.TOKEN).write_text("of another study")

        monkeypatch.setattr(Regions, "begin", elsewhere)
    with begun(2) as there, Client(there, set_as_default=False) as client:
        found = study("fixed-rod", GRID, **QUICK, out=tmp_path / "map.zarr", cluster=client)
    whole = [part for (start, stop), part in kept.items() if stop - start == 100]
    assert len(whole) >= 10 and all(isinstance(part, Receipt) is seen for part in whole)
    assert same(found, study("fixed-rod", GRID, **QUICK, workers=1))


@pytest.mark.parametrize("most", [7, 1000])
def test_a_study_that_was_cancelled_goes_on(tmp_path, small, kept, most):
    small(most)
    path, solved = tmp_path / "map.zarr", []
    vary = {"impactor.velocity": "0.5..3:200", "contact.law": ["rigid", "hertz"]}

    def stop():
        return bool(solved) and solved[-1].done >= 30

    part = study("bronze-rod-steel-ball", vary, out=path, workers=1, progress=solved.append, cancelled=stop)
    there = int((part.refused == "").sum())
    assert 30 <= there == solved[-1].done < 400 and int((part.refused == "not-solved").sum()) == 400 - there
    force = part.peak_force.values.ravel()
    assert np.isfinite(force[:there]).all() and np.isnan(force[there:]).all()
    assert json.loads(part.attrs["sentences"]) and not path.exists()
    before = dict(kept)
    kept.clear()
    whole = study("bronze-rod-steel-ball", vary, out=path, resume=True, workers=2, progress=solved.append)
    assert solved[-1].resumed == there and sum(stop - start for start, stop in kept) == 400 - there
    assert not before.keys() & kept.keys()
    assert same(whole, study("bronze-rod-steel-ball", vary, workers=2)) and not (tmp_path / "map.zarr.parts").exists()


def test_what_was_cut_off_as_it_was_written_is_solved_again(tmp_path, small, kept):
    """A line without its end, a part in the middle of its renaming, or no store at all."""
    small(100)
    path, solved, parts = tmp_path / "map.zarr", [], tmp_path / "map.zarr.parts"
    call = {"out": path, "workers": 1, "progress": solved.append, **QUICK}
    study("fixed-rod", GRID, **call, cancelled=lambda: bool(solved) and solved[-1].done >= 500)
    done = solved[-1].done
    torn = max((parts / "receipts").iterdir(), key=lambda each: each.stat().st_size)
    torn.write_bytes(torn.read_bytes()[:-5])
    stray = parts / "store.zarr" / "peak_force" / "c" / "0.partial"
    stray.write_bytes(b"half")
    kept.clear()
    study("fixed-rod", GRID, **call, resume=True, cancelled=lambda: True)
    assert solved[-1].resumed == done - 100 and not stray.exists() and not kept
    (parts / "store.zarr").rename(tmp_path / "away")
    found = study("fixed-rod", GRID, **call, resume=True)
    assert solved[-1].resumed == 0 and same(found, study("fixed-rod", GRID, **QUICK, workers=1))


def test_a_block_whose_parts_are_all_there_is_put_together(tmp_path, small, monkeypatch):
    """It ended after the last of them, before the block was written."""
    small(1000)
    path, vary, put = tmp_path / "map.zarr", {"impactor.velocity": "0.5..3:60"}, stored.put

    def full(*given):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(stored, "put", full)
    with pytest.raises(OSError, match="No space"):
        study("bronze-rod-steel-ball", vary, out=path, workers=1)
    parts = Parts(tmp_path / "map.zarr.parts")
    assert sum(stop - start for start, stop in parts.spans()) == 60 and receipts(parts.folder) == {}
    monkeypatch.setattr(stored, "put", put)
    seen = []
    found = study("bronze-rod-steel-ball", vary, out=path, resume=True, progress=seen.append)
    assert seen[0].resumed == 60 and same(found, study("bronze-rod-steel-ball", vary))


def test_of_a_billion_points_nobody_holds_all(tmp_path):
    path, solved = tmp_path / "map.zarr", []
    vary = {"impactor.mass": "0.5..5:1000", "impactor.velocity": "0.5..3:1000", "target.length": "0.5..3:1000"}

    def stop():
        return bool(solved) and solved[-1].done >= 20_000

    found = study("fixed-rod", vary, out=path, progress=solved.append, cancelled=stop, **QUICK)
    assert found.refused.size == 10**9 and not found.peak_force.variable._in_memory
    done = solved[-1].done
    first = found.refused[0].values.ravel()
    assert int((first == "").sum()) == done and (first != "").sum() == 10**6 - done
    assert str(found.refused[-1, -1, -1].values) == "not-solved"
    with pytest.raises(SceneError, match="differs in: design"):
        study("fixed-rod", vary | {"target.length": "0.5..3:999"}, out=path, resume=True, **QUICK)


def test_too_many_are_refused_with_what_they_cost(tmp_path, monkeypatch):
    keys = ("impactor.mass", "impactor.velocity", "target.length", "target.area")
    vary = {key: "1..2:1000" for key in keys}
    cost = r"1e\+12 points.*at most 1e\+07 points, or .*1e\+10; these would take 8 TB .* 231 days"
    for out in (None, tmp_path / "map.nc", tmp_path / "map.zarr"):
        with pytest.raises(SceneError, match=cost):
            study("fixed-rod", vary, out=out)
    vary = {key: "1..2:1000" for key in keys[:3]}
    with pytest.raises(SceneError, match="at most"):
        study("fixed-rod", vary, out=tmp_path / "map.nc")
    monkeypatch.setattr(stored.shutil, "disk_usage", lambda path: SimpleNamespace(free=10**9))
    with pytest.raises(SceneError, match=r"out: .*16 GB free.*it has 1 GB"):
        study("fixed-rod", vary, out=tmp_path / "map.zarr", **QUICK)
    assert list(tmp_path.iterdir()) == []


def test_the_summary_is_the_same_in_stretches(tmp_path, monkeypatch):
    found = study("bronze-rod-steel-ball", MIXED)
    whole = summary(found)
    assert whole["refused"] == 62 and whole["notes"] and whole["figures"]
    for stretch in (1, 10, 50):
        monkeypatch.setattr(study_tables, "STRETCH", stretch)
        assert summary(found) == whole
