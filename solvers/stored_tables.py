"""Tables of trade-offs that have been measured: in the user's cache, and those that come with the library."""

import json
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from .jit import cache_home
from .scene import Scene

SHIPPED = Path(__file__).parent / "tradeoffs"
SAID = ("title", "source", "note", "method")  # parts of a scene that do not change what happens


def scene_key(scene: Scene) -> str:
    """The same for scenes in which the same happens, whatever they are called and however they are solved."""
    table = {name: part for name, part in scene.table().items() if name not in SAID}
    return sha256(json.dumps(table, sort_keys=True).encode()).hexdigest()[:24]


def _path(scene: Scene, machine: Mapping[str, object], version: str) -> Path:
    own = sha256(json.dumps([scene_key(scene), dict(machine), version], sort_keys=True).encode()).hexdigest()[:24]
    return cache_home() / "tradeoffs" / f"{own}.json"


def measured_here(scene: Scene, machine: Mapping[str, object], version: str) -> dict[str, Any] | None:
    """The table of this scene, machine and state of the library, or None."""
    return _read(_path(scene, machine, version))


def keep(scene: Scene, table: Mapping[str, Any]) -> None:
    """Write it to the cache; where that is not possible it will be measured again."""
    path = _path(scene, table["machine"], table["version"])
    beside = path.with_suffix(".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        beside.write_text(json.dumps(table, allow_nan=False), encoding="utf-8")
        beside.replace(path)  # at once: a reader beside us sees all of it or nothing
    except OSError:
        return


def shipped(scene: Scene) -> dict[str, Any] | None:
    """The table that comes with the library, measured on the machine it names, or None."""
    return _read(SHIPPED / f"{scene_key(scene)}.json")


def _read(path: Path) -> dict[str, Any] | None:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):  # none, or half a one
        return None
