"""The rod of the note, the same with another value, and bodies on an axis."""

import copy

NOTE = {
    "impactor": {"kind": "body", "mass": 0.5, "velocity": [-3.0, 0.0, 0.0]},
    "target": {"kind": "body", "mass": 2.0, "inertia": [0.24, 0.0, 0.24], "centre": [0.0, -0.6, 0.0]},
    "contact": {"normal": [-1.0, 0.0, 0.0]},
}


def with_value(key: str, value: object) -> dict:
    tables = copy.deepcopy(NOTE)
    *path, last = key.split(".")
    table = tables
    for name in path:
        table = table.setdefault(name, {})
    table[last] = value
    return tables


BODIES = {
    "sphere": {"kind": "sphere", "radius": 0.02, "velocity": 5.0},
    "rod": {"kind": "rod", "length": 0.2, "section": {"radius": 0.01}, "material": "steel", "velocity": 5.0},
}
STRUCK = {
    "mass": {"kind": "mass", "mass": 0.3, "velocity": -1.0},
    "rod": {**BODIES["rod"], "velocity": 2.0, "support": "free"},
    "rods": {"kind": "rods", "rods": [BODIES["rod"], BODIES["rod"]], "support": "free"},
    "stop": {"kind": "stop"},
    "half-space": {"kind": "half-space", "material": "steel"},
}
STRUCK["rods"]["rods"] = [{k: v for k, v in BODIES["rod"].items() if k not in ("kind", "velocity")}] * 2
