"""The command `impact serve`: who is served, where, and behind what."""

import argparse
import errno
import os
import re
import socket
import sys
import tempfile
from pathlib import Path

from solvers import SceneError
from solvers.text.catalogue import spoken

from .words import text

DEFAULT_PORT = 5006
# https, or http of this machine alone; a star stands for what is before a name of two parts at least
LONGEST_ORIGIN = 262  # with scheme and port
FRAME_ORIGIN = r"(https://(\*\.(?=[^.:]+\.))?[a-z0-9-]+(\.[a-z0-9-]+)*|http://(localhost|127\.0\.0\.1))(:(\d{1,5}))?"

# Ports of other services, to which no browser goes: WHATWG Fetch, 'port blocking'
REFUSED = """
    1 7 9 11 13 15 17 19 20 21 22 23 25 37 42 43 53 69 77 79 87 95 101 102 103 104 109 110 111 113 115 117 119 123 135
    137 139 143 161 179 389 427 465 512 513 514 515 526 530 531 532 540 548 554 556 563 587 601 636 989 990 993 995 1719
    1720 1723 2049 3659 4045 4190 5060 5061 6000 6566 6665 6666 6667 6668 6669 6679 6697 10080
    """
REFUSED_BY_BROWSERS = frozenset(map(int, REFUSED.split()))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--port", help=text("help.serve.port", port=DEFAULT_PORT))
    parser.add_argument("--address", help=text("help.serve.address"))
    origin = text("help.serve.origin")
    parser.add_argument("--allow-origin", action="append", metavar="HOST[:PORT]", help=origin)
    frames = text("help.serve.frames")
    parser.add_argument("--frame-origin", action="append", metavar="ORIGIN", help=frames)
    parser.add_argument("--lessons", metavar="FOLDER", help=text("help.serve.lessons"))
    parser.add_argument("--behind", action="append", metavar="ADDRESS[/BITS]", help=text("help.serve.behind"))
    parser.add_argument("--cluster", metavar="ADDRESS|local:N", help=text("help.serve.cluster"))
    parser.add_argument("--warm", action="store_true", help=text("help.serve.warm"))
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    port = os.environ.get("IMPACT_PORT", str(DEFAULT_PORT)) if options.port is None else options.port
    if not (port.isascii() and port.isdigit() and len(port) <= 5 and 1 <= int(port) <= 65535):
        raise SceneError("--port", port, text("wanted.whole", low=1, high=65535))
    address = os.environ.get("IMPACT_ADDRESS", "127.0.0.1") if options.address is None else options.address
    try:
        socket.getaddrinfo(address or " ", int(port))
    except (OSError, UnicodeError):
        raise SceneError("--address", address, text("wanted.address")) from None
    origins = _several(options.allow_origin, "IMPACT_ORIGINS")
    for origin in origins:
        host, _, origin_port = origin.partition(":")
        if not re.fullmatch(r"[A-Za-z0-9.-]{1,253}", host) or not re.fullmatch(r"(\d{1,5})?", origin_port):
            raise SceneError("--allow-origin", origin, text("wanted.origin"))
    frames = _frame_origins(options)
    documentation = os.environ.get("IMPACT_DOCUMENTATION", "")
    if documentation and not re.fullmatch(r"https?://[^\s/]+(/\S*)?", documentation):
        raise SceneError("IMPACT_DOCUMENTATION", documentation, text("wanted.documentation"))
    cluster = os.environ.get("IMPACT_CLUSTER", "") if options.cluster is None else options.cluster
    if cluster:
        _check_cluster(cluster)
    from ..serving.addresses import network_of

    proxies = []
    for proxy in _several(options.behind, "IMPACT_BEHIND"):
        try:
            proxies.append(network_of(proxy))
        except ValueError:
            raise SceneError("--behind", proxy, text("wanted.proxy")) from None
    try:
        tempfile.gettempdir()
    except FileNotFoundError:
        raise SceneError("TMPDIR", os.environ.get("TMPDIR"), text("wanted.folder")) from None
    if not _lessons(os.environ.get("IMPACT_LESSONS", "") if options.lessons is None else options.lessons):
        return 2
    sockets = _port(int(port), address)
    if int(port) in REFUSED_BY_BROWSERS:
        print(text("wanted.port-refused", port=port), file=sys.stderr, flush=True)
    from ..page.packed import outdated
    from ..serving.server import serve

    if outdated():
        print(text("run.pack-out-of-date"), file=sys.stderr, flush=True)

    return serve(int(port), address, origins, proxies, sockets, frames, cluster)


def _check_cluster(address: str) -> None:
    from solvers.studies.study.cluster import check_address

    try:
        check_address(address)
    except SceneError as error:
        raise SceneError("--cluster", address, error.reason) from None


def _lessons(folder: str) -> bool:
    """Take the lessons of a folder, if one is named; what is wrong with them is printed by line."""
    if not folder:
        return True
    from ..lessons.added import add

    try:
        wrong = add(Path(folder))
    except (OSError, ValueError):
        raise SceneError("--lessons", folder, text("wanted.lessons")) from None
    for path, problem in wrong:
        print(f"{path}:{problem.line}: {problem.said(spoken())}", file=sys.stderr)
    return not wrong


def _frame_origins(options: argparse.Namespace) -> list[str]:
    """Sites that may have the page in a frame, as a content policy names them."""
    origins = [each.lower() for each in _several(options.frame_origin, "IMPACT_FRAME_ORIGINS")]
    for origin in origins:
        found = re.fullmatch(FRAME_ORIGIN, origin, re.ASCII) if len(origin) <= LONGEST_ORIGIN else None
        if not found or int(found.groups()[-1] or 1) not in range(1, 65536):
            raise SceneError("--frame-origin", origin, text("wanted.frame-origin"))
    return origins


def _port(port: int, address: str) -> list[socket.socket]:
    """The port, taken before the rest is loaded: what is wrong with it is seen at once, and who comes early waits."""
    from tornado.netutil import bind_sockets

    try:
        return bind_sockets(port, address)
    except OSError as error:
        key, value = ("--address", address) if error.errno == errno.EADDRNOTAVAIL else ("--port", port)
        allowed = text("wanted.own-address") if key == "--address" else text("wanted.free-port", address=address)
        raise SceneError(key, value, f"{allowed} ({error.strerror})") from None


def _several(given: list[str] | None, variable: str) -> list[str]:
    """Values of an option that may be repeated, or those of a variable, separated by commas."""
    values = given or [each for each in os.environ.get(variable, "").split(",") if each.strip()]
    return [each.strip() for each in values]
