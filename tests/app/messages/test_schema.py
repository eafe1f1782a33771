"""What messages hold, said in Python, and as types of the browser code; what is not as said is not packed."""

import re

import numpy as np
import pytest

from app.messages.declarations import PLACE, declarations
from app.messages.encoding import packed
from app.messages.records import RECORDS
from app.messages.schema import MESSAGES, check

from .own import arrays


def test_the_types_of_the_browser_are_those_of_the_schema():
    """Else: `python -m app.messages.declarations`."""
    assert PLACE.read_text(encoding="utf-8") == declarations()


def test_every_type_that_a_field_names_is_declared():
    text = declarations()
    known = set(re.findall(r"export (?:type|interface) (\w+)", text)) | {"Note", "Record", "Partial", "Float"}
    for fields in (*MESSAGES.values(), *RECORDS.values()):
        for name, each in fields.items():
            assert each.is_array or set(re.findall(r"\b[A-Z]\w+", each.form)) <= known, name


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
