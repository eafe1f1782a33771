"""Points on a cluster that is there: what it finds, what ends on it, and what is left when it is killed."""

import asyncio
import json
import logging
import os
import signal

import pytest
from distributed import Client

from app.jobs import spread as spread_room
from app.views.whatif import whatif_data
from solvers.studies.study import cluster as cluster_room

from ...patience import SECONDS
from ...solvers.studies.study.test_cluster import Begun
from ..socket_client import run
from .test_spread import ask, asked, connected, until

SLOW_ONES = """
import time
from app.jobs import cluster_part

def endless(asked, given_up=None):
    while given_up and {goes_on}:
        time.sleep(0.01)
    return "null"

cluster_part.whatif_data, cluster_part.END_WITHIN = endless, 0.1
"""


@pytest.fixture
def loud(caplog):
    caplog.set_level(logging.WARNING, "strikewave")
    return caplog


@pytest.mark.slow
def test_a_cluster_finds_what_the_page_does(own, monkeypatch):
    monkeypatch.setattr(spread_room, "PATIENCE", SECONDS)
    whole, rows = json.loads(whatif_data(asked())), []  # and all kernels are there

    async def main():
        async with connected("local:2"):
            while len(rows) < len(whole["rows"]):  # as many at a time as are found in time
                found = json.loads(await ask(asked()).answer)
                assert len(found["rows"]) >= 1 and found["chosen"] == whole["chosen"]
                rows[: len(found["rows"])] = found["rows"]

    run(main(), SECONDS)
    assert rows[: len(whole["rows"])] == whole["rows"] and own == []


@pytest.mark.slow
@pytest.mark.parametrize("hears", [True, False])
def test_what_nobody_wants_ends_on_its_workers(own, tmp_path, monkeypatch, hears):
    slow = tmp_path / "slow.py"
    slow.write_text(SLOW_ONES.format(goes_on="not given_up()" if hears else "True"))
    monkeypatch.setattr(cluster_room, "PRELOAD", [*cluster_room.PRELOAD, str(slow)])
    monkeypatch.setattr(spread_room, "PATIENCE", SECONDS)

    async def main():
        async with connected("local:2") as spread:
            client, loop = spread._cluster.client, asyncio.get_running_loop()

            async def there(call):
                return await loop.run_in_executor(None, call)

            async def busy():
                try:
                    return any((await there(client.call_stack)).values())
                except OSError:  # of one that has ended meanwhile
                    return True

            before = set((await there(lambda: client.run(os.getpid))).values())
            job = ask(asked())
            while not await busy():
                await asyncio.sleep(0.05)
            job.answer.cancel()
            while await busy() or len(await there(client.nthreads)) < 2:
                await asyncio.sleep(0.05)
            after = set((await there(lambda: client.run(os.getpid))).values())
            assert (after == before) == hears, "who does not hear is ended, and another begun"

    run(main(), SECONDS)


@pytest.mark.slow
def test_a_scheduler_that_is_killed_is_done_without_and_found_again(own, loud, tmp_path, monkeypatch):
    monkeypatch.setattr(spread_room, "AGAIN", 0.2)
    monkeypatch.setattr(spread_room, "PATIENCE", SECONDS)
    whatif_data(asked())  # all kernels are there
    begun = Begun(tmp_path)
    address = begun.all()

    async def main():
        async with connected(address) as spread:
            await until(lambda: spread._cluster.threads == 2)
            assert json.loads(await ask(asked()).answer)["rows"] and own == []
            begun.processes[0].send_signal(signal.SIGKILL)
            begun.processes[0].wait()
            while own == []:
                await ask(asked()).answer
            await until(lambda: len(loud.records) == 1)
            begun.kill()
            port = address.rpartition(":")[2]
            begun.begin("scheduler", "--port", port, "--dashboard-address", "127.0.0.1:0")
            begun.begin("worker", address, "--nthreads", "1", "--nworkers", "1", "--no-dashboard")
            await until(lambda: spread._cluster is not None)
            had = len(own)
            while not (await ask(asked()).answer).startswith("{"):
                await asyncio.sleep(0.1)
            assert len(loud.records) == 2 and had >= 1

    try:
        run(main(), SECONDS)
    finally:
        begun.kill()


@pytest.mark.slow
def test_a_cluster_that_is_left_keeps_nothing(own, tmp_path, monkeypatch):
    begun = Begun(tmp_path)
    address = begun.all()

    async def main():
        async with connected(address) as spread:
            await until(lambda: spread._cluster.threads == 2)
            ask(asked())
            await until(lambda: any(each._future for each in spread._out))

    try:
        run(main(), SECONDS)
        with Client(address, set_as_default=False) as client:
            run(until(lambda: not any(client.processing().values()) and not client.who_has()))
    finally:
        begun.kill()
