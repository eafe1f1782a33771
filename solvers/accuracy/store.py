"""Tables of trade-offs that have been measured: in the user's cache, and those that come with the library."""

import json
from collections.abc import Mapping
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from typing import Any

from ..jit.cache import cache_home, keep_text
from ..scene import Scene

SHIPPED = Path(__file__).parent / "tradeoffs"
SAID = ("title", "source", "note", "method")  # parts of a scene that do not change what happens
DIGITS = {"wall_time": 4, "first_time": 4, "spread": 4}  # kept of times; of all else FIGURES
FIGURES = 5
KEY_FIGURES = 9  # of numbers in a key: what follows from those given may differ in the last bits between machines
KNOWN = ("points", "scene", "quantities", "shipped", "changed", "scale")  # packed in their own way, or known otherwise
SENTENCES = ("refused", "remarks")  # made of their codes
DERIVED = ("label", "best_for")  # of a point, known from the rest
LEVEL = ("method", "ladder", "knob")  # of a point, the same for a whole ladder but for the value of its resolution


def scene_key(scene: Scene) -> str:
    """The same for scenes in which the same happens, whatever they are called and however they are solved."""
    table = {name: part for name, part in scene.struck.table().items() if name not in SAID}
    return sha256(json.dumps(_rounded(table, KEY_FIGURES), sort_keys=True).encode()).hexdigest()[:24]


def _path(scene: Scene, machine: Mapping[str, Any], code: Mapping[str, str]) -> Path:
    own = sha256(json.dumps([scene_key(scene), dict(machine), dict(code)], sort_keys=True).encode()).hexdigest()[:24]
    return cache_home() / "tradeoffs" / f"{own}.json"


def measured_here(scene: Scene, machine: Mapping[str, Any], code: Mapping[str, str]) -> dict[str, Any] | None:
    """The table of this scene, machine and code, or None."""
    return _read(_path(scene, machine, code))


def keep(scene: Scene, table: Mapping[str, Any]) -> None:
    """Write it to the cache; where that is not possible it will be measured again."""
    with suppress(OSError):
        keep_text(_path(scene, table["machine"], table["code"]), json.dumps(table, allow_nan=False))


def shipped(scene: Scene) -> dict[str, Any] | None:
    """The table that comes with the library, measured on the machine it names, or None."""
    packed = _read(SHIPPED / f"{scene_key(scene)}.json")
    return None if packed is None else unpack(packed, scene)


def _read(path: Path) -> dict[str, Any] | None:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):  # none, or half a one
        return None


def pack(table: Mapping[str, Any]) -> dict[str, Any]:
    """A table as it is shipped, a fifth as long: by columns, what repeats kept once, times and errors rounded.

    What the scene and the library know anyway is left out.
    """
    levels: list[dict[str, Any]] = []
    codes: list[Any] = []
    columns: dict[str, Any] = {"rung": [], "notes": []}
    for point in table["points"]:
        options = {key: None if key == point["knob"] else value for key, value in point["method"].items()}
        columns["rung"].append(_place(levels, {"method": options, "ladder": point["ladder"], "knob": point["knob"]}))
        columns["notes"].append([_packed_note(codes, note) for note in point["note_codes"]])
        for name, error in point["errors"].items():
            columns.setdefault("errors", {}).setdefault(name, []).append(_rounded(error, FIGURES))
        for key, value in point.items():
            if key not in (*DERIVED, *LEVEL, "notes", "note_codes", "errors"):
                kept = value if key == "size" else _rounded(value, DIGITS.get(key, FIGURES))
                columns.setdefault(key, []).append(kept)
    rest = {key: _rounded(table[key], FIGURES) for key in table if key not in (*KNOWN, *SENTENCES)}
    if rest["reference"]:
        del rest["reference"]["words"]
    return rest | {"rungs": levels, "codes": codes, "points": columns}


def unpack(packed: Mapping[str, Any], scene: Scene) -> dict[str, Any]:
    """The table that was packed, for any scene in which the same happens; `quantities` are those that have errors."""
    columns = dict(packed["points"])
    errors, notes = columns.pop("errors"), columns.pop("notes")
    points = []
    for place, level in enumerate(columns.pop("rung")):
        point = dict(packed["rungs"][level]) | {key: values[place] for key, values in columns.items()}
        if point["knob"] is not None:
            point["method"] = point["method"] | {point["knob"]: point["size"]}
        point["errors"] = {name: values[place] for name, values in errors.items()}
        point["note_codes"] = [_whole_note(packed["codes"][code], values) for code, *values in notes[place]]
        points.append(point)
    rest = {key: value for key, value in packed.items() if key not in ("rungs", "codes")}
    return rest | {"points": points, "scene": scene.table(), "quantities": dict.fromkeys(errors, "")}


def _place(known: list[Any], one: Any) -> int:
    """Of one among those known, to which it now belongs."""
    if one not in known:
        known.append(one)
    return known.index(one)


def _packed_note(known: list[Any], note: Mapping[str, Any]) -> list[Any]:
    """The place of what such notes share, and the values."""
    head = [note["code"], note["severity"], *note["values"]]
    return [_place(known, head), *(_rounded(value, FIGURES) for value in note["values"].values())]


def _whole_note(head: list[str], values: list[Any]) -> dict[str, Any]:
    code, severity, *names = head
    return {"code": code, "severity": severity, "values": dict(zip(names, values, strict=True))}


def _rounded(value: Any, figures: int) -> Any:
    if isinstance(value, float):
        return float(f"{value:.{figures - 1}e}") + 0.0  # no zero below zero
    if isinstance(value, Mapping):
        return {key: _rounded(part, figures) for key, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [_rounded(part, figures) for part in value]
    return value
