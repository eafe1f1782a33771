"""A bare client of the page's websocket: sends what no browser would, and counts what comes back."""

import asyncio
import json
import re
import uuid
from collections.abc import Coroutine
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import websocket_connect

from app.choices.choices import title_of
from app.messages.encoding import read_header
from app.serving.pages import VERSION
from app.text.catalogues import page
from solvers.text.catalogue import SOURCE
from tests.app.sentences import refusals

from ..patience import SECONDS


def run(coroutine: Coroutine, seconds: float = 300.0) -> Any:
    """Run to the end on a thread of its own: Playwright keeps a loop on the main one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, asyncio.wait_for(coroutine, seconds)).result()


FETCHED = ("page.js", "sheets.css", "wasm/answers.js", "wasm/kernels.wasm")  # which no document names for itself
READY = {"type": "event", "name": "document_ready", "values": {"type": "map", "entries": []}}


class SocketClient:
    """One session of the page at `address` ("127.0.0.1:5006")."""

    def __init__(self, address: str):
        self.address = address
        self.received = 0  # bytes
        self.last: dict[str, Any] = {}
        self.last_frame = b""
        self._set: tuple[str, Any] = "", None  # last

    async def open(self, query: str = "") -> "SocketClient":
        page = await AsyncHTTPClient().fetch(f"http://{self.address}/{query}", request_timeout=SECONDS)
        self.html = page.body.decode()
        return await self.connect(re.search(r'"token":\s*"([^"]+)"', self.html).group(1))

    async def fetch(self) -> list[str]:
        """All files that a browser fetches on a first visit, besides what the program of the page asks by its language
        and its scene; their paths.
        """
        named = re.findall(r'<(?:script|link)\b[^>]*?(?:src|href)="([^"]+)"', self.html)
        paths = list(dict.fromkeys([*named, *(f"assets/{VERSION}/{name}" for name in FETCHED)]))
        headers = {"Accept-Encoding": "gzip"}
        get = AsyncHTTPClient(force_instance=True, max_clients=6).fetch  # as many as a browser opens to one host
        await asyncio.gather(
            *(
                get(
                    f"http://{self.address}/{path}", headers=headers, decompress_response=False, request_timeout=SECONDS
                )
                for path in paths
            )
        )
        return paths

    async def connect(self, token: str) -> "SocketClient":
        """Open the socket of the session that a token names."""
        self.token = token
        request = HTTPRequest(f"ws://{self.address}/ws", request_timeout=SECONDS)
        self._socket = await websocket_connect(request, subprotocols=["bokeh", token], max_message_size=2**24)
        self._socket.protocol.set_nodelay(True)
        await self.receive()  # ACK
        await self.send("PULL-DOC-REQ", {})
        content: dict[str, Any] = {}
        while "doc" not in content:
            _, content = await self.receive()
        await self.patch({"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": READY})
        self.document = content["doc"]
        self.lab = self._find(content["doc"])
        return self

    def _find(self, tree: Any) -> dict[str, Any] | None:
        """The model that holds the choices."""
        if isinstance(tree, dict):
            if "spec" in tree.get("attributes", {}):
                return tree
            tree = list(tree.values())
        if isinstance(tree, list):
            return next((found for item in tree if (found := self._find(item))), None)
        return None

    async def send(self, kind: str, content: Any) -> None:
        await self._socket.write_message(json.dumps({"msgid": uuid.uuid4().hex, "msgtype": kind}))
        await self._socket.write_message("{}")
        await self._socket.write_message(content if isinstance(content, str) else json.dumps(content))

    async def patch(self, *events: dict[str, Any]) -> None:
        await self.send("PATCH-DOC", {"events": list(events)})

    async def set(self, name: str, value: Any) -> None:
        self._set = name, value
        await self.patch({"kind": "ModelChanged", "model": {"id": self.lab["id"]}, "attr": name, "new": value})

    async def receive(self, timeout: float = 60.0) -> tuple[str, dict[str, Any]]:
        """Kind and content of the next message; binary parts are counted and put under "buffers"."""

        async def part(patience: float = 60.0) -> Any:
            data = await asyncio.wait_for(self._socket.read_message(), patience)
            if data is None:
                raise ConnectionError(f"closed: {self._socket.close_code} {self._socket.close_reason}")
            self.received += len(data)
            return data

        header = json.loads(await part(timeout))  # what follows belongs to it, and comes
        _, content = [json.loads(await part()) for _ in range(2)]
        buffers = []
        for _ in range(header.get("num_buffers", 0)):
            await part()
            buffers.append(await part())
        self.last = content | {"buffers": buffers}
        return header["msgtype"], self.last

    async def changes(self, seconds: float) -> tuple[dict[str, Any], list[str]]:
        """Attributes that the server changed within so many seconds, and the kinds of all messages."""
        found, kinds = {}, []
        deadline = asyncio.get_running_loop().time() + seconds
        while (left := deadline - asyncio.get_running_loop().time()) > 0:
            try:
                kind, content = await self.receive(left)
            except TimeoutError:
                break
            kinds.append(kind)
            for event in content.get("events", []):
                if event.get("kind") == "ModelChanged":
                    found[event["attr"]] = event["new"]
                    if event["attr"] == "frame":
                        self.last_frame = content["buffers"][-1]
        return found, kinds

    async def changed(self, *names: str) -> None:
        """Wait until the server has changed all of these attributes."""
        waited = set(names)
        while waited:
            _, content = await self.receive()
            waited -= {event.get("attr") for event in content.get("events", [])}

    async def refusal(self, name: str) -> None:
        """Wait until the value just set is refused, by a sentence about it or as a message that cannot be."""
        while True:
            kind, content = await self.receive()
            if kind == "ERROR":
                return
            for event in content.get("events", []):
                assert event.get("attr") != "frame", f"{name} was taken, and solved"
                if event.get("attr") == "refused" and event["new"]:
                    said = refusals(event["new"])[0]
                    if said.startswith(f"{page(SOURCE).text(title_of(name))}: "):
                        assert "Choose" in said or "Write" in said, "what is allowed"
                        return

    async def answer(self) -> None:
        """Wait for the frame that answers what was set last; one that a draft is refined to may come before."""
        while True:
            kind, content = await self.receive()
            if kind == "PATCH-DOC" and any(e.get("attr") == "frame" for e in content.get("events", [])):
                self.last_frame = content["buffers"][-1]
                name, value = self._set
                if read_header(self.last_frame)["chosen"].get(name, value) == value:
                    return

    def close(self) -> None:
        self._socket.close()
