"""What messages hold, said in Python and written as types of the browser code; what is not as said is not packed."""

import re
from pathlib import Path

import numpy as np
import pytest

import app
from app.messages.encoding import packed
from app.messages.schema import MESSAGES, RECORDS, check

from .own import arrays

STATIC = Path(app.__file__).parent / "static"
TYPES = "".join((STATIC / folder / "message.js").read_text() for folder in ("shell", "beam", "mechanism"))
OF_THE_BROWSER = {"record", "shapes"}  # which no message holds
FRAMES = {"axial": "AxialFrame", "beam": "BeamFrame", "mechanism": "MechanismFrame", "bodies": "SpaceFrame"}


def typedefs() -> dict[str, dict[str, tuple[str, bool]]]:
    """Properties of every record of message.js: its type, and whether it is optional."""
    found = {}
    for name, lines in re.findall(r"@typedef \{object\} (\w+)(.*?)\*/", TYPES, re.DOTALL):
        properties = re.findall(r"@property \{(.*?)\} (\[?)(\w+)\]?(?:  .*)?$", lines, re.MULTILINE)
        found[name] = {key: (form, bool(bracket)) for form, bracket, key in properties}
    for parts, name in re.findall(r"@typedef \{(\w[^{}]* & [^{}]*)\} (\w+)", TYPES):
        found[name] = {}
        for part in parts.split(" & "):
            inner = re.fullmatch(r"Partial<(\w+)>", part)
            more = found[inner[1] if inner else part]
            found[name] |= {key: (form, True) for key, (form, _) in more.items()} if inner else more
    return found


KNOWN = typedefs()


@pytest.mark.parametrize("kind", MESSAGES)
def test_a_message_has_the_same_fields_in_python_and_in_the_browser(kind):
    said = {
        name: ("Numbers" if field.is_array else field.form, field.optional)
        for name, field in MESSAGES[kind].items()
        if "#" not in name
    }
    said["kind"] = (f"'{kind}'", False)
    if kind in ("beam", "mechanism"):
        said["contacts"] = ("Contact[]", False)  # which are made rows when they are read
    types = {name: form for name, form in KNOWN[FRAMES[kind]].items() if name not in OF_THE_BROWSER}
    assert types == said


@pytest.mark.parametrize("name", RECORDS)
def test_a_record_has_the_same_fields_in_python_and_in_the_browser(name):
    assert KNOWN[name] == {key: (field.form, field.optional) for key, field in RECORDS[name].items()}


MESSAGE = {key: None for key, field in MESSAGES["bodies"].items() if not field.is_array} | {"kind": "bodies"}
TURNS = {"impactorTurn": np.zeros((5, 3, 3)), "targetTurn": np.zeros((5, 3, 3))}
MOVES = TURNS | {"impactorPath": np.zeros((5, 3)), "targetPath": np.zeros((5, 3))}


def test_a_message_is_read_back_with_the_shapes_it_was_packed_with():
    found = arrays(packed(MESSAGE, MOVES | {"targetPath": (np.arange(15, dtype="<i2").reshape(5, 3), 0.5)}))
    assert found["impactorTurn"].shape == (5, 3, 3)
    assert found["targetPath"].tolist() == (0.5 * np.arange(15).reshape(5, 3)).tolist()


@pytest.mark.parametrize(
    "header, arrays, said",
    [
        (MESSAGE | {"mood": 1}, MOVES, r"unknown .'mood'."),
        ({key: value for key, value in MESSAGE.items() if key != "size"}, MOVES, r"missing .'size'."),
        (MESSAGE, TURNS, r"missing .'impactorPath', 'targetPath'."),
        (MESSAGE, MOVES | {"targetPath": np.zeros((5, 2))}, r"targetPath: got \(5, 2\)"),
        (MESSAGE, MOVES | {"targetPath": np.zeros((4, 3))}, r"targetPath: got \(4, 3\)"),
        (MESSAGE, MOVES | {"targetPath": np.zeros(15)}, r"targetPath: got \(15,\)"),
        (MESSAGE | {"samples": 6}, MOVES, r"unknown .'samples'."),
    ],
    ids=["unknown", "missing", "missing array", "other side", "other length", "flat", "of no field"],
)
def test_what_is_not_as_said_is_not_packed(header, arrays, said):
    with pytest.raises(ValueError, match=said):
        packed(header, arrays)


def test_the_keys_of_records_are_checked():
    header = {key: None for key, field in MESSAGES["beam"].items() if not field.is_array and not field.optional}
    header |= {"kind": "beam", "places": 3, "beam": {"length": 1.0}}
    shapes = {key: (3,) for key, field in MESSAGES["beam"].items() if field.is_array and not field.optional}
    shapes |= {"contacts": (2, 4), "rates": (2, 2, 2)}
    with pytest.raises(ValueError, match=r"beam: unknown .., missing .'endMass'"):
        check(header, shapes)
    with pytest.raises(ValueError, match="staticShape"):
        check(header | {"beam": None}, shapes | {"staticShape": (4,)})
