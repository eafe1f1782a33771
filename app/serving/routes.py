"""What a server has at addresses of its own for each laboratory in a page."""

import re

from .lessons import Lesson, OwnLesson
from .pages import LIBRARIES, STATIC, TEXTS, VERSION, Alive, Asset, Figure, Gallery, Library, Texts
from .uploads import MeasuredRecord


def routes() -> list[tuple]:
    """What is served beside the page and its socket, as Tornado takes it: (address, handler, options) each."""
    return [
        (r"/liveness", Alive),
        (r"/record", MeasuredRecord),
        (r"/gallery/([a-zA-Z-]+)", Gallery),
        (r"/lesson", OwnLesson),
        (r"/lessons/([a-z0-9-]{1,60})", Lesson),
        (r"/figures/([a-zA-Z-]+)/([a-z-]+)", Figure),
        (rf"/({'|'.join(re.escape(name) for name, _ in LIBRARIES)})", Library),
        (rf"/assets/{VERSION}/text/({'|'.join(TEXTS)})\.js", Texts),
        (rf"/assets/{VERSION}/(.*)", Asset, {"path": str(STATIC)}),
    ]
