"""What attacks need: a socket opened by a token, how it is closed, and a script that must not run."""

import asyncio

from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

from ...patience import SECONDS

SCRIPT = "window.stolen = true; export function render() { window.stolen = true; }"


async def closed(wire, seconds=20.0):
    """Wait until a socket is closed; its code and reason."""
    while await asyncio.wait_for(wire.read_message(), seconds) is not None:
        pass
    return wire.close_code, wire.close_reason


async def with_token(address, token):
    request = HTTPRequest(f"ws://{address}/ws", request_timeout=SECONDS)
    return await websocket_connect(request, subprotocols=["bokeh", token])
