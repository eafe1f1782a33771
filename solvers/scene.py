"""A scene: what is struck by what. SI units, immutable, checked when built, and written back without loss."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import checks
from .bodies import Impactor, Rod, as_table
from .checks import SceneError
from .contact import LAWS

LARGEST_MASS_RATIO = 1e9  # of target to impactor, and the other way round; beyond it doubles tell nothing
MAX_FILE_SIZE = 100_000  # bytes; a scene is a page of text


@dataclass(frozen=True)
class Scene:
    """An impactor about to touch a target at rest at time zero.

    `contact` is a contact law with its constants in SI units; `method` holds the table `[method]` as given, which says
    how the scene is solved unless the caller says otherwise.
    """

    impactor: Impactor
    target: Rod
    contact: Any
    title: str = ""
    source: str = ""
    method: Mapping[str, object] = field(default_factory=dict)
    given: Mapping[str, object] = field(default_factory=dict, repr=False, compare=False)

    @classmethod
    def from_table(cls, given: object) -> "Scene":
        """A scene from nested tables of SI values, as in a scene file.

        Raises SceneError that names the key, the value and what is allowed.
        """
        given = checks.table("", given, ("title", "source", "impactor", "target", "contact", "method"))
        for part in ("impactor", "target"):
            checks.required("", given, part, "a table")
        impactor, target = Impactor.read(given["impactor"]), Rod.read(given["target"])
        ratio = target.mass / impactor.mass
        if not 1.0 / LARGEST_MASS_RATIO <= ratio <= LARGEST_MASS_RATIO:
            low, high = target.mass / LARGEST_MASS_RATIO, target.mass * LARGEST_MASS_RATIO
            allowed = f"{low:.3g} to {high:.3g} kg for this target: one then does not feel the other"
            raise SceneError("impactor.mass", impactor.mass, allowed)
        contact = given.get("contact", {"law": "rigid"})
        if not isinstance(contact, Mapping):
            raise SceneError("contact", contact, "a table with the key law")
        law = LAWS[checks.choice("contact.law", contact.get("law", "rigid"), LAWS)]
        checks.table("contact", contact, ("law", *law.KEYS))
        method = given.get("method", {})
        checks.table("method", method, ("name", "modes", "steps", "tolerance", "duration"))
        return cls(
            impactor,
            target,
            law.read(contact, impactor, target),
            checks.text("title", given.get("title", "")),
            checks.text("source", given.get("source", "")),
            dict(method),
            given,
        )

    def replace(self, changes: Mapping[str, object]) -> "Scene":
        """The scene with other values, by dotted key: `scene.replace({"target.length": 0.5})`.

        Raises SceneError for a key that does not exist or a value that is not allowed.
        """
        tables = _copied(self.given or self.table())
        for key, value in changes.items():
            *path, last = key.split(".")
            table = tables
            for name in path:
                table = table.setdefault(name, {})
                if not isinstance(table, dict):
                    raise SceneError(key, value, f"no key inside {name}, which is not a table")
            table[last] = value
        return Scene.from_table(tables)

    def table(self) -> dict[str, object]:
        """Nested tables that `from_table` reads back into the same scene, with all that follows from what was given."""
        contact = {"law": self.contact.NAME} | self.contact.table(self.impactor.velocity)
        if "restitution" in contact and self.given:  # as given: the way back through the damping rounds
            contact["restitution"] = self.given["contact"]["restitution"]
        tables: dict[str, object] = {
            "title": self.title,
            "source": self.source,
            "impactor": as_table(self.impactor),
            "target": as_table(self.target),
            "contact": contact,
        }
        return tables | ({"method": dict(self.method)} if self.method else {})

    @property
    def mass_ratio(self) -> float:
        """beta = m2 / m1, target over impactor, (3.9)."""
        return self.target.mass / self.impactor.mass


def _copied(tables: Mapping[str, object]) -> dict[str, Any]:
    return {key: _copied(value) if isinstance(value, Mapping) else value for key, value in tables.items()}


def _named(error: BaseException) -> str:
    return (str(error).splitlines() or [""])[0][:120] or "nested too deeply"


SCENES = Path(__file__).parent / "scenes"


def scene_names() -> list[str]:
    """Names of the scenes that come with the library, the first one being the one to start with."""
    return sorted((path.stem for path in SCENES.glob("*.toml")), key=lambda name: (name != "fixed-rod", name))


def load(name_or_path: str | Path) -> Scene:
    """A built-in scene by name, or a scene file.

    Raises SceneError if there is no such scene or file, or if what it says cannot be used.
    """
    if str(name_or_path) in scene_names():
        path = SCENES / f"{name_or_path}.toml"
    else:
        path = Path(name_or_path)
        try:
            found = path.is_file()
        except (OSError, ValueError):  # no name a file could have
            found = False
        if not found:
            allowed = "a scene file, or one of " + ", ".join(scene_names())
            raise SceneError("scene", str(name_or_path), allowed)
    return Scene.from_table(read_toml(path))


def read_toml(path: Path) -> dict[str, object]:
    import tomllib

    if path.stat().st_size > MAX_FILE_SIZE:
        raise SceneError("scene", str(path), f"a file of at most {MAX_FILE_SIZE} bytes")
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (ValueError, RecursionError) as error:  # syntax, encoding, endless numbers, endless nesting
        raise SceneError("scene", str(path), f"a TOML file in UTF-8 ({_named(error)})") from None
    except OSError as error:
        raise SceneError("scene", str(path), f"a readable file ({error.strerror})") from None
