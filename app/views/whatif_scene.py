"""The scene file of a point of the map, and the keys of scene files that its axes stand for."""

from collections.abc import Mapping, Sequence
from itertools import chain
from typing import Any

import numpy as np

from solvers import METHODS, Scene, SceneError
from solvers.accuracy.reference import exact_method
from solvers.methods.multibody.method import Multibody
from solvers.scenes.saved import as_toml

from ..choices.request import Request
from ..messages.parts import taken_along
from ..messages.transverse import chosen_method

Table = Mapping[str, Any]
SAME = 2e-11  # relative difference of numbers that are the same but for rounding, as of choices to 12 digits
ABOUT = ("title", "source", "note")  # keys that say nothing of how it is solved


def scene_file(requests: Sequence[Request | None]) -> dict[str, Any]:
    """`scene`: the file of the first impact, as the map solves it; `keys`: those by which the others differ from it,
    with the value of each, None of those that are refused; or no keys where a file with these values is not the same
    scene, or none can be varied. The first one is not refused.
    """
    first, *others = [request and _table(request) for request in requests]
    assert first is not None and requests[0] is not None
    return {"scene": as_toml(first) + "\n", "keys": _keys(first, others) if _varies(requests[0]) else None}


def _varies(request: Request) -> bool:
    """Whether a study can vary it: bodies in space and mechanisms that move on it cannot."""
    return request.kind != "bodies" and (request.exact or not isinstance(chosen_method(request)[0], Multibody))


def _table(request: Request) -> dict[str, Any]:
    """Of the scene file that is solved as the map is."""
    scene = request.scene
    if request.exact:
        scene, method = exact_method(scene, request.restitution)
    else:
        method = chosen_method(request)[0]
    duration = request.scene.method.get("duration")
    known = request.exact or request.scene.method.get("name") in (None, *METHODS)
    usual = type(method)().table()
    options = {name: value for name, value in method.table().items() if name == "name" or value != usual[name]}
    lasting = {"duration": duration} if duration and known else {}
    return taken_along(scene, request).table() | {"method": options | lasting}


def _keys(first: Table, others: Sequence[Table | None]) -> dict[str, list[float | None]] | None:
    columns = [None if table is None else _solved(table) for table in others]
    known = [column for column in columns if column is not None]
    own, names = _solved(first), dict.fromkeys(chain.from_iterable(known))
    moved = [name for name in names if any(not _same(own.get(name), each.get(name)) for each in known)]
    if not all(_is_number(each.get(name)) for each in known for name in moved):
        return None
    scene = Scene.from_table(first)
    for column in known:
        try:
            again = scene.replace({name: column[name] for name in moved})
        except SceneError:
            return None
        if not _alike(_solved(again.table()), column):
            return None
    return {name: [None if column is None else column[name] for column in columns] for name in moved}


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _solved(table: Table) -> dict[str, Any]:
    """What it is solved with, by keys."""
    return _flat({name: part for name, part in table.items() if name not in ABOUT})


def _flat(table: Any, at: str = "") -> dict[str, Any]:
    """Values by their keys as `Scene.replace` takes them: what is in a list goes by its number."""
    if isinstance(table, Mapping):
        parts = [(str(name), each) for name, each in table.items()]
    elif isinstance(table, list | tuple) and table and all(isinstance(each, Mapping) for each in table):
        parts = [(str(number), each) for number, each in enumerate(table, 1)]
    else:
        return {at.removesuffix("."): table}
    return dict(chain.from_iterable(_flat(each, f"{at}{name}.").items() for name, each in parts))


def _alike(one: Table, other: Table) -> bool:
    return one.keys() == other.keys() and all(_same(value, other[name]) for name, value in one.items())


def _same(one: Any, other: Any) -> bool:
    try:
        return bool(np.allclose(one, other, rtol=SAME, atol=0.0))
    except (TypeError, ValueError):
        return one == other
