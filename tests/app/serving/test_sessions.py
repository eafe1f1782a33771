"""What a visit leaves behind: nothing."""

import asyncio
import gc
import threading
import time

import panel as pn
import pytest
from bokeh.document import Document
from panel.io import document

from app.serving import server as page_server
from app.serving.install import install

from ..servers import free_port
from ..socket_client import SocketClient, run

VISITS = 15


def documents() -> int:
    gc.collect()
    return sum(issubclass(type(thing), Document) for thing in gc.get_objects())  # `isinstance` asks dead proxies


def watchers() -> int:
    return sum(len(watching) for kinds in pn.state.param.watchers.values() for watching in kinds.values())


@pytest.mark.slow
def test_fifteen_visits_leave_no_document_behind():
    port, ready, stop, watching = free_port(), threading.Event(), {}, []

    def serve():
        asyncio.set_event_loop(asyncio.new_event_loop())
        server = page_server.build(port, "127.0.0.1", [], unused_lifetime=200)
        server.start()
        stop["loop"] = server.io_loop
        ready.set()
        server.io_loop.start()

    async def visit(count: int) -> int:
        clients = [await SocketClient(f"127.0.0.1:{port}").open() for _ in range(count)]
        await asyncio.gather(*(client.set("mass_ratio", 2.0) for client in clients))
        await asyncio.gather(*(client.answer() for client in clients))
        await asyncio.gather(*(client.set("energy_shown", True) for client in clients))
        await asyncio.gather(*(client.changed("energy") for client in clients))
        alive = documents()
        for client in clients:
            client.close()
        return alive

    async def visits() -> tuple[int, int, int]:
        await visit(2)  # what is made once stays
        before = await forgotten()
        watching.append(watchers())
        alive = await visit(VISITS)
        for _ in range(100):
            after = await forgotten()
            if after <= before:
                break
        return before, alive, after

    async def forgotten() -> int:
        await asyncio.sleep(0.5)
        return documents()

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    assert ready.wait(120)
    try:
        before, alive, after = run(visits())
    finally:
        stop["loop"].add_callback(stop["loop"].stop)
        thread.join(10)
    assert alive > before + VISITS // 2  # so that this test could fail; what others left may go meanwhile
    assert after <= before
    assert [watchers()] == watching  # Panel's own state lives as long as the server: nothing may cling to it


def test_what_visitors_leave_is_cleared_though_others_go_on_leaving(monkeypatch):
    """Else a collection would find all that has been left since, and hold up everybody."""
    install()
    collected = []
    monkeypatch.setattr(document, "_panel_last_cleanup", time.monotonic())
    monkeypatch.setattr(gc, "collect", lambda: collected.append(True))
    document._garbage_collect()
    assert collected
