"""The picker of scenes: what each is called, and under which heading it stands."""

import re
from collections.abc import Mapping
from typing import Any

from solvers import Mechanism, Scene

from ..choices.beam import on_beam
from ..choices.choices import SCENES
from ..choices.space import in_space
from ..text.catalogues import page
from ..text.typeset import typeset


def scene_groups(listed: Mapping[str, Scene] = SCENES) -> list[list[Any]]:
    """Scenes by heading, each as [name, what it is], for the picker."""
    groups: dict[str, list[list[str]]] = {}
    for name, scene in listed.items():
        groups.setdefault(_heading(name, scene), []).append([name, _entry(name, scene)])
    return [[heading, scenes] for heading, scenes in groups.items()]


def _entry(name: str, scene: Scene) -> str:
    """What the picker says of a scene; one of the thesis by its number first."""
    title = typeset(scene.title or name)
    found = re.fullmatch(r"(figure|table)-(\d+\.\d+)", name)
    return page().text("scenes.entry", kind=found[1], number=found[2], title=title) if found else title


def _heading(name: str, scene: Scene) -> str:
    if found := re.fullmatch(r"(figure|table)-(\d+)\..*", name):
        return page().text("scenes.thesis", chapter=found[2])
    if in_space(scene):
        return page().text("scenes.space")
    if isinstance(scene.target, Mechanism):
        return page().text("scenes.mechanisms")
    if on_beam(scene):
        return page().text("scenes.beams")
    if scene.impactor.rods or len(scene.target.rods) > 1:
        return page().text("scenes.several-rods")
    codes = {"rod": "scenes.one-rod", "beam": "scenes.beams"}
    return page().text(codes.get(scene.target.kind, "scenes.compact"))
