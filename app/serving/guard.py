"""What a client may send: the choices of its own laboratory, and nothing else of the document.

Bokeh's server lets a client set any property of any model. Rests on details of the pinned Bokeh and Panel:
tests/app/serving/test_guard.py fails if they change.
"""

from typing import Any, NamedTuple

from ..choices.bodies import LONGEST
from ..choices.choices import Choices
from ..choices.own import LONGEST as LONGEST_SCENE
from ..choices.own import is_own
from ..page.questions import Questions
from ..views.whatif import LONGEST as LONGEST_POINTS
from ..views.whatif import POINTS
from .limits import MAX_EVENTS

MAX_PULLS = 3  # of the document by one socket; a page pulls it once
LONGEST_VALUE = LONGEST  # letters of a text
LONGER = {"scene": LONGEST_SCENE, POINTS: LONGEST_POINTS}  # of one's own, whose name is all of it; of the map
SETTABLE = frozenset((*Choices.CHOSEN, *Questions.ASKED))
# What Panel reports by itself of the browser; dropped without a word.
REPORTED = frozenset(
    ("dark_mode", "device_pixel_ratio", "language", "timezone", "timezone_offset", "webdriver", "webgl")
)

READY = [  # as Bokeh's script writes it
    {
        "kind": "MessageSent",
        "msg_type": "bokeh_event",
        "msg_data": {"type": "event", "name": "document_ready", "values": values},
    }
    for values in ({"type": "map"}, {"type": "map", "entries": []})
]


class Decision(NamedTuple):
    """What becomes of a message."""

    reason: str | None  # why it is refused
    events: list[dict[str, Any]]  # those of it that are taken


def decide(kind: str, content: Any, own: str, settable: frozenset[str]) -> Decision:
    """Of a message of this kind, and its content; `own` is the id of the model that holds the visitor's choices."""
    if kind == "PULL-DOC-REQ":
        return Decision(None, [])
    events = content["events"] if isinstance(content, dict) and content.keys() == {"events"} else None
    if kind != "PATCH-DOC" or not isinstance(events, list) or len(events) > MAX_EVENTS:
        return Decision("not allowed", [])
    taken = []
    for event in events:
        if _sets(event, own, settable) or _says_ready(event):
            taken.append(event)
        elif not _reports(event):
            return Decision("not allowed", [])
    return Decision(None, taken)


def _sets(event: Any, own: str, settable: frozenset[str]) -> bool:
    """Whether it sets one of the visitor's choices to a plain value."""
    return (
        _is_change(event)
        and event["model"]["id"] == own
        and event["attr"] in settable
        and _plain(event.get("new"), LONGER.get(event["attr"], LONGEST_VALUE))
        and event.keys() <= {"kind", "model", "attr", "new"}
    )


def _reports(event: Any) -> bool:
    return _is_change(event) and event["attr"] in REPORTED


def _is_change(event: Any) -> bool:
    return (
        isinstance(event, dict)
        and event.get("kind") == "ModelChanged"
        and isinstance(event.get("model"), dict)
        and event["model"].keys() == {"id"}
        and isinstance(event["model"]["id"], str)
        and isinstance(event.get("attr"), str)
    )


def _plain(value: Any, longest: int) -> bool:
    """A number, a boolean or a short text, as the browser writes them; the bounds are checked where it is taken."""
    if isinstance(value, dict):
        return value.keys() == {"type", "value"} and value["type"] == "number" and isinstance(value["value"], str)
    if isinstance(value, str):
        return len(value) <= longest
    return value is None or isinstance(value, bool | int | float)


def _says_ready(event: Any) -> bool:
    """The one event of the document: that the page is drawn."""
    return isinstance(event, dict) and event in READY  # with no other key: Bokeh makes objects of all that it finds


def own_scenes(events: list[dict[str, Any]]) -> list[str]:
    """Names of scenes of the visitor's own that these events, which are taken, choose."""
    return [event["new"] for event in events if event.get("attr") == "scene" and is_own(event["new"])]


def newest_only(events: list[dict[str, Any]], later: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The events without the choices that a later message sets again."""
    again = {event["attr"] for event in later if event["kind"] == "ModelChanged"} & set(Choices.CHOSEN)
    return [event for event in events if event["kind"] != "ModelChanged" or event["attr"] not in again]
