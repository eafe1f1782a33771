"""Sliders look alike in Chromium and in Firefox, whose parts have names of their own."""

import re
from pathlib import Path

STATIC = Path(__file__).parents[2] / "app" / "static"
PARTS = {"webkit-slider-runnable-track": "moz-range-track", "webkit-slider-thumb": "moz-range-thumb"}
RULE = re.compile(r"([^{}]*)::-([\w-]+)\s*\{([^{}]*)\}")
SEEN = ("background", "border", "border-color", "border-radius")


def test_what_is_seen_of_a_slider_is_said_to_both():
    found: dict[str, dict] = {name: {} for each in PARTS.items() for name in each}
    for sheet in STATIC.glob("*/*.css"):
        for selector, part, body in RULE.findall(sheet.read_text("utf-8")):
            said = [line.partition(":") for line in body.split(";")]
            rule = {name.strip(): value.strip() for name, _, value in said if name.strip() in SEEN}
            found[part][sheet.name, selector.strip()] = rule
    for there, here in PARTS.items():
        assert found[there] == found[here] and found[here], here
