"""A scene: what is struck by what. SI units, immutable, checked when built, and written back without loss."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from . import checks
from .bodies import Body, Rods, check_struck, in_space, read_body, read_normal
from .bodies.compact import SPEED_RANGE
from .checks import SceneError
from .contact import LAWS
from .numerics import impulses

LARGEST_MASS_RATIO = 1e9  # of target to impactor, and the other way round; beyond it doubles tell nothing
LONGEST_NOTE = 600  # characters
MAX_FILE_SIZE = 100_000  # bytes; a scene is a page of text


@dataclass(frozen=True)
class Scene:
    """An impactor about to touch a target at rest at time zero.

    `contact` is a contact law with its constants in SI units; `method` holds the table `[method]` as given, which says
    how the scene is solved unless the caller says otherwise; `note` tells the reader what is seen and what was printed.
    """

    impactor: Any
    target: Any
    contact: Any
    joint_laws: tuple[Any, ...] = ()  # of the joints of a chain of rods; None where the joint is bonded
    title: str = ""
    source: str = ""
    method: Mapping[str, object] = field(default_factory=dict)
    given: Mapping[str, object] = field(default_factory=dict, repr=False, compare=False)
    normal: tuple[float, float, float] | None = None  # from impactor to target, where they are bodies in space
    note: str = ""

    @classmethod
    def from_table(cls, given: object) -> "Scene":
        """A scene from nested tables of SI values, as in a scene file.

        Raises SceneError that names the key, the value and what is allowed.
        """
        given = checks.table("", given, ("title", "source", "note", "impactor", "target", "contact", "method"))
        for part in ("impactor", "target"):
            checks.required("", given, part, "a table")
        impactor, target = read_body("impactor", given["impactor"]), read_body("target", given["target"])
        normal = _read_normal(impactor, target, given.get("contact"))
        if impactor.kind == "pulse":
            impactor = _on_rod(impactor, target, given.get("contact"))
        else:
            if normal is None:
                _check_approach(impactor, target)
            _check_masses(impactor, target)
        method = given.get("method", {})
        checks.table("method", method, METHOD_KEYS)
        return cls(
            impactor,
            target,
            _read_law("contact", given.get("contact", {"law": "rigid"}), impactor, target, normal is not None),
            _read_joint_laws(impactor, target),
            checks.text("title", given.get("title", "")),
            checks.text("source", given.get("source", "")),
            dict(method),
            given,
            normal,
            checks.text("note", given.get("note", ""), LONGEST_NOTE),
        )

    def replace(self, changes: Mapping[str, object]) -> "Scene":
        """The scene with other values, by dotted key: `scene.replace({"target.length": 0.5})`.

        Another `method.name` takes the options of the method before with it; `duration` stays. Raises SceneError for a
        key that does not exist or a value that is not allowed.
        """
        tables = _copied(self.given or self.table())
        options = tables.get("method", {})
        if changes.get("method.name", options.get("name")) != options.get("name") is not None:
            tables["method"] = {name: value for name, value in options.items() if name == "duration"}
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
        contact = {"law": self.contact.NAME} | self.contact.table(self.speed)
        for name in {"restitution", "nominal_restitution"} & set(self.given.get("contact", ())):
            del contact["damping"]  # as given: it says more, and stays with the blow when its speed is changed
            contact[name] = self.given["contact"][name]
        if self.normal is not None:
            contact["normal"] = list(self.normal)
        tables: dict[str, object] = {
            "title": self.title,
            "source": self.source,
            **({"note": self.note} if self.note else {}),
            "impactor": self.impactor.table(),
            "target": self.target.table(),
            "contact": contact,
        }
        return tables | ({"method": dict(self.method)} if self.method else {})

    @property
    def mass_ratio(self) -> float:
        """beta = m2 / m1, target over impactor, (3.9); infinite for a wall."""
        return self.target.mass / self.impactor.mass

    @property
    def speed(self) -> float:
        """Of approach, v1 - v2 [m/s]; of bodies in space that of the touching points along the normal."""
        if self.normal is not None:
            moving = (impulses.point_velocity(in_space(body)) for body in (self.impactor, self.target))
            return float(np.dot(self.normal, np.subtract(*moving)))
        if self.impactor.kind == "pulse":
            return self.impactor.velocity
        return self.impactor.velocity - self.target.velocity

    @property
    def reduced_mass(self) -> float:
        """m1 m2 / (m1 + m2) [kg]; that of the impactor alone if the target is held."""
        return self.impactor.mass if self.target.held else self.impactor.mass / (1.0 + 1.0 / self.mass_ratio)

    @property
    def initial_energy(self) -> float:
        """Kinetic energy of both bodies before the blow [J]."""
        if self.normal is not None:
            return float(sum(impulses.kinetic_energy(in_space(body)) for body in (self.impactor, self.target)))
        moving = [body for body in (self.impactor, self.target) if body.velocity and body.kind != "pulse"]
        return 0.5 * sum(body.mass * body.velocity**2 for body in moving)

    @property
    def blow(self) -> float:
        """m / Z of a compact body on a rod [s]: in this time a wave brings it to rest; of one on a beam its
        `halting_time`; infinite for any other pair.
        """
        bodies = (self.impactor, self.target)
        for body, other in (bodies, bodies[::-1]):
            if body.kind == "beam" and other.kind in ("mass", "sphere"):
                return body.halting_time(other.mass)
        rings = [body for body in bodies if body.round_trip_time is not None]
        compact = [body for body in bodies if body.time_unit is None]
        return compact[0].mass / rings[0].impedance if rings and compact else math.inf

    @property
    def time_unit(self) -> float:
        """Round trip T of a wave in the target [s], for a beam its slowest period, or else the same of the impactor;
        where nothing rings, about a contact time.
        """
        for body in (self.target, self.impactor):
            if body.time_unit is not None:
                return body.time_unit
        if self.target.kind == "spring-mass":
            return math.pi / self.target.frequency
        return contact_time(self.contact, self.reduced_mass, self.speed)


METHOD_KEYS = (
    "name",
    "modes",
    "elements",
    "steps",
    "step",
    "tolerance",
    "restitution",
    "variant",
    "scheme",
    "status",
    "boundary",
    "contact_stiffness",
    "model",
    "smoothing",
    "frame",
    "residual",
    "quantity",
    "budget",
    "among",
    "duration",
)


def _on_rod(pulse: Any, target: Any, contact: object) -> Any:
    """A prescribed force, which needs a rod to act on and no contact."""
    if target.kind not in ("rod", "rods"):
        raise SceneError("target.kind", target.kind, "'rod' or 'rods': a pulse acts on the end of a rod")
    if contact is not None and contact != {"law": "rigid"}:
        raise SceneError("contact", contact, "nothing: a pulse is a force, whatever the contact")
    return pulse.on(target.impedance)


def _check_approach(impactor: Any, target: Any) -> None:
    """The bodies must come closer."""
    if impactor.velocity - target.velocity < SPEED_RANGE[0]:
        allowed = f"less than the impactor's {impactor.velocity:g} m/s: the bodies must approach each other"
        raise SceneError("target.velocity", target.velocity, allowed)


def _check_masses(impactor: Any, target: Any) -> None:
    """Each body must feel the other."""
    ratio = target.mass / impactor.mass
    if not 1.0 / LARGEST_MASS_RATIO <= ratio <= LARGEST_MASS_RATIO and ratio != math.inf:
        low, high = target.mass / LARGEST_MASS_RATIO, target.mass * LARGEST_MASS_RATIO
        allowed = f"{low:.3g} to {high:.3g} kg for this target: one then does not feel the other"
        raise SceneError("impactor.mass", impactor.mass, allowed)


def _read_normal(impactor: Any, target: Any, contact: object) -> tuple[float, float, float] | None:
    """The normal of bodies in space, which meet each other or a stop only; None on an axis."""
    if not isinstance(impactor, Body) and not isinstance(target, Body):
        return None
    if not isinstance(impactor, Body):
        raise SceneError("impactor.kind", impactor.kind, "'body': a body in space is struck by one")
    if target.kind not in ("body", "stop"):
        raise SceneError("target.kind", target.kind, "'body' or 'stop': what a body in space can strike")
    contact = checks.table("contact", {} if contact is None else contact, ("law", "normal"))
    needed = "three numbers: the direction from the impactor to the target where they touch"
    normal = read_normal("contact.normal", checks.required("contact", contact, "normal", needed))
    check_struck("impactor", impactor, normal)
    check_struck("target", target, normal)
    return normal


def _read_law(key: str, given: object, impactor: Any, target: Any, spatial: bool = False) -> Any:
    """The contact law of two bodies from a table with the key law; bodies in space meet in one impulse."""
    if not isinstance(given, Mapping):
        raise SceneError(key, given, "a table with the key law")
    law = LAWS[checks.choice(f"{key}.law", given.get("law", "rigid"), ("rigid",) if spatial else LAWS)]
    checks.table(key, given, ("law", *law.KEYS, *(("normal",) if spatial else ())))
    try:
        return law.read(given, impactor, target)
    except SceneError as refused:  # laws name their keys as those of the impactor's contact
        name = refused.key.removeprefix("contact.")
        raise refused if name == refused.key else SceneError(f"{key}.{name}", refused.value, refused.allowed) from None


def _read_joint_laws(impactor: Any, target: Any) -> tuple[Any, ...]:
    """Of a chain; where a law's constants depend on the speed of approach, that of the blow stands for the joint's."""
    if not isinstance(target, Rods):
        return ()
    coming = [replace(rod, velocity=impactor.velocity) for rod in target.rods]
    pairs = zip(target.joints, coming[:-1], target.rods[1:], strict=True)
    return tuple(
        None if joint.bonded else _read_law(f"target.rods[{number}].contact", joint.contact or {}, front, behind)
        for number, (joint, front, behind) in enumerate(pairs, 2)
    )


@lru_cache(maxsize=256)  # the unit of time of a scene is asked for often
def contact_time(law: Any, mass: float, speed: float) -> float:
    """About how long two compact bodies of this reduced mass [kg] touch [s]: half a swing on the secant stiffness."""
    if law.NAME == "rigid":
        return 1e-3  # a blow of no duration at all: something to draw it on
    depth = speed * 1e-4
    for _ in range(200):
        stiffness = law.force(depth, 0.0, 0.0) / depth
        depth = math.sqrt(depth * speed * math.sqrt(mass / stiffness))
    return math.pi * math.sqrt(mass / stiffness)


def steepest_stiffness(law: Any, mass: float, speed: float) -> float:
    """Largest stiffness of the law [N/m] that a blow of this reduced mass [kg] can reach: it stores all its energy."""
    energy = 0.5 * mass * speed**2
    depth = 1e-3 * speed * contact_time(law, mass, speed)
    for _ in range(300):
        if law.stored(depth, depth) >= energy:
            break
        depth *= 1.25
    return max(float(law.slopes(part * depth, 0.0, 0.0)[0]) for part in np.linspace(1e-3, 1.0, 200).tolist())


def _copied(tables: Mapping[str, object]) -> dict[str, Any]:
    return {key: _copied(value) if isinstance(value, Mapping) else value for key, value in tables.items()}


def _named(error: BaseException) -> str:
    return (str(error).splitlines() or [""])[0][:120] or "nested too deeply"


SCENES = Path(__file__).parent / "scenes"


def scene_names() -> list[str]:
    """Names of the scenes that come with the library: the first to start with, the thesis's figures and tables last."""
    return sorted((path.stem for path in SCENES.glob("*.toml")), key=_rank)


def _rank(name: str) -> tuple[object, ...]:
    figure = re.fullmatch(r"(figure|table)-(\d+)\.(\d+)", name)
    if figure is None:
        return name != "fixed-rod", 0, "", 0, name
    return True, int(figure[2]), figure[1], int(figure[3]), name


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
            plain = [name for name in scene_names() if "." not in name][:12]
            allowed = (
                f"a scene file, or a built-in one: {', '.join(plain)} ..., figure-4.13 ...; impact scenes lists all"
            )
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
