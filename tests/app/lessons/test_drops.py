"""A lesson about a drop: the picture that its scene opens with, events from the release on, and a height."""

import math
from pathlib import Path

import pytest

from app.lessons.checking import check

DROP = """\
---
lesson: tried
version: 1
language: en
title: Tried
scene: {scene}
---
## It falls
:::{{scene}}
show = [{show}]
sliders = ["drop_height"]
play = [{first}, "touch-2"]
:::
Now.
"""
FALL = math.sqrt(2.0 * 0.5 / 9.80665)  # [s] from half a metre


def problems(folder: Path, scene: str = "drop-test", show: str = '"opening"', first: float = 0.0) -> list[str]:
    file = folder / "tried.md"
    file.write_text(DROP.format(scene=scene, show=show, first=first), encoding="utf-8")
    return [each.said() for each in check(file).problems]


def test_times_are_those_of_all_bounces_in_seconds(tmp_path):
    assert problems(tmp_path) == []
    assert problems(tmp_path, first=2.0 * FALL) == []  # the second one comes later, as most of the speed is left
    assert len(problems(tmp_path, first=3.0 * FALL)) == 1  # and before a whole bounce as high as the fall is over


def test_the_single_contact_of_a_drop_has_no_second_one(tmp_path):
    (found,) = problems(tmp_path, show='"bodies", "rows"')
    assert "touch-2" in found


@pytest.mark.parametrize("scene", ["two-balls", "fixed-rod", "hammer-on-cantilever"])
def test_what_is_not_dropped_has_neither_picture_nor_height(tmp_path, scene):
    found = " ".join(problems(tmp_path, scene))
    assert "opening" in found and "drop_height" in found
