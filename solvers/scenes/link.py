"""The query by which the page opens a scene: its name, or the text of its file, packed, so that no server keeps it."""

import base64
import zlib
from urllib.parse import urlencode

from ..scene import Scene
from .library import to_toml

OWN = "own."  # with which names of scenes of visitors' own begin, see app/static/wire/own.js
LONGEST = 3_000  # letters of such a name


def packed(text: str) -> str:
    """The name of a scene by the text of its file."""
    pack = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    return OWN + base64.urlsafe_b64encode(pack.compress(text.encode()) + pack.flush()).decode().rstrip("=")


def query_of(scene: Scene, name: str | None = None) -> str | None:
    """Of a built-in scene as it comes, by its `name`, or of any other; None where its file is too long for a link."""
    chosen = packed(to_toml(scene)) if name is None else name
    return None if len(chosen) > LONGEST else "?" + urlencode({"scene": chosen})
