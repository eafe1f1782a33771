"""What is kept of every scene sees a change of a number, a word, a note or an array."""

import copy

import pytest

from app.choices.choices import SCENES

from . import golden

NAME = "fixed-rod"


@pytest.fixture(scope="module")
def shown():
    return golden.shown(NAME)


def test_every_scene_is_kept_and_those_that_are_sensitive_are_some():
    assert golden.kept().keys() == set(SCENES) > golden.SENSITIVE
    assert len(golden.SENSITIVE) < len(SCENES) / 8


CHANGES = {
    ".exact.peakForce": lambda now: now["header"]["exact"].update(peakForce=78277.0),
    ".exact.name": lambda now: now["header"]["exact"].update(name="modal"),
    ".exact.notes": lambda now: now["header"]["exact"]["notes"].clear(),
    ".exact.energy.weight": lambda now: now["header"]["exact"]["energy"].update(weight=0.1),
    "f0": lambda now: now["arrays"]["f0"].__setitem__(2, 1.001 * now["arrays"]["f0"][2]),
    "exactMass": lambda now: now["arrays"].pop("exactMass"),
    "exactEnd": lambda now: now["arrays"]["exactEnd"].__setitem__(0, [3, 3]),
}


@pytest.mark.parametrize("where", CHANGES)
def test_a_change_is_seen(shown, where):
    now = copy.deepcopy(shown)
    assert golden.differences(NAME, now) == []
    CHANGES[where](now)
    (found,) = golden.differences(NAME, now)
    assert found.startswith(where)


def test_of_a_sensitive_scene_keys_and_words_are_seen():
    now = golden.shown("bent-rods")
    now["header"]["duration"] *= 2.0
    assert golden.differences("bent-rods", now) == []
    now["header"]["kind"] = "axial"
    now["arrays"]["another"] = [[1], 0.0, 0.0, 0.0, 0.0]
    assert len(golden.differences("bent-rods", now)) == 2
