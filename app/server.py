"""Serve the page: kernels warm, answers safe, nothing else on the port."""

import logging
import sys
from typing import Any

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
MODULES = ("page", "controls", "player", "stage", "charts", "physics", "story", "plot")


def serve(port: int, address: str, origins: list[str]) -> int:
    """Serve until interrupted. Prints the address once the page answers at once."""
    import panel as pn
    from bokeh.server.util import check_allowlist  # noqa: F401  (a changed Bokeh shows here, not in a request)

    from . import guard
    from .lab import STATIC, VERSION, create

    logging.basicConfig(level=logging.WARNING, format="%(levelname)s %(message)s")
    logging.getLogger("bokeh").setLevel(logging.ERROR)
    guard.install()
    template = _template(VERSION)

    def page():
        lab = create()
        pn.state.curdoc.template = template
        return lab

    allowed = origins or [f"{name}:{port}" for name in ("localhost", "127.0.0.1", address)]
    options: dict[str, Any] = dict(
        port=port,
        address=address,
        websocket_origin=allowed,
        show=False,
        start=False,
        location=False,
        static_dirs={f"assets/{VERSION}": str(STATIC)},
        extra_patterns=guard.patterns(),
        websocket_max_message_size=guard.MAX_MESSAGE,
        check_unused_sessions_milliseconds=2_000,
        unused_session_lifetime_milliseconds=10_000,
        warm=True,
    )
    try:
        server = pn.io.server.get_server({"/": page}, **options)
    except OSError as error:
        print(f"impact: --port: got {port}; allowed: a free port ({error.strerror})", file=sys.stderr)
        return 2
    server.start()
    print(f"The page is at http://{'localhost' if address in ('0.0.0.0', '127.0.0.1') else address}:{port}", flush=True)
    try:
        server.io_loop.start()
    except KeyboardInterrupt:
        print("Stopped.", flush=True)
    return 0


def _template(version: str):
    import jinja2

    links = "\n".join(f'<link rel="modulepreload" href="assets/{version}/{name}.js">' for name in MODULES)
    return jinja2.Template(TEMPLATE.replace("VERSION", version).replace("MODULES", links))
