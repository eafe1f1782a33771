"""Serve the page: kernels warm, processes ready, answers safe, nothing else on the port."""

import asyncio
import contextlib
import gc
import logging
import secrets
import signal
import warnings
from collections.abc import Sequence
from importlib import import_module
from socket import socket
from typing import Any

from bokeh.util.warnings import BokehUserWarning

from solvers.jit.cache import all_compiled
from solvers.jit.compiling import NotCompiled
from solvers.text.catalogue import spoken

from ..jobs.calibrating import calibrate_machine
from ..jobs.compiler import COMPILER, HANG_SECONDS
from ..jobs.loops import forget, of_loop
from ..jobs.processes import prepare
from ..jobs.spread import Spread
from ..jobs.workers import Workers
from ..text.catalogues import LANGUAGES, command
from . import connections
from .addresses import Addresses, Network

CLOSE_SECONDS = 2.0  # for sockets to be closed when the server stops
log = logging.getLogger("strikewave")


def serve(
    port: int,
    address: str,
    origins: list[str],
    proxies: list[Network],
    sockets: list[socket],
    frames: list[str],
    cluster: str = "",
) -> int:
    """Serve until interrupted, on a port that is taken already. Prints the address once the page answers at once.

    `origins`: hosts by which browsers reach the page; `proxies`: of which `X-Forwarded-For` is believed; `frames`:
    origins of other sites that may have the page in a frame; `cluster`: address of one that finds points of maps.
    """
    most = connections.room()
    if not all_compiled().exists():
        COMPILER.start()  # while this process loads Panel
    prepare()  # likewise
    server = build(port, address, origins, proxies, sockets=sockets, frames=frames)
    connections.bound(server._http, most)
    server.start()
    if cluster:
        import_module("distributed")  # before what is loaded is frozen
        server.io_loop.add_callback(lambda: of_loop(Spread).connect(cluster))
    gc.collect()
    gc.freeze()  # what is loaded stays: to look through it, as Panel does whenever visitors leave, took 0.2 s each time
    at = opened_at(port, address, origins, bool(proxies))
    print(command(spoken()).text("run.page-at", address=f"http://{at}"), flush=True)
    server.io_loop.add_callback(calibrate_machine)
    signal.signal(signal.SIGTERM, lambda *_: server.io_loop.add_callback_from_signal(server.io_loop.stop))
    with contextlib.suppress(KeyboardInterrupt):
        server.io_loop.start()
    COMPILER.stop()
    stop(server)
    print("Stopped.", flush=True)
    return 0


def opened_at(port: int, address: str, origins: list[str], proxied: bool) -> str:
    """Where the page can be opened: at others than the `origins` that are given it would be refused; a proxy has them
    elsewhere.
    """
    host = "localhost" if address in ("0.0.0.0", "127.0.0.1") else f"[{address}]" if ":" in address else address
    return origins[0] if origins and not proxied else f"{host}:{port}"


def stop(server: Any) -> None:
    """End what belongs to a server whose loop has stopped, without waiting for anything."""
    loop = server.io_loop.asyncio_loop

    async def end() -> None:
        await asyncio.gather(of_loop(Spread).close(), of_loop(Workers).close())

    loop.run_until_complete(end())
    forget(loop)


def build(
    port: int,
    address: str,
    origins: list[str],
    proxies: list[Network] | None = None,
    *,
    sockets: list[socket] | None = None,
    frames: Sequence[str] = (),
    unused_lifetime: int = 10_000,
) -> Any:
    """The server, warm but not started. Raises OSError if the port is taken.

    `sockets` have the port already; `frames`: as for `serve`; `unused_lifetime` [ms]: how long the session of a page
    that was closed is kept.
    """
    import panel as pn

    from ..page.lab import create
    from . import install
    from .door import Door
    from .limits import MAX_BODY, MAX_HEADER, MAX_MESSAGE
    from .pages import pack, shell
    from .routes import routes

    _quiet()
    install.install()
    _first_answer()
    for language in LANGUAGES:
        shell(True, language)
    pack()
    secret = secrets.token_bytes(32)
    install.listen_on(sockets)
    server = pn.io.server.get_server(
        {"/": create},
        port=port,
        address=address,
        websocket_origin=origins or [f"{name}:{port}" for name in ("localhost", "127.0.0.1", address)],
        show=False,
        start=False,
        location=False,
        extra_patterns=routes(),
        websocket_max_message_size=MAX_MESSAGE,
        http_server_kwargs={
            "max_body_size": MAX_BODY,
            "max_header_size": MAX_HEADER,
            "idle_connection_timeout": 120.0,
            "body_timeout": 20.0,
        },
        check_unused_sessions_milliseconds=min(2_000, unused_lifetime),
        unused_session_lifetime_milliseconds=unused_lifetime,
        secret_key=secret,
        sign_sessions=True,
        door=Door(secret),
        addresses=Addresses(proxies or ()),
        frames=tuple(frames),
        warm=True,  # makes one page before the port is opened to anybody
    )
    server.io_loop.add_callback(lambda: of_loop(Workers).fill())
    return server


def _quiet() -> None:
    """One line for what a reader of the log can act on; nothing for what strangers send."""
    logging.basicConfig(level=logging.WARNING, format="%(levelname)s %(message)s")
    logging.getLogger("bokeh").setLevel(logging.ERROR)
    warnings.filterwarnings("ignore", category=BokehUserWarning)  # with words of who sent what it warns of
    for name in ("bokeh.server.views.ws", "bokeh.server.protocol_handler", "bokeh.protocol"):  # a stack for what is bad
        logging.getLogger(name).setLevel(logging.CRITICAL)
    logging.getLogger("tornado.access").setLevel(logging.CRITICAL)  # a page is refused at a stranger's will
    logging.getLogger("tornado.general").setLevel(logging.ERROR)


def _first_answer() -> None:
    """Have all that the first page needs compiled, and its answer ready."""
    from ..choices.choices import Choices
    from ..jobs.answers import KEPT
    from ..jobs.runner import at_once
    from ..messages.solve import solve_frame

    first = Choices().chosen()
    try:
        at_once(solve_frame, first)
    except NotCompiled:
        print(command(spoken()).text("run.first-page"), flush=True)
        with contextlib.suppress(OSError):  # kernels of another machine, or another Numba: the usual ones are made anew
            all_compiled().unlink()
        with contextlib.suppress(TimeoutError):
            COMPILER.ask("solve_frame", first).result(HANG_SECONDS)
        solve_frame(first)
    KEPT.keep(solve_frame, first, solve_frame(first))  # its time is that of a solve: kernels are loaded
