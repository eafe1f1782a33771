"""Visitors beside each other on one server: what costly, flooding and many others leave to five who move a slider.

The others are a process of their own, which yields to the rest: their machines would not be the server's.
"""

import asyncio
import itertools
import json
import os
import random
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import WebSocketClosedError

from app.serving.limits import MAX_SESSIONS
from app.views.whatif import POINTS
from tests.app.socket_client import SocketClient, run

from .serving import served_page
from .size import of
from .timing import row

BESIDE = (
    ("costly", 0),
    ("costly", 2),
    ("costly", 4),
    ("flooding", 20),
    ("fetching", 20),
    ("mapping", 5),
    ("mapping", 45),
)
LITTLE = (("costly", 0), ("flooding", 1), ("fetching", 1), ("mapping", 1))
HONEST, PERIOD = 5, 0.4  # visitors, and seconds between two changes of each
SECONDS = 10.0  # of each measurement
COSTLY = {"method": "mode-switch", "modes": 200}  # at mass ratios near 1/1000: 7 s of computing each
REST_PERIOD = 2.5  # s between two drags, of which the server sees the end
COVERED = ("", "?law=hertz", "?scene=free-rod", "?scene=hammer-on-cantilever")  # by the kernels that browsers have
MAPPED = "?scene=four-bar"  # its points are found by the server: 20 ms and more each
ROWS = 64  # of points in a question
OPENS = 0.3  # s, until a visitor of a crowd has opened
SCENES = ("", "?law=hertz", "?scene=stepped-rod", "?scene=hammer-on-cantilever")


async def honest(address: str, seconds: float, query: str = "", period: float = PERIOD) -> list[float | None]:
    """Times [s] until each change was answered, None where a newer one was made first."""
    client = await SocketClient(address).open(query)
    await client.fetch()
    await client.changes(of(1.0, 0.3))
    found: list[float | None] = []
    await asyncio.sleep(random.random() * period)
    end = time.monotonic() + seconds
    while (begun := time.monotonic()) < end:
        await client.set("mass_ratio", 0.4 + 2.0 * random.random())
        took = None
        with suppress(TimeoutError):
            await asyncio.wait_for(client.answer(), period * of(25, 1_000))
            took = time.monotonic() - begun
        found.append(took)
        await asyncio.sleep(max(0.0, begun + period - time.monotonic()))
    client.close()
    return found


async def costly(address: str, number: int) -> None:
    """Drags a slider where every answer takes seconds."""
    client = await SocketClient(address).open()
    for name, value in COSTLY.items():
        await client.set(name, value)
    for k in itertools.count():
        await client.set("mass_ratio", 0.001 + 1e-5 * (number + 10 * k))
        await client.changes(0.5)


async def flooding(address: str, number: int) -> None:
    """Sends all that it can, and opens anew when it is turned out."""
    while True:
        with suppress(OSError, ConnectionError, AttributeError, asyncio.TimeoutError, WebSocketClosedError):
            client = await SocketClient(address).open()
            for k in itertools.count():
                await client.set("mass_ratio", 1.0 + (k % 1000) / 1000.0 + number * 1e-6)
                if k % 20 == 0:
                    await asyncio.sleep(0)
        await asyncio.sleep(1.0)


async def fetching(address: str, number: int) -> None:
    """Fetches the page, and nothing more, as quickly as it can."""
    client = AsyncHTTPClient(force_instance=True)
    while True:
        with suppress(OSError):
            await client.fetch(HTTPRequest(f"http://{address}/", request_timeout=60))


async def mapping(address: str, number: int) -> None:
    """Has the server find all points of a map, one question after the other, as the page does."""
    client = await SocketClient(address).open(MAPPED)
    await client.changes(0.5)
    for k in itertools.count(1):
        rows = [[0.2 + 0.01 * n, 1.0 + 1e-3 * (number + 100 * k)] for n in range(ROWS)]
        await client.set(POINTS, json.dumps({"id": k, "names": ["speed", "mass_ratio"], "rows": rows}))
        while True:
            kind, content = await client.receive()
            if kind == "PATCH-DOC" and any(each.get("attr") == "whatif" for each in content.get("events", [])):
                break


KINDS = {"costly": costly, "flooding": flooding, "fetching": fetching, "mapping": mapping}


@contextmanager
def crowd(address: str, kind: str, count: int) -> Iterator[None]:
    """So many visitors of a kind, as long as this context lasts."""
    if not count:
        yield
        return
    others = subprocess.Popen([sys.executable, "-m", __name__, address, kind, str(count)])
    try:
        time.sleep(of(4.0 + OPENS * count, 1.5))
        yield
    finally:
        others.kill()
        others.wait()


async def together(address: str, kind: str, count: int) -> None:
    await asyncio.gather(*(KINDS[kind](address, number) for number in range(count)))


async def five(address: str) -> list[float | None]:
    return list(itertools.chain(*await asyncio.gather(*(honest(address, of(SECONDS, 1.0)) for _ in range(HONEST)))))


def measure() -> dict[str, object]:
    rows = []
    with served_page() as own:
        rows += _beside(own[0])
        if same := of(None, own):  # a small run starts one server
            return dict(rows) | _classes(same) | _dragging(same)
    return dict(rows) | _classes() | _dragging()


def _beside(address: str) -> list:
    """Five honest visitors beside others of each kind."""
    rows = []
    alone: list[float] = []
    for kind, count in of(BESIDE, LITTLE):
        with crowd(address, kind, count):
            times = sorted(each for each in run(five(address)) if each is not None)
        alone, name = alone or times, f"{count} {kind}" if count else "nobody"
        middle, late = (1e3 * times[int(share * len(times))] for share in (0.5, 0.95))
        rows.append(row(f"answers to five beside {name}", len(times) / len(alone), "of alone", ">= 0.6"))
        rows.append(row(f"an answer beside {name}, p50", middle, "ms"))
        rows.append(row(f"an answer beside {name}, p95", late, "ms"))
        rows.append(row(f"p95 beside {name}", late / (1e3 * alone[int(0.95 * len(alone))]), "of alone", "<= 3"))
    return rows


def _dragging(known: tuple[str, int] | None = None) -> dict[str, object]:
    """A whole class that drags what browsers answer: the server is asked once a hand rests."""
    rows = []
    seconds = of(SECONDS, 1.0)
    for sessions, most in of(((50, 150), (MAX_SESSIONS, 500)), ((4, 500),)):
        with served_page(known) as (address, _):

            async def visit(address: str = address, sessions: int = sessions) -> list[list[float | None]]:
                queries = [COVERED[k % len(COVERED)] for k in range(sessions)]
                return await asyncio.gather(*(honest(address, seconds, query, REST_PERIOD) for query in queries))

            found = list(itertools.chain(*run(visit())))
            times = sorted(each for each in found if each is not None)
            late = 1e3 * times[int(0.95 * len(times))]
            rows.append(row(f"{sessions} visitors who drag what browsers answer: p95", late, "ms", f"<= {most}"))
    return dict(rows)


def _classes(known: tuple[str, int] | None = None) -> dict[str, object]:
    """A whole class, each visitor with two changes a second, scenes mixed."""
    rows = []
    seconds = of(SECONDS, 1.0)
    for sessions in of((10, 25, 50, 100), (4,)):
        with served_page(known) as (address, _):

            async def visit(address: str = address, sessions: int = sessions) -> list[list[float | None]]:
                begun = time.monotonic()
                opened = await asyncio.gather(*(SocketClient(address).open() for _ in range(sessions)))
                rows.append(row(f"{sessions} visitors open at once", time.monotonic() - begun, "s"))
                await asyncio.gather(*(client.fetch() for client in opened))
                rows.append(row(f"{sessions} visitors open at once, with all files", time.monotonic() - begun, "s"))
                for client in opened:
                    client.close()
                queries = [SCENES[k % len(SCENES)] for k in range(sessions)]
                return await asyncio.gather(*(honest(address, seconds, query) for query in queries))

            found = list(itertools.chain(*run(visit())))
            times = sorted(each for each in found if each is not None)
            rows.append(row(f"{sessions} visitors: answers", len(times) / seconds, "/s"))
            rows.append(row(f"{sessions} visitors: p50", 1e3 * statistics.median(times), "ms"))
            rows.append(row(f"{sessions} visitors: p95", 1e3 * times[int(0.95 * len(times))], "ms"))
    return dict(rows)


if __name__ == "__main__":
    os.nice(10)
    asyncio.run(together(sys.argv[1], sys.argv[2], int(sys.argv[3])))
