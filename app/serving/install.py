"""What of the pinned Bokeh, Panel and Tornado must be otherwise for a page that anybody may open."""

import gc
from socket import socket
from typing import Any

from bokeh.server import server as bokeh_server
from bokeh.server import tornado as bokeh_tornado
from bokeh.server.urls import per_app_patterns
from bokeh.server.util import bind_sockets
from panel.io import document
from panel.io.server import ComponentResourceHandler
from tornado import httputil
from tornado.escape import parse_qs_bytes
from tornado.web import HTTPError, RequestHandler, StaticFileHandler

from .limits import MAX_FIELDS
from .pages import Page, set_headers
from .sockets import Socket


def install() -> None:
    """Serve our page and socket and no other route of an application, and set headers everywhere. Idempotent."""
    if per_app_patterns[0][1] is Socket:
        return
    per_app_patterns[:] = [(r"/ws", Socket), (r"/?", Page)]
    bokeh_tornado.create_static_handler = _no_static
    RequestHandler.set_default_headers = set_headers  # pyright: ignore[reportAttributeAccessIssue]
    ComponentResourceHandler.parse_url_path = _nothing_here  # it imports the module that an address names
    StaticFileHandler.get = _without_null(StaticFileHandler.get)
    document._garbage_collect = _collect
    httputil.parse_qs_bytes = _first_fields(parse_qs_bytes)  # pyright: ignore[reportPrivateImportUsage]


def listen_on(sockets: list[socket] | None) -> None:
    """Have the next server of Bokeh take these sockets, which are bound already; without any it binds its own."""
    if sockets is None:
        return

    def take(address: str | None, port: int) -> tuple[list[socket], int]:
        bokeh_server.bind_sockets = bind_sockets  # pyright: ignore[reportPrivateImportUsage]
        return sockets, port

    bokeh_server.bind_sockets = take  # pyright: ignore[reportPrivateImportUsage]


def _collect() -> None:
    """What visitors have left, seconds after the first of them: Panel waits until nobody has left for as long, and what
    many have left in turn until then holds up all others at once."""
    gc.collect()


def _nothing_here(self, path):
    raise HTTPError(404)


class _Nothing(RequestHandler):
    """Of the scripts of Bokeh and of Panel, 100 MB, a page loads two, which have addresses of their own."""

    def prepare(self) -> None:
        raise HTTPError(404)


def _no_static(prefix: str, key: str, application: Any) -> tuple[str, type[RequestHandler], dict[str, Any]]:
    return rf"{prefix}{key.rstrip('/')}/static/.*", _Nothing, {}


def _without_null(get):
    async def guarded(self, path, *arguments, **options):
        if "\0" in path:
            raise HTTPError(404)
        return await get(self, path, *arguments, **options)

    return guarded


def _first_fields(parse):
    """Of a link, so many fields as Tornado would refuse without a word beyond."""

    def first(query: str | bytes, *options: Any, **more: Any) -> dict[str, list[bytes]]:
        mark: Any = b"&" if isinstance(query, bytes) else "&"
        return parse(mark.join(query.split(mark, MAX_FIELDS)[:MAX_FIELDS]), *options, **more)

    return first
