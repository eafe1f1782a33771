"""Scenes that the gallery shows as pictures, by what happens in them; their questions are texts, `opening.of`."""

import json
from pathlib import Path
from typing import Any

CARDS = {
    "rods": ("fixed-rod", "free-rod", "two-equal-rods", "rod-with-gap"),
    "balls": ("two-balls", "newtons-cradle", "bouncing-ball", "sphere-on-half-space"),
    "beams": ("timoshenko-1913-long", "hammer-on-cantilever", "xylophone-bar", "xylophone-bar-node"),
    "pendulums": ("rigid-pendulum", "compound-pendulum", "double-pendulum", "trip-hammer"),
    "mechanisms": ("four-bar-moves", "bouncing-on-piston", "slider-crank", "rotating-bar"),
    "space": ("brick-on-floor", "spinning-ball", "percussion-rod", "painleve-rod"),
    "measured": ("split-hopkinson", "pressure-bar", "drop-test", "bronze-rod-steel-ball"),
}
TAUGHT = ("stiff-contact", "figure-9.4")  # which lessons begin with, but no card shows
SCENES_SHOWN = tuple(scene for scenes in CARDS.values() for scene in scenes)
STORED = Path(__file__).parent / "pictures.json"  # which `python -m bench.pictures` makes of today's solutions


def stored_pictures() -> dict[str, Any]:
    """Their pictures by scene, as `app.messages.gallery.drawn` has them."""
    return json.loads(STORED.read_text(encoding="utf-8"))
