"""The port while the server gets ready: it is taken at once, and answers that the page is coming.

Kernels may have to be compiled first, for half a minute or more on a busy machine.
"""

import asyncio
import socket
import threading
from contextlib import suppress
from html import escape

from tornado.netutil import bind_sockets

from ..text.catalogues import LANGUAGE, page
from .bare import answer

AGAIN = 2  # s after which a browser asks again
HEAD_SECONDS, MAX_HEAD = 5.0, 65_536  # for a request to arrive, and its bytes
MAX_AT_ONCE = 200  # connections
LAST_SECONDS = 0.5  # that answers under way have, when the server is ready


class EarlyPort:
    """Takes a port, and answers on it by a thread of its own until the server does. Raises OSError if it is taken."""

    def __init__(self, port: int, address: str):
        self.port, self.address = port, address
        self.sockets = bind_sockets(port, address)
        self._loop, self._ready = asyncio.new_event_loop(), asyncio.Event()
        self._answering: set[asyncio.Task] = set()
        self._thread = threading.Thread(target=self._serve, name="early", daemon=True)
        self._thread.start()

    def hand_over(self) -> list[socket.socket]:
        """End the answers; the sockets, on which others wait to be accepted meanwhile."""
        self._loop.call_soon_threadsafe(self._ready.set)
        self._thread.join()
        return self.sockets

    def _serve(self) -> None:
        with asyncio.Runner(loop_factory=lambda: self._loop) as runner:
            runner.run(self._answer_all())

    async def _answer_all(self) -> None:
        servers = [await asyncio.start_server(self._answer, sock=each.dup(), limit=MAX_HEAD) for each in self.sockets]
        await self._ready.wait()
        for server in servers:
            server.close()
        if self._answering:
            await asyncio.wait(self._answering, timeout=LAST_SECONDS)

    async def _answer(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None
        try:
            if len(self._answering) < MAX_AT_ONCE:
                self._answering.add(task)
                with suppress(asyncio.IncompleteReadError, asyncio.LimitOverrunError):
                    await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), HEAD_SECONDS)
                writer.write(_getting_ready())
                await writer.drain()
        except (OSError, TimeoutError):  # who has left, or says nothing
            pass
        finally:
            self._answering.discard(task)
            writer.close()


def _getting_ready() -> bytes:
    texts = page().texts
    title, sentence = escape(texts["document.title"]), escape(texts["serving.getting-ready"])
    again = f'<meta http-equiv="refresh" content="{AGAIN}">'
    body = f'<!DOCTYPE html><html lang="{LANGUAGE}"><title>{title}</title>{again}<p>{sentence}</p></html>'
    return answer("503 Unavailable", body, Retry_After=str(AGAIN))
