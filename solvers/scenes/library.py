"""Built-in scenes by name, scene files, and the scenes in heads of saved histories."""

import difflib
import re
from functools import lru_cache
from pathlib import Path
from typing import Any

from .. import validation
from ..scene import Scene
from ..text.catalogue import SOURCE, library, spoken
from ..validation import SceneError, allowed
from .saved import MARK, as_toml, head_of

MAX_FILE_SIZE = 100_000  # bytes; a scene is a page of text
SCENES = Path(__file__).parent
SceneOrName = Scene | str | Path  # a name of `scene_names`, or a scene file


def _named(error: BaseException) -> str:
    return (str(error).splitlines() or [""])[0][:120] or "nested too deeply"


def scene_names() -> list[str]:
    """Names of the scenes that come with the library: the first to start with, the thesis's figures and tables last."""
    return list(_names())


@lru_cache
def _names() -> tuple[str, ...]:
    return tuple(sorted((path.stem for path in SCENES.glob("*.toml")), key=_rank))


def _rank(name: str) -> tuple[object, ...]:
    figure = re.fullmatch(r"(figure|table)-(\d+)\.(\d+)", name)
    if figure is None:
        return name != "fixed-rod", 0, "", 0, name
    return True, int(figure[2]), figure[1], int(figure[3]), name


def load(name_or_path: str | Path) -> Scene:
    """A built-in scene by name, a scene file, or the scene of histories that were saved (`.csv`).

    Raises SceneError if there is no such scene or file, or if what it says cannot be used.
    """
    if str(name_or_path) in _names():
        return built_in(str(name_or_path), spoken())
    path = Path(name_or_path)
    try:
        found = path.is_file()
    except (OSError, ValueError):  # no name a file could have
        found = False
    if not found:
        raise _no_such_scene(str(name_or_path))
    return Scene.from_table(read_toml(path))


def built_in(name: str, language: str) -> Scene:
    """One of `scene_names`, its title, source and note in this language as far as that has them."""
    translated = {} if language == SOURCE else library(language).family(f"scene.{name}")
    return Scene.from_table(read_toml(SCENES / f"{name}.toml") | translated)


def scene_of(given: SceneOrName) -> Scene:
    """The scene itself, or the one of this name, for whatever takes a scene. Raises SceneError as `load` does."""
    if isinstance(given, Scene):
        return given
    if isinstance(given, str | Path):
        return load(given)
    raise _no_such_scene(given)


def _no_such_scene(given: object) -> SceneError:
    near = difflib.get_close_matches(given, _names(), n=4) if isinstance(given, str) else []
    if near:
        return SceneError("scene", given, allowed("scene-near", names=near))
    plain = [name for name in _names() if "." not in name][:12]
    return SceneError("scene", given, allowed("scene", names=plain))


def _holds_results(path: Path) -> bool:
    """Whether it is a NetCDF file, of `Solution.dataset` or `--series`, by how such files begin."""
    try:
        with path.open("rb") as file:
            return file.read(4).startswith((b"CDF", b"\x89HDF"))
    except OSError:
        return False  # said below


def read_toml(path: Path) -> dict[str, Any]:
    import tomllib

    saved = path.suffix.lower() == ".csv"
    if _holds_results(path):
        raise SceneError("scene", str(path), allowed("scene-not-results"))
    if not saved and path.stat().st_size > MAX_FILE_SIZE:
        raise SceneError("scene", str(path), allowed("scene-size", most=MAX_FILE_SIZE))
    try:
        tables = tomllib.loads(head_of(path) if saved else path.read_text(encoding="utf-8-sig"))
        return {name: table for name, table in tables.items() if not (saved and name == MARK)}
    except (ValueError, RecursionError) as error:  # syntax, encoding, endless numbers, endless nesting
        raise SceneError("scene", str(path), allowed("toml", why=_named(error))) from None
    except OSError as error:
        raise SceneError("scene", str(path), allowed("readable", why=error.strerror)) from None


def as_given(scene: Scene) -> str:
    """The scene as the text of a scene file that says what was given and no more, so that what follows from it follows
    again where values are changed; without its view."""
    tables = scene.given or scene.table()
    return as_toml(validation.plain({name: table for name, table in tables.items() if name != "view"})) + "\n"


def to_toml(scene: SceneOrName) -> str:
    """The scene as the text of a scene file, which `load` reads back into the same one; without its view."""
    return as_toml(scene_of(scene).table()) + "\n"
