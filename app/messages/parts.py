"""What the browser needs of the bodies themselves: what can be set, within which bounds, and what follows from it."""

import math
import re
from collections.abc import Collection
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from solvers import Bending, Body, Scene, SpringMass, Waveguide
from solvers.bodies import AnyBody, Pulse
from solvers.bodies.linkage.joints import Joint
from solvers.bodies.linkage.links import Link
from solvers.bodies.pendulum import Pivoted
from solvers.text.notes import Note

from ..choices.bodies import parts_of
from ..choices.choices import SCENES, strikes
from ..choices.opened import Opening
from ..choices.own import is_own
from ..choices.part import RANGES, Part
from ..choices.request import Request
from ..choices.space import equivalent_box
from .encoding import unshown

CLAIM = r"(?<!\d): "  # in a title, behind what the scene is about: what happens, as in app/static/form/settings.js
CHANGED = " (changed)"  # behind the title of a file


def common(scene: Scene, request: Request | None, notes: Collection[Note] = ()) -> dict[str, Any]:
    """What every message says of what is chosen, and of the scene; nothing is chosen outside the page.

    `notes`: of the solution, by which what can be tried follows.
    """
    return {
        "chosen": request and request.chosen,
        "own": request and request.own,
        "draft": bool(request and request.draft),
        "stretch": request and request.stretch,
        "acting": request.acting if request else [],
        "title": scene.title,
        "source": scene.source,
        "note": scene.note,
        **({"weight": scene.weight_acceleration} if scene.weight_acceleration else {}),
        "parts": part_records(request),
        "unshown": unshown(scene),
        "opens": (request.opening([note.code for note in notes]) if request else Opening()).table(),
    }


def taken_along(scene: Scene, request: Request | None) -> Scene:
    """The scene as it is written into a file: a changed one without what its scene says of itself, which held there."""
    if request is None or not request.changed:
        return scene
    about = re.split(CLAIM, scene.title)[0].removesuffix(CHANGED)
    return replace(scene, title=about and about + CHANGED, source="", note="")


def part_records(request: Request | None) -> list[dict[str, Any]]:
    """Every body, every rod of a chain, every link and joint of a mechanism, as in `records.RECORDS`."""
    if request is None:
        return []
    name = request.chosen["scene"]
    own, striker = _own_parts(name), "target" if strikes(name) else "impactor"
    return [_part_record(part, own[part.key], part.key == striker) for part in parts_of(request.scene)]


def _own_parts(name: str) -> dict[str, Part]:
    """Of a scene as it is in its file, by their keys."""
    return _parts_of(name) if is_own(name) else _built_in_parts(name)


def _parts_of(name: str) -> dict[str, Part]:
    return {part.key: part for part in parts_of(SCENES[name])}


_built_in_parts = lru_cache(maxsize=512)(_parts_of)


def _part_record(part: Part, own: Part, strikes: bool) -> dict[str, Any]:
    values = [
        {
            "quantity": quantity,
            "value": part.value(quantity),
            "own": own.value(quantity),
            "low": RANGES.get(quantity, (None, None))[0],
            "high": RANGES.get(quantity, (None, None))[1],
        }
        for quantity in own.quantities
    ]
    given = {value["quantity"] for value in values}
    follows = _derived_of_part(part.body) if part.name else _derived(part.body)
    derived = [[name, value] for name, value in follows if name not in given and math.isfinite(value)]
    kind = "link" if isinstance(part.body, Link) else part.body.kind
    return {"key": part.key, "name": part.name, "kind": kind, "strikes": strikes, "values": values, "derived": derived}


def _derived_of_part(part: Link | Joint) -> list[tuple[str, float]]:
    """The same of a link; of a joint nothing."""
    if isinstance(part, Joint):
        return []
    found = [("length", part.length), ("mass", part.mass)]
    if part.section is not None and part.section.second_moment is not None:
        found += [("area", part.section.area), ("second_moment", part.section.second_moment)]
    return found + ([("wave_speed", part.wave_speed)] if part.flexible else [])


def _derived(body: AnyBody) -> list[tuple[str, float]]:
    """What follows from its geometry and material, in SI units."""
    found = [("velocity", float(np.linalg.norm(body.velocity)))] if np.any(body.velocity) else []
    if isinstance(body, Pulse):
        return [("peak_force", max(body.forces)), ("duration", body.end)]
    if isinstance(body, Pivoted):
        found += [("mass", body.own_mass), ("felt_mass", body.mass), ("inertia", body.inertia)]
    else:
        found += [("mass", body.mass)]
    if isinstance(body, Waveguide):
        rods = body.rods
        if len(rods) == 1:
            wave_speed, impedance = rods[0].wave_speed, body.impedance
            found += [("area", body.area), ("wave_speed", wave_speed), ("impedance", impedance)]
        found += [("round_trip", body.round_trip_time)]
    elif isinstance(body, Bending):
        wave_speed = math.sqrt(body.material.young / body.material.density)
        found += [("area", body.section.area), ("second_moment", body.second_moment), ("wave_speed", wave_speed)]
        found += [("period", body.time_unit or math.inf)]
    elif isinstance(body, SpringMass):
        found += [("period", 2.0 * body.half_swing)]
    elif isinstance(body, Body) and not body.is_point:
        found += [("longest_side", float(max(equivalent_box(body)[0])))]
    return found
