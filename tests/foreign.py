"""What the page relies on of Panel, param, Bokeh and Tornado that they do not promise: names of their own, and what the
page puts in the place of theirs. `python -m tests.foreign` says which of it the installed versions no longer have.
"""

import importlib
import inspect
import sys
from collections.abc import Iterator
from importlib.metadata import version
from typing import NamedTuple

LIBRARIES = "panel", "param", "bokeh", "tornado"


class Relied(NamedTuple):
    owner: str  # module, or module:class
    name: str
    why: str
    takes: tuple[str, ...] | None = None  # parameters, where the page calls it, overrides it or stands in for it


RELIED = (
    Relied("panel.custom:ReactiveESM", "_bundle", "the script of the page is a file of ours"),
    Relied("panel.custom:ReactiveESM", "_component_resource_path", "it has an address of ours",
           ("esm_path", "compiled")),
    Relied("panel.custom:ReactiveESM", "_get_model", "without styles of Panel's own inputs",
           ("self", "doc", "root", "parent", "comm")),
    Relied("panel.reactive:Syncable", "_priority_changes", "no debounce"),
    Relied("panel.reactive:Syncable", "_server_change", "changes are taken at once",
           ("self", "doc", "ref", "subpath", "attr", "old", "new")),
    Relied("panel.reactive:Syncable", "_process_events", "each change on its own", ("self", "events")),
    Relied("panel.reactive:Syncable", "_param_change", "answers are written at once", ("self", "events")),
    Relied("panel.reactive:Syncable", "_linked_properties", "what of it is sent"),
    Relied("panel.reactive:Syncable", "_changing", "what a change of ours sets"),
    Relied("panel.reactive:Syncable", "_in_process__events", "what the browser has already"),
    Relied("panel.viewable:Renderable", "_models", "models of the page in the document"),
    Relied("panel.io.state:_state", "_unblocked", "whether the document is locked", ("self", "doc")),
    Relied("panel.io.document", "_garbage_collect", "visitors that leave in turn", ()),
    Relied("panel.io.document", "unlocked", "changes sent at once", ("policy",)),
    Relied("panel.io.server:ComponentResourceHandler", "parse_url_path", "it imports what an address names",
           ("self", "path")),
    Relied("param.parameterized", "_syncing", "what the browser has already", ("parameterized", "parameters")),
    Relied("param.parameterized:String", "_validate_value", "values of bodies", ("self", "value", "allow_None")),
    Relied("param.parameters:Selector", "_validate", "scenes of a visitor's own", ("self", "val")),
    Relied("bokeh.server.server", "bind_sockets", "sockets that are bound already", ("address", "port")),
    Relied("bokeh.server.server:BaseServer", "_http", "how many connections it keeps"),
    Relied("bokeh.server.tornado", "create_static_handler", "no scripts but ours", ("prefix", "key", "app")),
    Relied("bokeh.server.urls", "per_app_patterns", "our page and our socket"),
    Relied("bokeh.server.views.ws:WSHandler", "_async_open", "sessions in turn", ("self", "token")),
    Relied("bokeh.server.views.ws:WSHandler", "_receive", "messages that cannot be read", ("self", "fragment")),
    Relied("bokeh.server.views.ws:WSHandler", "_handle", "messages in turn", ("self", "message")),
    Relied("bokeh.server.views.ws:WSHandler", "_token", "who opens a socket"),
    Relied("bokeh.server.connection:ServerConnection", "_session", "whether there is a session"),
    Relied("bokeh.protocol.receiver:Receiver", "_partial", "whether a message is whole"),
    Relied("tornado.httpserver:HTTPServer", "_connections", "the oldest connection makes room"),
    Relied("tornado.web:RequestHandler", "_finished", "uploads that were refused meanwhile"),
    Relied("tornado.web:RequestHandler", "set_default_headers", "headers everywhere", ("self",)),
    Relied("tornado.web:StaticFileHandler", "get", "addresses with a zero in them", ("self", "path", "include_body")),
    Relied("tornado.httputil", "parse_qs_bytes", "so many fields and no more",
           ("qs", "keep_blank_values", "strict_parsing", "max_num_fields")),
    Relied("tornado.websocket:WebSocketProtocol", "_abort", "sockets that do not close", ("self",)),
    Relied("tornado.websocket:WebSocketProtocol13", "_message_bytes_in", "frames that are no message"),
    Relied("tornado.websocket:WebSocketProtocol13", "_receive_frame", "their turn", ("self",)),
)  # fmt: skip


def broken(relied: Relied) -> str:
    """Why it cannot be relied on any more; nothing if it can."""
    module, _, kind = relied.owner.partition(":")
    try:
        owner = importlib.import_module(module)
        owner = getattr(owner, kind) if kind else owner
    except (ImportError, AttributeError):
        return "is gone with its owner"
    found = getattr(owner, relied.name, None)
    if relied.takes is None:
        there = hasattr(owner, relied.name) or any(_sets(each, relied.name) for each in inspect.getmro(owner))
        return "" if there else "is gone"
    if not callable(found):
        return "is gone"
    takes = tuple(inspect.signature(found).parameters)
    return "" if takes == relied.takes else f"takes {', '.join(takes)}"


def _sets(kind: type, name: str) -> bool:
    """Whether it gives its objects that attribute."""
    try:
        return f"self.{name}" in inspect.getsource(kind)
    except (OSError, TypeError):
        return False


def lines() -> Iterator[str]:
    """One for each that cannot be relied on."""
    for each in RELIED:
        if reason := broken(each):
            yield f"{each.owner}.{each.name} {reason}: {each.why}"


def main() -> None:
    """Says the versions, and what of them would break the page: a rehearsal, which fails nobody."""
    print(", ".join(f"{name} {version(name)}" for name in LIBRARIES))
    found = list(lines())
    print("\n".join(found) if found else "Nothing that the page relies on is gone.")


if __name__ == "__main__":
    sys.exit(main())
