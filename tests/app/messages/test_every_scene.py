"""Every scene as it is when it is chosen: drawn, packed and reported as it says; and by every method."""

import json

import numpy as np
import pytest

import solvers
from app.choices.choices import SCENES
from app.choices.scene_of import own_choices
from app.messages.encoding import read_header
from app.messages.schema import check
from app.messages.solve import solve_frame

from ... import golden
from .own import arrays, own_message

LARGEST = (
    98_000  # bytes of a message; 100 000 are allowed, as the digits of a number are more or fewer by the processor
)


def checked(message: bytes) -> dict:
    """The header of a message that is small, finite and packed as said."""
    assert len(message) <= LARGEST
    header, found = read_header(message), arrays(message)
    json.dumps(header, allow_nan=False)
    assert all(np.isfinite(values).all() for values in found.values())
    shapes = {key: values.shape for key, values in found.items()}
    check({key: value for key, value in header.items() if key != "arrays"}, shapes)
    return header


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_every_scene_is_drawn_and_reported_as_it_says(name):
    scene = solvers.load(name)
    solution = solvers.solve(scene)
    assert scene.note[:40] in str(solution)
    frame = checked(own_message(name))
    assert frame["note"] == scene.note
    assert golden.differences(name, golden.shown(name)) == []  # `python -m tests.golden` keeps what is meant
    if frame["kind"] == "axial" and solution.impactor_velocity is not None:
        columns = [column for column in (frame["exact"], frame["other"]) if column]
        assert all(each["travelling"] == (each["name"] == "waves") for each in columns)
        shown = next((c for c in columns if c["name"] == solution.method["name"]), columns[0])
        # the page gives modes a step of its own
        assert shown["final"] == pytest.approx(solution.impactor_velocity / scene.speed, abs=1e-4)


def kind(name: str) -> tuple:
    """What decides which parts a message has and which methods there are: not the values of a scene."""
    scene = SCENES[name]
    one, other, method = scene.impactor, scene.target, scene.method.get("name")
    return (
        *(one.kind, other.kind, scene.contact and scene.contact.NAME, bool(scene.friction)),
        *(getattr(other, about, None) for about in ("support", "theory", "joints")),
        method == "multibody",
    )


OF_EACH_KIND = {kind(name): name for name in reversed(list(SCENES))}.values()


@pytest.mark.slow
@pytest.mark.parametrize("name", OF_EACH_KIND)
def test_a_scene_of_every_kind_by_every_method_is_packed_as_said(name):
    refusals, own = read_header(own_message(name))["refusals"], own_choices(name)
    for method in (method for method, reason in refusals.items() if reason is None and method != own["method"]):
        assert checked(solve_frame(own | {"method": method}))["chosen"]["method"] == method
