"""Serve the page: kernels warm, answers safe, nothing else on the port."""

import contextlib
import errno
import logging
import signal
import sys
from typing import Any

from solvers.jit import NotCompiled, all_compiled

from ..jobs.compiler import COMPILER

log = logging.getLogger("strikewave")

TEMPLATE = """
{% extends base %}
{% block title %}Strikewave: one body strikes another{% endblock %}
{% block postamble %}
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="description" content="See what happens inside a rod when a mass strikes it.">
<link rel="stylesheet" href="assets/VERSION/page.css">
<link rel="preload" as="style" href="assets/VERSION/lab.css">
MODULES
{% endblock %}
"""
MODULES = (
    "page",
    "controls",
    "player",
    "stage",
    "charts",
    "physics",
    "story",
    "plot",
    "bodies",
    "analyses",
    "record",
    "waiting",
    "beams",
    "beam_field",
    "beam_stage",
    "beam_charts",
    "beam_story",
    "in_view",
    "words",
    "trust",
    "logplot",
    "panel",
    "advice",
    "tradeoff",
    "tolerance",
    "stability",
)


def serve(port: int, address: str, origins: list[str]) -> int:
    """Serve until interrupted. Prints the address once the page answers at once."""
    if not all_compiled().exists():
        COMPILER.start()  # while this process loads Panel
    try:
        server = build(port, address, origins)
    except OSError as error:
        COMPILER.stop()
        key, value = ("--address", address) if error.errno == errno.EADDRNOTAVAIL else ("--port", port)
        allowed = "an address of this machine" if key == "--address" else f"a free port at {address}"
        print(f"impact: {key}: got {value}; allowed: {allowed} ({error.strerror})", file=sys.stderr)
        return 2
    server.start()
    host = "localhost" if address in ("0.0.0.0", "127.0.0.1") else address
    print(f"The page is at http://{host}:{port}  (stop with Ctrl-C)", flush=True)
    signal.signal(signal.SIGTERM, lambda *_: server.io_loop.add_callback_from_signal(server.io_loop.stop))
    with contextlib.suppress(KeyboardInterrupt):
        server.io_loop.start()
    COMPILER.stop()
    print("Stopped.", flush=True)
    return 0


def build(port: int, address: str, origins: list[str], unused_lifetime: int = 10_000) -> Any:
    """The server, warm but not started. Raises OSError if the port is taken.

    `unused_lifetime` [ms]: how long the session of a page that was closed is kept.
    """
    import panel as pn

    from ..lab import STATIC, VERSION, create
    from . import guard

    logging.basicConfig(level=logging.WARNING, format="%(levelname)s %(message)s")
    logging.getLogger("bokeh").setLevel(logging.ERROR)
    logging.getLogger("bokeh.server.views.ws").setLevel(logging.CRITICAL)
    logging.getLogger("tornado.access").setLevel(logging.ERROR)
    logging.getLogger("bokeh.server.protocol_handler").setLevel(logging.CRITICAL)  # a stack per bad message, else
    guard.install()
    _warm()
    template = _template(VERSION)

    def page():
        pn.state.curdoc.template = template
        return create()

    return pn.io.server.get_server(
        {"/": page},
        port=port,
        address=address,
        websocket_origin=origins or [f"{name}:{port}" for name in ("localhost", "127.0.0.1", address)],
        show=False,
        start=False,
        location=False,
        static_dirs={f"assets/{VERSION}": str(STATIC)},
        extra_patterns=guard.patterns(),
        websocket_max_message_size=guard.MAX_MESSAGE,
        check_unused_sessions_milliseconds=min(2_000, unused_lifetime),
        unused_session_lifetime_milliseconds=unused_lifetime,
        warm=True,  # makes one page before the port is opened to anybody
    )


def _warm() -> None:
    """Have all that the first page needs compiled and loaded."""
    from ..frames import solve_frame
    from ..jobs.runner import at_once
    from ..state import Choices

    first = Choices().chosen()
    try:
        at_once(solve_frame, first)
    except NotCompiled:
        print("Compiling for the first page, once, some ten seconds; the rest follows while it serves.", flush=True)
        COMPILER.ask("solve_frame", first).result()
        solve_frame(first)


def _template(version: str):
    import jinja2

    links = "\n".join(f'<link rel="modulepreload" href="assets/{version}/{name}.js">' for name in MODULES)
    return jinja2.Template(TEMPLATE.replace("VERSION", version).replace("MODULES", links))
