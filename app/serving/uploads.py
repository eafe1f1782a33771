"""Files sent by the browser: received, worked on, answered as JSON; such as measured records, compared with the scene.

One request is one file and one answer; nothing is kept. Where they are more bytes than may be, the largest of the
address with most of them makes room: whoever sends slowly keeps nobody out, and holds nothing that anybody needs.
"""

import logging
from abc import ABC, abstractmethod
from collections import Counter
from typing import Any, ClassVar

from bokeh.server.util import check_allowlist
from tornado.web import RequestHandler, stream_request_body

from solvers import SceneError
from solvers.jit.compiling import NotCompiled
from solvers.records.files import check_size

from ..jobs.compiler import COMPILER
from ..jobs.fair import Stranger
from ..jobs.loops import of_loop
from ..jobs.turns import Turnstile
from ..jobs.workers import Lost, Workers
from ..page.reading import by_worker, chosen_in, compared
from ..text.refusals import note, reason_of
from .addresses import Addresses, host_of

MAX_HELD = 64_000_000  # bytes of all files that are on their way, or being worked on
WORKED_ON_OF_ONE = 6  # files of one address being worked on, or waiting for it; addresses take turns
RECEIVE_SECONDS = 20.0  # for a file to arrive
MAX_PASSED_BY = 12_000_000  # bytes that are read of a file that is too long: a browser listens when it has sent all
PEERS = Addresses()  # where the application is another's, and names no proxies
log = logging.getLogger("strikewave")


@stream_request_body
class Upload(RequestHandler, ABC):
    """POST with a file as body."""

    _held: ClassVar[dict["Upload", int]] = {}  # bytes, of all visitors together
    _working: ClassVar[set["Upload"]] = set()

    def initialize(self) -> None:
        self.address = self.application.settings.get("addresses", PEERS).of(self.request)

    @abstractmethod
    def limit(self, size: int) -> None:
        """Raises ValueError for a size [bytes] that is too large."""

    @abstractmethod
    async def answered(self, content: bytes) -> str:
        """JSON. Raises ValueError for what cannot be."""

    def prepare(self):
        self._body, self._refusal = bytearray(), None
        if self.request.method != "POST":
            self.set_status(405)
            self.finish({"error": reason_of(SceneError("method", self.request.method, "POST"))})
            return
        self.request.connection.set_body_timeout(RECEIVE_SECONDS)
        self.request.connection.set_max_body_size(MAX_PASSED_BY)
        origin = host_of(self.request.headers.get("Origin", ""))
        if not origin or not check_allowlist(origin, self.application.websocket_origins):
            self._refusal = 403, note("serving.upload.own-page").table()
        else:
            length = self.request.headers.get("Content-Length", "0")
            self._check_size(int(length) if length.isdecimal() and len(length) < 20 else 0)

    def data_received(self, chunk: bytes):
        """Keep the body, or let it pass by once it is refused."""
        if self._refusal is None and not self._finished:
            self._body += chunk
            self._held[self] = len(self._body)
            self._check_size(len(self._body))
            while sum(self._held.values()) > MAX_HELD:
                first_to_go(self._held)._make_room()

    def _check_size(self, size: int) -> None:
        try:
            self.limit(size)
        except ValueError as refusal:
            self._refusal = 413, reason_of(refusal)
            self._release()

    def _make_room(self) -> None:
        """Refuse it at once, on its way or being worked on."""
        self._release()
        self.set_header("Connection", "close")
        self._refuse(429, note("serving.upload.many").table())

    async def post(self):
        if self._finished:  # to make room
            return None
        of_this = sum(each.address == self.address for each in self._working)
        if self._refusal is None and of_this >= WORKED_ON_OF_ONE:
            self._refusal = 429, note("serving.upload.others").table()
        if self._refusal is not None:
            return self._refuse(*self._refusal)
        self._working.add(self)
        try:
            turnstile, who = of_loop(Turnstile), Stranger("files", self.address)
            await turnstile.enter(who)
            answer = await turnstile.paid(who, self.answered(bytes(self._body)))
            if not self._finished:  # to make room, meanwhile
                self.set_header("Content-Type", "application/json; charset=UTF-8")
                self.write(answer)
        except ValueError as refusal:  # what cannot be: for the visitor
            self._refuse(400, reason_of(refusal))
        except Exception as error:
            log.error("%s: a file could not be worked on", type(self).__name__, exc_info=not isinstance(error, Lost))
            self._refuse(500, note("serving.upload.failed").table())
        finally:
            self._working.discard(self)
            self._release()

    def on_finish(self):
        self._release()

    def on_connection_close(self):
        super().on_connection_close()
        self._release()

    def _release(self):
        self._held.pop(self, None)
        self._body = bytearray()

    def _refuse(self, status: int, reason: dict[str, Any]) -> None:
        if not self._finished:
            self.set_status(status)
            self.finish({"error": reason})


class MeasuredRecord(Upload):
    """In the query the choices, `kind`, `at` [m] and `sign`."""

    def limit(self, size: int) -> None:
        check_size(size)

    async def answered(self, content: bytes) -> str:
        return await _answered(content, self.request.query_arguments, self.address)


def first_to_go(held: dict[Upload, int]) -> Upload:
    """Of these files and their bytes, the one that makes room for others."""
    of_address: Counter[str] = Counter()
    for each, size in held.items():
        of_address[each.address] += size
    return max(held, key=lambda each: (of_address[each.address], held[each]))


async def _answered(content: bytes, arguments: dict[str, list[bytes]], address: str) -> str:
    """`compared` by a worker; what it needs that is not compiled yet is compiled in another process first."""
    start, who = of_loop(Workers).start, Stranger("records", address)
    try:
        return await start(compared, content, arguments, visitor=who).answer
    except NotCompiled:
        await COMPILER.ready("solve_frame", await by_worker(chosen_in, arguments, who=who))
    return await start(compared, content, arguments, visitor=who, compiled=False).answer
