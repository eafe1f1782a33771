"""All scenes: what each is called, under which heading it stands, and which the gallery shows as pictures."""

import re
from collections.abc import Mapping
from typing import Any

from solvers import Mechanism, Scene
from solvers.text.catalogue import SOURCE
from solvers.text.notes import Note

from ..choices.beam import on_beam
from ..choices.choices import SCENES
from ..choices.space import in_space
from ..lessons.shipped import listed
from ..messages.gallery.cards import CARDS, stored_pictures
from ..messages.gallery.drawn import HEIGHT, SHADES, WIDTH
from ..text.refusals import note


def scene_groups(listed: Mapping[str, Scene] = SCENES) -> list[list[Any]]:
    """Scenes by heading, which is a note, each as [name, title], for lists."""
    groups: dict[Note, list[list[str]]] = {}
    for name, scene in listed.items():
        groups.setdefault(_heading(name, scene), []).append([name, scene.title or name])
    return [[heading.table(), scenes] for heading, scenes in groups.items()]


def gallery(language: str = SOURCE) -> dict[str, Any]:
    """What the browser makes the gallery of: cards by group, their pictures, all scenes by heading, each as
    [name, title, what else it is found by], and lessons in this language.
    """
    scenes = [
        [heading, [[name, title, _found_by(SCENES[name])] for name, title in listed]]
        for heading, listed in scene_groups()
    ]
    sheet = {"width": WIDTH, "height": HEIGHT, "shades": SHADES}
    cards = [[group, list(names)] for group, names in CARDS.items()]
    pictures = stored_pictures()
    return {"cards": cards, "sheet": sheet, "pictures": pictures, "scenes": scenes, "lessons": lessons(language)}


def lessons(language: str) -> list[dict[str, Any]]:
    """As the gallery lists them, in this language if there is a translation; `before`: the title until the first
    answer, `audience`: for whom it is."""
    return [
        {
            "name": lesson.lesson, "scene": lesson.scene, "steps": len(lesson.steps), "minutes": lesson.minutes,
            "language": lesson.language, "title": lesson.title, "before": lesson.title_before,
            "audience": lesson.audience,
        }
        for lesson in listed(language)
    ]  # fmt: skip


def _found_by(scene: Scene) -> dict[str, Any]:
    return {
        "method": scene.method.get("name", ""),
        "law": scene.contact.NAME,
        "bodies": [scene.impactor.kind, scene.target.kind],
    }


def _heading(name: str, scene: Scene) -> Note:
    if found := re.fullmatch(r"(figure|table)-(\d+)\..*", name):
        return note("scenes.thesis", chapter=found[2])
    if in_space(scene):
        return note("scenes.space")
    if isinstance(scene.target, Mechanism):
        return note("scenes.mechanisms")
    if on_beam(scene):
        return note("scenes.beams")
    if scene.impactor.rods or len(scene.target.rods) > 1:
        return note("scenes.several-rods")
    codes = {"rod": "scenes.one-rod", "beam": "scenes.beams"}
    return note(codes.get(scene.target.kind, "scenes.compact"))
