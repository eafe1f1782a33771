"""Points of the map over a real socket, on a cluster that the host has named."""

import asyncio
import signal

import pytest
from distributed import Client

from app.views.whatif import POINTS

from ...patience import SECONDS
from ...solvers.studies.study.test_cluster import Begun, until
from ..servers import Server
from ..socket_client import SocketClient, run
from .test_whatif_socket import answer_to, question

ROWS = [[0.5 + 0.01 * row] for row in range(60)]


@pytest.fixture
def cluster(tmp_path):
    """A scheduler with two workers, its client, and a server that knows its address."""
    begun = Begun(tmp_path)
    try:
        address = begun.all()
        with Client(address, set_as_default=False) as client:
            client.wait_for_workers(2, SECONDS)
            server = Server(tmp_path / "log", "--cluster", address)
            server.start()
            yield client, server, begun
            server.end(signal.SIGTERM)
            server.said_no_trace()
    finally:
        begun.kill()


def parts_of(client):
    """How many parts of questions the scheduler has had."""

    def count(dask_scheduler):
        keys = {each[0] for each in dask_scheduler.transition_log}
        return sum(str(key).startswith("strikewave-") for key in keys)

    return client.run_on_scheduler(count)


@pytest.mark.slow
def test_a_visitor_s_points_are_found_there_and_who_leaves_frees_it(cluster):
    client, server, begun = cluster

    async def visit():
        visitor = await SocketClient(server.address).open("?scene=xylophone-bar")
        await visitor.changes(0.3)
        number = 0
        while not await asyncio.to_thread(parts_of, client):  # until kernels are there, and the cluster is reached
            number += 1
            await visitor.set(POINTS, question(number, ["mass_ratio"], ROWS))
            answer, changed = await answer_to(visitor, number)
            assert [row[0] for row in answer["rows"]] == [0] * len(answer["rows"]) and answer["rows"]
            assert set(changed) <= {"whatif", "waiting", "frame"}  # the scene's own may come as late
        await visitor.set(POINTS, question(number + 1, ["mass_ratio"], ROWS))
        visitor.close()

    run(visit(), SECONDS)
    until(lambda: not any(client.processing().values()) and not any(client.call_stack().values()))
    begun.kill()

    async def visit_again():
        visitor = await SocketClient(server.address).open("?scene=xylophone-bar")
        await visitor.changes(0.3)
        await visitor.set(POINTS, question(1, ["mass_ratio"], ROWS))
        answer, _ = await answer_to(visitor, 1)
        assert answer["rows"]
        visitor.close()

    run(visit_again(), SECONDS)
    until(lambda: "found without the cluster" in server.log.read_text())
    assert server.log.read_text().count("\n") == 2, "the address of the page, and one line of the cluster"
