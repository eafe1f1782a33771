"""What of the pinned Bokeh, Panel and Tornado must be otherwise for a page that anybody may open."""

from bokeh.server.urls import per_app_patterns
from panel.io.server import ComponentResourceHandler
from tornado.web import HTTPError, RequestHandler, StaticFileHandler

from .pages import Page, set_headers
from .sockets import Socket


def install() -> None:
    """Serve our page and socket and no other route of an application, and set headers everywhere. Idempotent."""
    if per_app_patterns[0][1] is Socket:
        return
    per_app_patterns[:] = [(r"/ws", Socket), (r"/?", Page)]
    RequestHandler.set_default_headers = set_headers  # pyright: ignore[reportAttributeAccessIssue]
    ComponentResourceHandler.parse_url_path = _nothing_here  # it imports the module that an address names
    StaticFileHandler.get = _without_null(StaticFileHandler.get)


def _nothing_here(self, path):
    raise HTTPError(404)


def _without_null(get):
    async def guarded(self, path, *arguments, **options):
        if "\0" in path:
            raise HTTPError(404)
        return await get(self, path, *arguments, **options)

    return guarded
