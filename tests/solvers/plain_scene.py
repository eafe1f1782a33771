"""The table of a plain scene, and the same with another value."""

import copy

from tests.catalog import RIGID, STEEL_ROD

PLAIN = {
    "title": "A test",
    "impactor": {"kind": "mass", "mass": 2.133, "velocity": 1.0},
    "target": STEEL_ROD,
    "contact": RIGID,
}


def with_value(key: str, value: object) -> dict:
    """The plain scene with another value at a dotted key."""
    tables = copy.deepcopy(PLAIN)
    *path, last = key.split(".")
    table = tables
    for name in path:
        table = table[name]
    table[last] = value
    return tables
