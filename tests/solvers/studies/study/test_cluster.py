"""A study on a cluster is the same study, whoever comes, goes or dies meanwhile."""

import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from contextlib import closing
from pathlib import Path

import dask
import numpy as np
import pytest
from distributed import Client, LocalCluster

from solvers import SceneError, load, study
from solvers.methods.quasi_static.method import QuasiStatic
from solvers.studies.study import cluster as cluster_room
from solvers.studies.study.cluster import cluster_of
from solvers.studies.study.parts import Parts
from solvers.studies.study.work import CRASHED, Work

from ....patience import SECONDS
from .test_study import VARY, runs, same

ROOT = Path(__file__).parents[4]
SCENE, MANY = "bronze-rod-steel-ball", {"impactor.velocity": "0.5..3:400"}
ANOTHER = """
from solvers import provenance
provenance.version = lambda: "0.0.1+another"
"""
DEADLY = """
import os, signal
from solvers.studies.study import work

def figures_of(solution, names):
    if solution.scene.impactor.velocity in (2.0, 17.0):
        os.kill(os.getpid(), signal.SIGKILL)
    return [solution.scene.impactor.velocity] * len(names)

work.figures_of = figures_of
"""


def begun(count: int) -> LocalCluster:
    anywhere = {"dashboard_address": "127.0.0.1:0"}
    return LocalCluster(
        n_workers=count, threads_per_worker=1, dashboard_address=None, scheduler_kwargs=anywhere, memory_limit=0
    )


@pytest.fixture(scope="module")
def client():
    with begun(2) as there, Client(there, set_as_default=False) as found:
        yield found


def until(true) -> None:
    deadline = time.monotonic() + SECONDS
    while not true():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_nothing_hangs_on_who_solves_it(client):
    one = study(SCENE, VARY, workers=1)
    assert same(one, study(SCENE, VARY, cluster=client))
    assert same(one, study(SCENE, VARY, cluster=client.scheduler.address))
    assert client.status == "running"


def test_a_cluster_that_was_there_is_left_as_it_was(client, tmp_path):
    solved, path = [], tmp_path / "map.nc"

    def stop():
        return bool(solved) and solved[-1].done >= 10

    part = study(SCENE, MANY, out=path, cluster=client, progress=solved.append, cancelled=stop)
    assert 10 <= int((part.refused == "").sum()) < 400
    until(lambda: not any(client.call_stack().values()) and not any(client.processing().values()))
    assert client.futures == {} and len(client.nthreads()) == 2
    whole = study(SCENE, MANY, out=path, resume=True, cluster=client)
    assert same(whole, study(SCENE, MANY, workers=2))


def test_an_own_method_goes_there(client):
    class Own(QuasiStatic):  # which no worker could import
        def solve_in_full(self, scene, duration):
            return super().solve_in_full(scene.replace({"impactor.velocity": 1.0}), duration)

    vary = {"impactor.velocity": [1.0, 2.0]}
    found, usual = (study("fixed-rod", vary, method=each, cluster=client) for each in (Own(), QuasiStatic()))
    assert found.peak_force.values.tolist() == [float(usual.peak_force[0])] * 2 and (found.refused == "").all()


def test_what_no_worker_can_load_is_one_line(client):
    class Own(QuasiStatic):
        def __reduce__(self):
            return eval, ("__import__('nowhere_to_be_found')",)

    with pytest.raises(SceneError, match=r"can load all .* \(ModuleNotFoundError: No module named 'nowhere_to_be"):
        study("fixed-rod", {"impactor.velocity": [1.0, 2.0]}, method=Own(), cluster=client)


def test_a_point_that_ends_its_process_is_found_and_left(tmp_path, monkeypatch):
    deadly = tmp_path / "deadly.py"
    deadly.write_text(DEADLY)
    monkeypatch.setattr(cluster_room, "PRELOAD", [*cluster_room.PRELOAD, str(deadly)])
    found = study("fixed-rod", {"impactor.velocity": [float(k) for k in range(1, 31)]}, cluster="local:2")
    bad = [k for k, code in enumerate(found.refused.values.tolist(), 1) if code]
    assert bad == [2, 17] and set(found.refused.values[[1, 16]].tolist()) == {CRASHED}
    assert np.nansum(found.peak_force.values) == sum(range(1, 31)) - 19


def test_processes_that_are_slow_to_begin_again_are_waited_for(tmp_path, monkeypatch):
    deadly = tmp_path / "deadly.py"
    deadly.write_text(f"import time\ntime.sleep(2.0)\n{DEADLY}")
    monkeypatch.setattr(cluster_room, "PRELOAD", [*cluster_room.PRELOAD, str(deadly)])
    work = Work(load("fixed-rod"), ("impactor.velocity",), ("peak_force",), None, True)
    given_up = {"distributed.deploy.lost-worker-timeout": "100ms"}  # by Dask, 15 s as it comes
    with dask.config.set(given_up), closing(cluster_of("local:1")) as crew:
        assert crew.alone(work, [(2.0,)]) is None
        assert crew.submit(work, [(3.0,)]).result(SECONDS).figures.tolist() == [[3.0]]


def test_workers_come_and_go_and_none_of_another_version(tmp_path, monkeypatch):
    monkeypatch.setattr(cluster_room, "COUNT", 0.0)
    another = tmp_path / "another.py"
    another.write_text(ANOTHER)
    with begun(1) as there, Client(there, set_as_default=False) as client:
        crew = cluster_of(client)
        assert crew.workers == 1
        there.scale(2)
        until(lambda: crew.workers == 2)
        there.scale(0)
        until(lambda: client.nthreads() == {})
        assert crew.workers == 1  # for those that may come
        crew.close()
        there.new_spec["options"]["preload"] = [str(another)]
        late = []  # comes once the study has begun

        def report(now):
            if not late:
                late.append(now)
                there.scale(1)

        for call in ({"progress": report}, {}):
            with pytest.raises(SceneError, match=r"Strikewave .*, as here; tcp://.* has 0\.0\.1\+another"):
                study(SCENE, MANY, cluster=client, **call)


@pytest.mark.parametrize(
    "said", ["nonsense", "local", "local:", "local:0", "local:1001", "local:two", "tcp://", "tcp://host", 3, True, ""]
)
def test_what_is_no_cluster_is_refused(tmp_path, said):
    with pytest.raises(SceneError, match=r"cluster: got .*; allowed: tcp://HOST:PORT") as refused:
        study("fixed-rod", {"impactor.velocity": [1.0, 2.0]}, cluster=said, out=tmp_path / "map.nc")
    assert refused.value.key == "cluster" and list(tmp_path.iterdir()) == []


def test_workers_and_a_cluster_are_too_many():
    with pytest.raises(SceneError, match="workers: got 2; allowed: nothing beside cluster"):
        study("fixed-rod", {"impactor.velocity": [1.0, 2.0]}, cluster="local:2", workers=2)


@pytest.mark.parametrize("kind", ["closed", "mute", "another"])
def test_what_does_not_answer_is_refused_soon(kind, tmp_path):
    server, before = socket.create_server(("127.0.0.1", 0)), set(threading.enumerate())
    address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
    if kind == "closed":
        server.close()
    if kind == "another":

        def answer():
            found = server.accept()[0], server.accept()[0]
            found[1].sendall(b"220 mail\r\n" * 3)
            found[1].close()

        threading.Thread(target=answer, daemon=True).start()
    begun = time.monotonic()
    with pytest.raises(SceneError, match=f"got '{address}'; allowed: the address of a Dask scheduler"):
        study("fixed-rod", {"impactor.velocity": [1.0, 2.0]}, cluster=address, out=tmp_path / "map.nc")
    assert time.monotonic() - begun < 15.0 and list(tmp_path.iterdir()) == []
    server.close()
    until(lambda: set(threading.enumerate()) <= before)


def test_without_dask_it_says_what_to_install(monkeypatch):
    monkeypatch.setattr(cluster_room, "find_spec", lambda name: None)
    with pytest.raises(SceneError, match=r"pip install 'strikewave\[cluster\]'"):
        study("fixed-rod", {"impactor.velocity": [1.0, 2.0]}, cluster="local:2")


def children_of(process: subprocess.Popen) -> list[str]:
    """Numbers of the processes that any of its threads has begun."""
    return " ".join(path.read_text() for path in Path(f"/proc/{process.pid}/task").glob("*/children")).split()


def command(*arguments: str, **options) -> subprocess.Popen:
    call = [sys.executable, "-m", "app.command", "study", SCENE, *arguments]
    return subprocess.Popen(call, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)


@pytest.mark.slow
def test_processes_begun_here_are_quiet_and_stay_among_themselves():
    done = command("--vary", "impactor.velocity=1,2,3", "--cluster", "local:2", "--json")
    out, err = done.communicate(timeout=SECONDS)
    assert (done.returncode, err) == (0, "") and json.loads(out)["solved"] == 3


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="by /proc, and a signal")
def test_an_interrupt_of_all_keeps_what_is_done_and_leaves_no_process(tmp_path):
    path = tmp_path / "map.csv"
    found = command(
        *("--vary", "impactor.velocity=0.5..3:20000", "--cluster", "local:2", "--out", str(path)),
        start_new_session=True,  # a terminal sends the signal to the whole group
    )
    try:
        until(lambda: len(list(tmp_path.glob("map.csv.parts/*.npz"))) >= 3 or found.poll() is not None)
        workers = children_of(found)
        os.killpg(found.pid, signal.SIGINT)
        out, err = found.communicate(timeout=SECONDS)
    finally:
        found.kill()
    assert workers and found.returncode == 130 and "still to do" in out and "--resume goes on" in err
    assert err.count("\n") == 1 and not path.exists()
    until(lambda: not any(runs(pid) for pid in workers))


class Begun:
    """A scheduler and workers, as they are begun by hand; ended by their numbers."""

    def __init__(self, folder: Path):
        self.file, self.processes = folder / "scheduler.json", []

    def begin(self, kind: str, *arguments: str) -> subprocess.Popen:
        call = [sys.executable, "-m", f"distributed.cli.dask_{kind}", "--host", "127.0.0.1", *arguments]
        with (self.file.parent / f"{kind}.log").open("a") as log:
            found = subprocess.Popen(call, cwd=ROOT, stdout=log, stderr=log)
        self.processes.append(found)
        return found

    def all(self) -> str:
        """Its address, once it has two workers."""
        self.file.unlink(missing_ok=True)
        self.begin("scheduler", "--port", "0", "--dashboard-address", "127.0.0.1:0", "--scheduler-file", str(self.file))
        until(lambda: self.file.exists() and self.file.read_text().strip().endswith("}"))
        address = json.loads(self.file.read_text())["address"]
        for _ in range(2):
            self.begin("worker", address, "--nthreads", "1", "--nworkers", "1", "--no-dashboard")
        return address

    def kill(self) -> None:
        for each in self.processes:
            each.kill()
            each.wait()
        self.processes = []


@pytest.fixture
def by_hand(tmp_path):
    begun = Begun(tmp_path)
    yield begun
    begun.kill()


def solver_of(nanny: subprocess.Popen) -> int:
    """The number of the process that a worker's guard has begun, which solves."""
    return next(int(pid) for pid in children_of(nanny) if b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes())


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="by /proc")
def test_killed_one_by_one_and_all_together_it_ends_as_if_nothing_had_been(tmp_path, by_hand):
    path, parts = tmp_path / "map.nc", tmp_path / "map.nc.parts"
    vary, figures = {"impactor.velocity": "0.5..3:20000"}, ["peak_force", "contact_time"]
    call = ("--vary", "impactor.velocity=0.5..3:20000", "--out", str(path), "--no-notes", "--method", "rigid")
    call += ("--figure", "peak_force", "--figure", "contact_time")

    def done() -> int:
        return sum(stop - start for start, stop in Parts(parts).spans())

    first = command(*call, "--cluster", by_hand.all())
    by_hand.processes.append(first)
    until(lambda: done() > 1000 or first.poll() is not None)
    assert first.poll() is None
    os.kill(solver_of(by_hand.processes[1]), signal.SIGKILL)
    before = done()
    until(lambda: done() > before + 1000 or first.poll() is not None)
    by_hand.kill()
    there = done()
    assert 2000 < there < 20_000 and not path.exists()
    again = command(*call, "--cluster", by_hand.all(), "--resume", "--json")
    by_hand.processes.append(again)
    out, err = again.communicate(timeout=SECONDS)
    assert (again.returncode, err) == (0, "")
    known = json.loads(out)
    assert known["resumed"] == there and known["solved"] == 20_000 and not parts.exists()
    whole = study(SCENE, vary | {"method.name": ["rigid"]}, figures=figures, notes=False, out=path, resume=True)
    assert same(whole, study(SCENE, vary | {"method.name": ["rigid"]}, figures=figures, notes=False, workers=2))


@pytest.mark.slow
def test_a_scheduler_that_ends_is_one_line_and_keeps_what_is_done(tmp_path, by_hand):
    found = command(
        "--vary", "impactor.velocity=0.5..3:20000", "--out", str(tmp_path / "map.nc"), "--cluster", by_hand.all()
    )
    by_hand.processes.append(found)
    until(lambda: len(list(tmp_path.glob("map.nc.parts/*.npz"))) >= 3 or found.poll() is not None)
    by_hand.processes[0].kill()
    out, err = found.communicate(timeout=SECONDS)
    assert (found.returncode, out) == (2, "") and err.count("\n") == 1 and "a scheduler that stays" in err
