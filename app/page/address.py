"""What is chosen, open on the page and asked there, as its address says it."""

import re
from itertools import islice
from typing import Any

import param

from ..choices.beam import free_place
from ..choices.bodies import LONGEST as LONGEST_VALUES
from ..choices.bodies import is_key
from ..choices.body_value import with_body_value
from ..choices.choices import Choices, accepts, refusal
from ..choices.own import LONGEST, is_own
from ..choices.scene_of import choices_of
from ..text.refusals import SOME_TEXT, Refused
from ..views.registry import VIEWS, opened_with
from .questions import Questions, accepted

PANELS = {view.key: view.opener for view in VIEWS}  # by name in the address: the property that opens it
_QUESTIONS = {  # by name in the address
    question.address: (name, view.key, question)
    for view in VIEWS
    for name, question in view.asked.items()
    if question.address
}
ASKED = {  # by name in the address: the property, the panel in which it is asked, and what it needs another to be
    key: (name, panel, question.needs[1] if question.needs else "")
    for key, (name, panel, question) in _QUESTIONS.items()
}
LONGEST_TEXT = 80  # of a value in an address
MOST_VALUES = LONGEST_VALUES // len("target.mass=1")  # of bodies: more are longer than they may be together
FORMER = {"seconds": "motion_seconds", "links": "motion_links"}  # keys of older links, and what they are now
FORMER_PANELS = {"motion": {"method": "multibody"}}  # what is a choice since


def from_address(arguments: dict[str, list[bytes]]) -> tuple[dict[str, Any], list[ValueError]]:
    """Choices from the query of an address: what can be used, and a refusal for each that cannot.

    A scene in the address brings its own values; the others then change them.
    """
    kept: dict[str, Any] = {}
    refused: list[ValueError] = []
    arguments = _as_now(arguments)
    for name in (name for name in Choices.CHOSEN if name in arguments or name == "bodies"):
        if name == "bodies":  # whose values have keys of their own
            more, refused_too = _bodies_in(arguments, kept)
            kept |= more
            refused += refused_too
            continue
        text = text_of(arguments[name], LONGEST if name == "scene" else LONGEST_TEXT)
        value: Any = value_of(Choices.param[name], text)
        if not accepts(name, value):
            refused.append(refusal(name, value if is_own(value) else shown_of(text, value)))
            continue
        if name == "scene":
            kept |= choices_of(value)
        kept[name] = value
    if "support" in arguments and "place" not in arguments and "support" in kept and "place" in kept:
        kept["place"] = free_place(kept["support"], kept["place"])
    return kept, refused


def _as_now(arguments: dict[str, list[bytes]]) -> dict[str, list[bytes]]:
    """The query of an older link as one would be written now."""
    opened = text_of(arguments["panel"]).split(",") if "panel" in arguments else []
    meant = {key: [value.encode()] for name in opened for key, value in FORMER_PANELS.get(name, {}).items()}
    return meant | {FORMER.get(key, key): value for key, value in arguments.items()}


def _bodies_in(arguments: dict[str, list[bytes]], kept: dict[str, Any]) -> tuple[dict[str, Any], list[ValueError]]:
    """Values of bodies, by keys of scene files in SI units, as choices of the scene that is `kept`; and refusals."""
    found: dict[str, Any] = dict(kept)
    refused: list[ValueError] = []
    for key in islice(filter(is_key, arguments), MOST_VALUES):
        asked = Choices(**found).chosen() | {"body_value": f"{key}={text_of(arguments[key])}"}
        try:
            found |= with_body_value(asked)
        except ValueError as refusal:
            refused.append(refusal)
    if sum(map(is_key, arguments)) > MOST_VALUES:
        refused.append(Refused("refused.body-values", longest=LONGEST_VALUES))
    return found, refused


def text_of(given: list[bytes], longest: int = LONGEST_TEXT) -> str:
    """What an address says of one key, the last if it says it twice, in so many letters at most."""
    return given[-1].decode("utf-8", "replace")[:longest]


def value_of(parameter: param.Parameter, text: str) -> object:
    """What the text means to a parameter; the text itself, which it will not accept, where it means nothing."""
    if isinstance(parameter, param.Boolean):
        return {"true": True, "false": False}.get(text, text)
    try:
        if isinstance(parameter, param.Integer):
            return int(text)
        return float(text) if isinstance(parameter, param.Number) else text
    except ValueError:
        return text


def shown_of(text: str, value: object) -> object:
    """What may be shown of a value from an address: nothing that could be more than a word or a number."""
    return value if re.fullmatch(r"[\w.+-]{1,24}", text) else SOME_TEXT


def opened_from_address(arguments: dict[str, list[bytes]]) -> tuple[dict[str, Any], list[ValueError]]:
    """Open panels and their questions from the query of an address: what can be used, and a refusal for each that
    cannot. A budget goes before a tolerance. Without a word of panels those that the scene is opened with."""
    named = "scene" in arguments and "panel" not in arguments
    kept: dict[str, Any] = opened_with(text_of(arguments["scene"], LONGEST)) if named else {}
    refused: list[ValueError] = []
    for name in filter(None, text_of(arguments["panel"]).split(",") if "panel" in arguments else ()):
        if name in PANELS:
            kept[PANELS[name]] = True
        elif name not in FORMER_PANELS:
            value = shown_of(name, repr(name))
            refused.append(Refused("refused.panel", value=value, options=list(PANELS)))
    for key, (name, _, question) in _QUESTIONS.items():
        if key not in arguments:
            continue
        text = text_of(arguments[key])
        value = value_of(question.parameter, text)
        if not accepted(name, value):
            refused.append(refusal(name, shown_of(text, value), Questions, key))
            continue
        kept[name] = value
        if question.needs:
            kept |= dict([question.needs])
    return kept, refused
