"""Pictures of the gallery: those that are stored are made of today's solutions, small, and within their frame."""

import gzip
import json

import numpy as np
import pytest

from app.lessons.shipped import lesson_names, shipped_lesson
from app.messages.gallery.cards import CARDS, SCENES_SHOWN, TAUGHT, stored_pictures
from app.messages.gallery.drawn import FRAMES, HEIGHT, SHADES, WIDTH
from app.messages.gallery.pictures import picture_of
from app.text.catalogues import page
from solvers.text.catalogue import SOURCE

STORED = stored_pictures()
SLACK = 2  # units, by which other processors may round otherwise


def unpacked(part: dict, name: str) -> np.ndarray:
    """(frames, points)"""
    points = part["points"] - (name == "values")
    return np.cumsum(np.array(part[name]).reshape(-1, points), axis=0)


@pytest.mark.parametrize("name", (*SCENES_SHOWN, *TAUGHT))
def test_a_stored_picture_is_of_todays_solution(name):
    """Else: python -m bench.pictures"""
    made = picture_of(name)
    assert [each["shape"] for each in made] == [each["shape"] for each in STORED[name]]
    for now, then in zip(made, STORED[name], strict=True):
        for key in {"x", "y", "values"} & now.keys():
            assert len(now[key]) == len(then[key])
            assert np.abs(unpacked(now, key) - unpacked(then, key)).max() <= SLACK, key


@pytest.mark.parametrize("name", (*SCENES_SHOWN, *TAUGHT))
def test_a_picture_is_small_and_moves_within_its_frame(name):
    parts = STORED[name]
    assert len(gzip.compress(json.dumps(parts, separators=(",", ":")).encode())) < 4_000
    frames = {len(unpacked(part, "x")) for part in parts} | {len(unpacked(part, "y")) for part in parts}
    assert frames <= {1, FRAMES} and FRAMES in frames
    for part in parts:
        if "values" in part:
            assert 0 < np.abs(unpacked(part, "values")).max() <= SHADES
    x, y = unpacked(parts[0], "x"), unpacked(parts[0], "y")
    still = slice(int(0.3 * FRAMES), int(0.6 * FRAMES))  # what leaves the picture has been in it
    assert ((x[still] >= 0) & (x[still] <= WIDTH)).all() and ((y[still] >= 0) & (y[still] <= HEIGHT)).all()


def test_pictures_are_of_the_cards_and_each_asks_a_question():
    assert list(STORED) == [*SCENES_SHOWN, *TAUGHT]
    texts = page(SOURCE).texts
    assert {f"opening.of.{name}" for name in SCENES_SHOWN} == {code for code in texts if code.startswith("opening.of.")}
    assert {f"gallery.group.{group}" for group in CARDS} == {
        code for code in texts if code.startswith("gallery.group.")
    }


def test_each_lesson_has_a_picture():
    assert {shipped_lesson(name).scene for name in lesson_names()} <= STORED.keys()


def test_a_front_runs_along_the_fixed_rod():
    """A round trip after the first touch it has come back."""
    rod = STORED["fixed-rod"][0]
    values = unpacked(rod, "values")
    touched = int(np.argmax(values[:, 0] != 0))
    reached = int(np.argmax(values[:, -1] != 0))
    assert 0 < touched < reached and (values[:touched] == 0).all()
    assert abs(values[reached + 1, -1]) > 1.5 * abs(values[reached - 1, 0])  # doubled at the fixed end
