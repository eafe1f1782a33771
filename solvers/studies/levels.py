"""What a study of convergence varies: modes, elements, the step of balances or their restitution, and the levels."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

from .. import validation
from ..bodies import Mechanism
from ..bodies.linkage.links import Link
from ..methods import METHODS
from ..methods.base import Method, SceneNotSupported
from ..scene import Scene
from ..solve import read_method
from ..validation import SceneError, allowed

COUNTS = (3, 5, 10, 20, 40, 80)
RESTITUTIONS = (1.0, 0.7, 0.3, 0.0)
STEPS = (1.0, 0.5, 0.2, 0.1)  # of the method's own
FEWEST, MOST = 3, 12  # levels
COUNTED = ("elements", "modes")
VALUES = ("step", "restitution")  # what else can be varied, where the method has it
USUAL, BY_ELEMENTS = "modal", "fe-nodal"  # methods where neither the caller nor the scene says
GIVEN = {"elements": "elements", "step": "steps", "restitution": "restitutions"}  # by kind: what the study is given


@dataclass(frozen=True)
class Levels:
    """The same impact at several levels, from coarse to fine, or from restitution 1 to 0."""

    method: Method
    kind: str  # of COUNTED or VALUES
    values: list[float]  # by level
    each: list[tuple[Method, Scene]]  # by level
    duration: float | None  # [s], where the scene says it


def kinds_of(scene: Scene, method: Method) -> list[str]:
    """What can be varied, the number of modes or of elements first."""
    options = {option.name for option in fields(method)}
    alone = scene.impactor.own_modes and not isinstance(scene.impactor, Mechanism) and scene.target.time_unit is None
    if alone or any(link.flexible for link in _links(scene)):  # of whose modes alone it depends how well they are known
        found = ["modes"]
    elif COUNTED[0] in options and (getattr(method, COUNTED[0]) or not getattr(method, COUNTED[1], None)):
        found = [COUNTED[0]]
    else:
        found = [name for name in COUNTED[1:] if name in options]
    return found + [name for name in VALUES if getattr(method, name, None) is not None]


def levels_of(
    scene: Scene,
    given: str | Method | None,
    counts: Sequence[int] | None,
    values: Mapping[str, Sequence[float] | None],
) -> Levels:
    """The levels of `counts`, or of the values of one kind, elements among them. Raises SceneError."""
    chosen, duration = _method(scene, given, values["elements"] is not None)
    known = kinds_of(scene, chosen)
    kinds = [name for name, each in values.items() if each is not None]
    if len(kinds) > 1 or (kinds and counts is not None):
        raise SceneError(GIVEN[kinds[-1]], values[kinds[-1]], allowed("one-varied"))
    kind = kinds[0] if kinds else next((name for name in known if name in COUNTED), None)
    if kind is None:
        resolved = [name for name, method in METHODS.items() if set(COUNTED) & {f.name for f in fields(method)}]
        raise SceneError("method.name", chosen.NAME, allowed("resolved-method", names=resolved))
    if kind not in known:
        raise SceneError(GIVEN[kind], values[kind], allowed("varied", method=chosen.NAME, names=known))
    refused = chosen.refusal(scene)
    if refused:
        raise SceneNotSupported("method.name", chosen.NAME, refused)
    if kind in VALUES:
        falling = _falling(kind, values[kind])
        return Levels(chosen, kind, falling, [(_with(chosen, kind, value), scene) for value in falling], duration)
    if getattr(chosen, kind, 1) is None:  # some, where it is left out, do without
        chosen = replace(chosen, **{kind: 1})
    name, asked = ("modes", counts) if values["elements"] is None else ("elements", values["elements"])
    numbers, each = _counted(scene, chosen, kind, _counts(name, COUNTS if asked is None else asked))
    return Levels(chosen, kind, numbers, each, duration)


def _counts(name: str, given: Sequence[Any]) -> list[int]:
    if isinstance(given, (str, bytes)) or not FEWEST <= len(given) <= MOST:
        raise SceneError(name, given, allowed("list", low=FEWEST, high=MOST, of="whole"))
    counts = [validation.whole_number(name, count, 1, 10_000) for count in given]
    if counts != sorted(set(counts)):
        raise SceneError(name, counts, allowed("rising"))
    return counts


def _falling(kind: str, given: Sequence[float] | None) -> list[float]:
    name = GIVEN[kind]
    if given is None or isinstance(given, (str, bytes)) or not FEWEST <= len(given) <= MOST:
        raise SceneError(name, given, allowed("list", low=FEWEST, high=MOST, of="numbers"))
    values = [validation.number(name, value, -math.inf, math.inf) for value in given]
    if values != sorted(set(values), reverse=True):
        raise SceneError(name, values, allowed("falling"))
    return values


def _with(method: Method, kind: str, value: float) -> Method:
    """The method with one option as its scene file could give it."""
    written = {name: each for name, each in method.table().items() if name != "name" and each is not None}
    return type(method).read(written | {kind: value}).without_estimate()


def _method(scene: Scene, given: str | Method | None, by_elements: bool) -> tuple[Method, float | None]:
    """The method without its estimate of the error, and the duration."""
    named, duration = read_method(scene.method, scene)
    if given is None:
        own = by_elements and COUNTED[0] in kinds_of(scene, named)
        given = named if own else BY_ELEMENTS if by_elements else USUAL
    if isinstance(given, Method):
        chosen = given
    elif given == named.NAME:
        chosen = named
    else:
        chosen = METHODS[validation.choice("method.name", given, METHODS)].read({})
    return chosen.without_estimate(), duration


def _links(scene: Scene) -> list[Link]:
    return [link for body in (scene.impactor, scene.target) if isinstance(body, Mechanism) for link in body.links]


def _counted(
    scene: Scene, method: Method, kind: str, counts: list[int]
) -> tuple[list[float], list[tuple[Method, Scene]]]:
    """Method and scene by each of the counts, as far as links of finite elements have so many modes."""
    found: dict[int, tuple[Method, Scene]] = {}
    has = any(option.name == kind for option in fields(method))
    for count in counts:
        options: dict[str, Any] = {kind: count} if has else {}
        level, finer = replace(method, **options), scene
        bodies = {"impactor": scene.impactor.with_own_modes(count), "target": scene.target.with_own_modes(count)}
        if kind == "modes" and any(body is not getattr(scene, name) for name, body in bodies.items()):
            finer = replace(scene, **bodies, given={})
        if all(link.modes in (0, count) for link in _links(finer)):
            found[count] = level, finer
    if len(found) < FEWEST:
        raise SceneError("modes", counts, allowed("fewer-modes", low=FEWEST))
    return list(found), list(found.values())
