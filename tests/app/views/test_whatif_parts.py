"""A question in parts has the answer that it has as a whole."""

import json

import pytest

from app.choices.scene_of import own_choices
from app.views import whatif
from app.views.whatif import POINTS, whatif_data
from app.views.whatif_parts import Parts
from tests.app.sentences import sentence

from ...patience import SECONDS

ROWS = [[0.5], [1.0], [1e9], [2.0], [1e9], [3.0]]  # of which two cannot be


@pytest.fixture(autouse=True)
def time_for_all(monkeypatch):
    monkeypatch.setattr(whatif, "SECONDS", SECONDS)


def asked(scene="fixed-rod", **more):
    return own_choices(scene) | {POINTS: json.dumps({"id": 4, "names": ["mass_ratio"], "rows": ROWS} | more)}


def in_parts(question, *starts):
    parts = Parts(question)
    spans = zip(starts, [*starts[1:], len(parts.rows)], strict=True)
    return json.loads(parts.joined(json.loads(whatif_data(json.loads(parts.part(*span)))) for span in spans))


@pytest.mark.parametrize("starts", [(0,), (0, 1, 2, 3, 4, 5), (0, 3), (0, 2, 5)])
@pytest.mark.parametrize("more", [{}, {"set": {"speed": 2.0, "modes": 3}}, {"stress": True}])
def test_parts_say_what_the_whole_does(starts, more):
    whole = json.loads(whatif_data(asked(**more)))
    found = in_parts(asked(**more), *starts)
    assert found == whole and list(found["why"]) == ["2", "4"] and sentence(found["why"]["4"])


def test_parts_of_models_name_them_once():
    question = asked("xylophone-bar", models={"figure": "peak_force", "bounds": [0.1, 0.01]})
    assert in_parts(question, 0, 3) == json.loads(whatif_data(question))


def test_of_a_stranger_s_question_only_what_is_known_goes_on():
    question = asked() | {POINTS: asked()[POINTS][:-1] + ', "more": "__import__", "file": false}'}
    assert "__import__" not in Parts(question).part(0, 6)
    with pytest.raises(ValueError):
        Parts(asked(names=["__import__"]))
    assert not Parts(asked(file=True)).divides
