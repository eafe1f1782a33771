"""Connections without a session: no more than there are files for; whose address has most gives way."""

import resource
import time
from collections import Counter
from typing import Any

from tornado.httpserver import HTTPServer
from tornado.iostream import IOStream

from .addresses import key_of
from .limits import FILES, MAX_CONNECTIONS


def room() -> int:
    """Allow this process as many open files as it may have; how many connections that leaves room for."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    if 0 <= soft < FILES:
        soft = FILES if hard == resource.RLIM_INFINITY else min(FILES, hard)
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))
    return MAX_CONNECTIONS if soft == resource.RLIM_INFINITY else min(MAX_CONNECTIONS, max(soft // 2, 1))


def bound(server: HTTPServer, most: int) -> None:
    """Let a server that has not begun keep at most so many. A socket that has opened is no longer among them."""
    take = server.handle_stream

    def handle(stream: IOStream, address: Any) -> None:
        if len(server._connections) >= most:
            make_room(server)
        stream.begun = time.monotonic()  # pyright: ignore[reportAttributeAccessIssue]
        take(stream, address)

    server.handle_stream = handle


def make_room(server: HTTPServer) -> None:
    """Close the oldest of the address with most."""
    held: list[Any] = [each for each in server._connections if not each.stream.closed()]
    addresses = [key_of(each.context.remote_ip) for each in held]
    of_address = Counter(addresses)
    orders = [(-of_address[address], each.stream.begun) for address, each in zip(addresses, held, strict=True)]
    if orders:
        held[orders.index(min(orders))].stream.close()
