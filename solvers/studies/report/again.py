"""The words by which `study` varies the keys of a design again."""

import json
from collections.abc import Collection, Mapping
from typing import Any

from ...scene import Scene
from ...validation import SceneError
from ..study.axes import axes_of
from ..study.design import SAMPLES

FEWEST = 3  # values, of which a range is shorter


def study_words(scene: Scene, design: Mapping[str, Any], shares: Collection[str]) -> dict[str, str] | None:
    """By keys, with commas between those that go together, as `--vary` reads them; None where some values have no
    words, as distributions of SciPy's own, or where no `study` has chosen the points. `shares`: first keys of those
    that are drawn together, each about its own value."""
    if design["sample"] not in SAMPLES:
        return None
    first = next((axis["values"][0][0] for axis in design["vary"] if axis["keys"] == ["method.name"]), None)
    scene = scene if first is None else scene.replace({"method.name": first})
    found = {}
    for axis in design["vary"]:
        share = axis["keys"][0] in shares
        words = next((each for each in _tried(axis, share) if _same(scene, axis, each, design["sample"], share)), None)
        if words is None:
            return None
        found[",".join(axis["keys"])] = words
    return found


def _tried(axis: Mapping[str, Any], share: bool) -> list[str]:
    """The shortest first."""
    if "law" in axis:
        high = axis["law"].rpartition(",")[2].strip(" )")
        return [f"{100.0 * (float(high) - 1.0):.10g}%"] if share else [axis["law"]]
    rows = axis["values"]
    if not all(each == row[0] for row in rows for each in row):
        return [",".join(f"({','.join(map(_word, row))})" for row in rows)]
    values = [row[0] for row in rows]
    listed = ",".join(map(_word, values))
    if len(values) < FEWEST or any(isinstance(each, bool) or not isinstance(each, (int, float)) for each in values):
        return [listed]
    ends = f"{_word(min(values))}..{_word(max(values))}:{len(values)}"
    return [ends, f"{ends}:log", f"{ends}:linear", listed]


def _same(scene: Scene, axis: Mapping[str, Any], words: str, sample: str, share: bool) -> bool:
    """Whether these words give this axis."""
    try:
        (found,) = axes_of(scene, {",".join(axis["keys"]): words}, sample != "grid")
    except SceneError:
        return False
    return bool(found.own) == share and json.loads(json.dumps(found.table())) == axis


def _word(value: Any) -> str:
    """As TOML has it, but for text, which stands bare."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Mapping):
        return f"{{{','.join(f'{name}={_inner(each)}' for name, each in value.items())}}}"
    if isinstance(value, float):
        return short if float(short := f"{value:.15g}") == value else repr(value)
    return str(value)


def _inner(value: Any) -> str:
    return json.dumps(value) if isinstance(value, str) else _word(value)
