"""A page of one's own for as long as a benchmark lasts."""

import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager

from tests.app.servers import free_port


@contextmanager
def served_page(known: tuple[str, int] | None = None) -> Iterator[tuple[str, int]]:
    """Address and process of a running page that answers; of one that is known, if there is any."""
    if known is not None:
        yield known
        return
    port = free_port()
    command = [sys.executable, "-m", "app.command", "serve", "--port", str(port)]
    server = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    try:
        while True:
            try:
                urllib.request.urlopen(f"http://127.0.0.1:{port}/liveness", timeout=2).read()
                break
            except OSError:
                time.sleep(0.02)
        yield f"127.0.0.1:{port}", server.pid
    finally:
        server.terminate()
        server.wait(10)
