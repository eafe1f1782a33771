"""Measured records sent by the browser: received, compared with the chosen scene, answered as JSON.

One request is one record and one answer; nothing is kept. Where as many are on their way as may be, the one that is
longest at it, of the address with most of them, makes room: whoever sends slowly keeps nobody out.
"""

import logging
import time
from collections import Counter
from collections.abc import Collection
from typing import ClassVar
from urllib.parse import urlsplit

from bokeh.server.util import check_allowlist
from tornado.web import RequestHandler, stream_request_body

from solvers import SceneError
from solvers.jit.compiling import NotCompiled
from solvers.records.files import check_size

from ..jobs.compiler import COMPILER
from ..jobs.loops import of_loop
from ..jobs.workers import Lost, Workers
from ..page.address import chosen_in
from ..text.catalogues import page
from ..views.record import record_answer

MAX_RECEIVED = 32  # records on their way, 2 MB each at most
MAX_COMPARED = 16  # records being compared, or waiting for it
COMPARED_OF_ONE = 6  # of them, from one address
RECEIVE_SECONDS = 20.0  # for a record to arrive
MAX_PASSED_BY = 12_000_000  # bytes that are read of a record that is too long: a browser listens when it has sent all
log = logging.getLogger("strikewave")


@stream_request_body
class MeasuredRecord(RequestHandler):
    """POST with the file as body; in the query the choices, `kind`, `at` [m] and `sign`."""

    _receiving: ClassVar[set["MeasuredRecord"]] = set()  # of all visitors together
    _comparing: ClassVar[set["MeasuredRecord"]] = set()

    def initialize(self) -> None:
        self.address, self.begun = self.application.settings["addresses"].of(self.request), time.monotonic()

    def prepare(self):
        self._body, self._refusal = bytearray(), None
        if self.request.method != "POST":
            self.set_status(405)
            self.finish({"error": str(SceneError("method", self.request.method, "POST"))})
            return
        self.request.connection.set_body_timeout(RECEIVE_SECONDS)
        self.request.connection.set_max_body_size(MAX_PASSED_BY)
        origin = urlsplit(self.request.headers.get("Origin", "")).netloc.lower()
        if not origin or not check_allowlist(origin, self.application.websocket_origins):
            self._refusal = 403, page().text("serving.record.own-page")
        else:
            if len(self._receiving) >= MAX_RECEIVED:
                first_to_go(self._receiving)._make_room()
            self._receiving.add(self)
            length = self.request.headers.get("Content-Length", "0")
            self._check_size(int(length) if length.isdecimal() else 0)

    def data_received(self, chunk: bytes):
        """Keep the body, or let it pass by once it is refused."""
        if self._refusal is None and not self._finished:
            self._body += chunk
            self._check_size(len(self._body))

    def _check_size(self, size: int) -> None:
        try:
            check_size(size)
        except SceneError as refusal:
            self._refusal = 413, str(refusal)
            self._release()

    def _make_room(self) -> None:
        """Refuse what is still on its way, at once."""
        self._release()
        self.set_header("Connection", "close")
        self._refuse(429, page().text("serving.record.many"))

    async def post(self):
        self._receiving.discard(self)
        of_this = sum(each.address == self.address for each in self._comparing)
        if self._refusal is None and (len(self._comparing) >= MAX_COMPARED or of_this >= COMPARED_OF_ONE):
            self._refusal = 429, page().text("serving.record.others")
        if self._refusal is not None:
            return self._refuse(*self._refusal)
        self._comparing.add(self)
        try:
            answer = await _answered(bytes(self._body), self.request.query_arguments, self.address)
            self.set_header("Content-Type", "application/json; charset=UTF-8")
            self.write(answer)
        except ValueError as refusal:  # SceneError: the sentence is for the visitor
            self._refuse(400, str(refusal))
        except Exception as error:
            log.error("a record could not be compared", exc_info=not isinstance(error, Lost))
            self._refuse(500, page().text("serving.record.failed"))
        finally:
            self._comparing.discard(self)
            self._release()

    def on_finish(self):
        self._release()

    def on_connection_close(self):
        super().on_connection_close()
        self._release()

    def _release(self):
        self._receiving.discard(self)
        self._body = bytearray()

    def _refuse(self, status: int, sentence: str) -> None:
        self.set_status(status)
        self.finish({"error": sentence})


def first_to_go(receiving: Collection[MeasuredRecord]) -> MeasuredRecord:
    """Of these records, the one that makes room for another."""
    most, _ = Counter(each.address for each in receiving).most_common(1)[0]
    return min((each for each in receiving if each.address == most), key=lambda each: each.begun)


async def _answered(content: bytes, arguments: dict[str, list[bytes]], visitor: str) -> str:
    """`record_answer` by a worker; what it needs that is not compiled yet is compiled in another process first."""
    start, chosen = of_loop(Workers).start, chosen_in(arguments)
    try:
        return await start(record_answer, content, chosen, arguments, visitor=visitor).answer
    except NotCompiled:
        await COMPILER.ready("solve_frame", chosen)
    return await start(record_answer, content, chosen, arguments, visitor=visitor, compiled=False).answer
