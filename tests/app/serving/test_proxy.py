"""The proxy of docs/hosting, as it is shipped but for its ports: what an address may do ends there."""

import contextlib
import re
import shutil
import signal
import socket
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from http.client import HTTPConnection

import pytest

from ...patience import SECONDS
from ..servers import ROOT, Server, free_port
from ..socket_client import SocketClient, run

CONFIGURATION = ROOT / "docs/hosting/haproxy.cfg"
HAPROXY = shutil.which("haproxy", path="/usr/sbin:/usr/local/sbin:/usr/bin:/usr/local/bin")
OF_ONE, IN_TEN_SECONDS = 400, 1500  # connections and requests of one address, as the configuration says
HONEST, GREEDY, CLASS = "127.0.0.1", "127.0.0.2", "127.0.0.3"
HEADS = {"127.0.0.4": b"", "127.0.0.5": b"GET / HTTP/1.1\r\nHost: "}  # of who is silent, and who goes no further

pytestmark = [pytest.mark.slow, pytest.mark.skipif(HAPROXY is None, reason="HAProxy is not installed: make haproxy")]


def configured(replaced: dict[str, str]) -> str:
    text = CONFIGURATION.read_text("utf-8")
    for old, new in replaced.items():
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


@pytest.fixture(scope="module")
def proxy(tmp_path_factory):
    """The port of the proxy before a server that believes it."""
    folder, port = tmp_path_factory.mktemp("proxy"), free_port()
    server = Server(folder / "log", "--behind", "127.0.0.1", "--allow-origin", f"127.0.0.1:{port}")
    server.start()
    file = folder / "haproxy.cfg"
    file.write_text(configured({"bind :80 ": f"bind 127.0.0.1:{port} ", "127.0.0.1:5006": server.address}))
    with (folder / "proxy").open("w") as output:
        process = subprocess.Popen([HAPROXY, "-db", "-f", str(file)], stdout=output, stderr=subprocess.STDOUT)
    try:
        deadline = time.monotonic() + 30
        while answered(port) != 200:
            assert process.poll() is None and time.monotonic() < deadline, (folder / "proxy").read_text()
            time.sleep(0.1)
        yield port
    finally:
        process.terminate()
        process.wait(20)
        server.end(signal.SIGTERM)
    assert server.log.read_text().count("\n") < 10, server.log.read_text()  # nothing by the will of strangers


def wire(port, source) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), timeout=60, source_address=(source, 0))


def answered(port, path="/liveness", source=HONEST) -> int | None:
    """The status; None if there is no answer."""
    connection = HTTPConnection("127.0.0.1", port, timeout=SECONDS, source_address=(source, 0))
    with contextlib.closing(connection), contextlib.suppress(OSError):
        connection.request("GET", path)
        return connection.getresponse().status


def is_open(each: socket.socket) -> bool:
    each.setblocking(False)
    try:
        return each.recv(1) != b""
    except BlockingIOError:
        return True
    except OSError:
        return False


def test_the_page_and_its_socket_pass(proxy):
    async def visit():
        client = await SocketClient(f"127.0.0.1:{proxy}").open()
        await client.set("mass_ratio", 2.0)
        await client.answer()
        client.close()

    run(visit())


def test_of_one_address_only_so_many_connections_are_held_and_not_for_long(proxy):
    begun, held = time.monotonic(), {source: [] for source in HEADS}
    try:
        for source, head in HEADS.items():
            for _ in range(OF_ONE + 200):
                with contextlib.suppress(OSError):  # refused at once
                    held[source].append(wire(proxy, source))
                    held[source][-1].sendall(head)
            assert answered(proxy, "/") == 200
            assert answered(proxy, source=source) is None
            refused = time.monotonic() + 5.0  # by when the ends of those that were refused have come
            while sum(map(is_open, held[source])) > OF_ONE:
                assert time.monotonic() < refused
                time.sleep(0.05)
        for source in HEADS:
            while answered(proxy, source=source) != 200:  # a head has 10 s to arrive, a silent connection no more
                assert time.monotonic() < begun + 60
                time.sleep(0.5)
    finally:
        for each in held.values():
            for connection in each:
                connection.close()


def flood(port) -> list[int]:
    """Statuses of many requests, sent before any is answered."""
    with wire(port, GREEDY) as each:
        each.sendall(b"GET /liveness HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n" * (IN_TEN_SECONDS // 4))
        each.shutdown(socket.SHUT_WR)
        return [int(status) for status in re.findall(rb"HTTP/1.1 (\d+)", each.makefile("rb").read())]


def test_a_class_behind_one_address_opens_the_page_at_once_while_another_floods(proxy):
    """The bounds as weapons: they hold for who goes beyond them, and for nobody else."""
    with ThreadPoolExecutor(8) as several:
        statuses = [status for part in several.map(flood, [proxy] * 8) for status in part]
    assert statuses.count(200) < IN_TEN_SECONDS + 100 and statuses.count(429) > 100
    assert answered(proxy, source=HONEST) == 200
    pages = [wire(proxy, CLASS) for _ in range(6 * 50)]
    for each in pages[::6]:
        each.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n")
    assert all(each.recv(12) == b"HTTP/1.1 200" for each in pages[::6])
    for each in pages:
        each.close()
