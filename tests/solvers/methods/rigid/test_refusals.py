"""What scenes of bodies in space are refused, and what is just allowed."""

import copy
import math

import numpy as np
import pytest

import solvers
from solvers import Body, Scene, SceneError
from tests.solvers.methods.rigid.scenes import BODIES, NOTE, STRUCK, with_value
from tests.solvers.numerics.rigid.test_impulses import in_world, rotations

TILTED = [[0.24, 0.1, 0.0], [0.0, 0.24, 0.0], [0.0, 0.0, 0.24]]


@pytest.mark.parametrize(
    "key, value, named, allowed",
    [
        ("contact.normal", [0.0, 0.0, 0.0], "contact.normal", "not all zero"),
        ("contact.normal", [1.0, 0.0], "contact.normal", "three numbers"),
        ("contact.normal", 1.0, "contact.normal", "three numbers"),
        ("contact.normal", "x", "contact.normal", "three numbers"),
        ("contact.normal", [1.0, math.nan, 0.0], "contact.normal[2]", "a number from"),
        ("contact.normal", [1.0, True, 0.0], "contact.normal[2]", "a number from"),
        ("contact.law", "hertz", "contact.law", "'rigid'"),
        ("contact.friction", -0.1, "contact.friction", "0 to 1e+06"),
        ("contact.friction", math.nan, "contact.friction", "0 to 1e+06"),
        ("contact.friction", "rough", "contact.friction", "0 to 1e+06"),
        ("contact.roughness", 0.3, "contact.roughness", "law, normal, friction"),
        ("method.model", "kane", "method.model", "'stronge', 'poisson', 'newton'"),
        ("contact", {}, "contact.normal", "the key is missing"),
        ("contact", "rigid", "contact", "a table"),
        ("impactor.velocity", 3.0, "impactor.velocity", "three numbers"),
        ("impactor.velocity", [3.0, 0.0, 0.0, 0.0], "impactor.velocity", "three numbers"),
        ("impactor.velocity", [3.0, math.inf, 0.0], "impactor.velocity[2]", "m/s"),
        ("impactor.mass", 0.0, "impactor.mass", "kg"),
        ("impactor.mass", math.inf, "impactor.mass", "kg"),
        ("impactor.mass", 1e-10, "impactor.mass", "does not feel"),
        ("impactor.radius", 0.1, "impactor.radius", "no such key"),
        ("impactor.kind", "mass", "impactor.velocity", "a number"),
        ("target.spin", [0.0, 0.0, "fast"], "target.spin[3]", "rad/s"),
        ("target.spin", None, "target.spin", "three numbers"),
        ("target.centre", [10**400, 0, 0], "target.centre[1]", "m"),
        ("target.inertia", -1.0, "target.inertia", "three principal moments"),
        ("target.inertia", [1.0, 1.0], "target.inertia", "three principal moments"),
        ("target.inertia", [-0.1, 0.2, 0.2], "target.inertia", "not negative"),
        ("target.inertia", [-0.1, -0.1, -0.1], "target.inertia", "not negative"),
        ("target.inertia", [0.0, 0.0, 0.24], "target.inertia", "(here 0, 0 and 0.24) exceeds the sum"),
        ("target.inertia", [0.1, 0.1, 0.201], "target.inertia", "exceeds the sum"),
        ("impactor.inertia", [[0.2, 0.1, 0.0], [0.1, 0.2, 0.0], [0.0, 0.0, 0.01]], "impactor.inertia", "exceeds"),
        ("target.inertia", [0.24, math.nan, 0.24], "target.inertia[2]", "kg m2"),
        ("target.inertia", TILTED, "target.inertia", "symmetric"),
        ("target.inertia", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 1.0], "target.inertia[3]", "three numbers"),
        ("target.inertia", [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]], "target.inertia[1]", "three numbers"),
        ("target.axes", [1.0, 0.0, 0.0], "target.axes[1]", "three numbers"),
        ("target.axes", [[1.0, 0.0, 0.0]] * 3, "target.axes", "right angles"),
        ("target.axes", [[1, 0, 0], [0, 0, 0], [0, 0, 1]], "target.axes[2]", "not all zero"),
        ("target.centre", [0.0, -0.6, 0.01], "target.inertia", "struck across"),
        ("target.kind", "rod", "target.mass", "no such key"),
        ("method.name", "waves", "method.name", "use 'rigid'"),
        ("method.restitution", 1.1, "method.restitution", "0 to 1"),
        ("method.restitution", -0.1, "method.restitution", "0 to 1"),
        ("method.restitution", math.nan, "method.restitution", "0 to 1"),
        ("method.modes", 3, "method.modes", "restitution"),
    ],
)
def test_refusals(key, value, named, allowed):
    with pytest.raises(SceneError) as refused:
        solvers.solve(Scene.from_table(with_value(key, value)))
    assert refused.value.key == named
    assert allowed in refused.value.allowed
    assert len(str(refused.value)) < 400 and "\n" not in str(refused.value)


def test_axes_belong_to_principal_moments():
    tables = with_value("target.inertia", np.diag([0.3, 0.4, 0.5]).tolist())
    tables["target"]["axes"] = np.eye(3).tolist()
    with pytest.raises(SceneError) as refused:
        Scene.from_table(tables)
    assert refused.value.key == "target.axes"


@pytest.mark.parametrize(
    "impactor, target, key",
    [
        (NOTE["impactor"], STRUCK["mass"], "target.kind"),
        (NOTE["impactor"], {"kind": "half-space", "material": "steel"}, "target.kind"),
        (BODIES["sphere"], NOTE["target"], "impactor.kind"),
    ],
)
def test_bodies_in_space_meet_their_like_or_a_stop(impactor, target, key):
    with pytest.raises(SceneError) as refused:
        Scene.from_table({"impactor": impactor, "target": target, "contact": NOTE["contact"]})
    assert refused.value.key == key


@pytest.mark.parametrize("name", ["mass", "velocity"])
def test_missing_keys(name):
    tables = copy.deepcopy(NOTE)
    del tables["impactor"][name]
    with pytest.raises(SceneError, match="the key is missing") as refused:
        Scene.from_table(tables)
    assert refused.value.key == f"impactor.{name}"


def test_a_plate_in_four_digits_is_a_body():
    """Its moments reach the triangle inequality; so do those of a thin rod, in any axes."""
    plate = Scene.from_table(with_value("target.inertia", [0.3333, 0.3333, 0.6667]))
    assert plate.target == Body(
        2.0, (0.0, 0.0, 0.0), ((0.3333, 0.0, 0.0), (0.0, 0.3333, 0.0), (0.0, 0.0, 0.6667)), (0.0, -0.6, 0.0)
    )
    assert solvers.solve(plate).notes == []
    axes = rotations(np.random.default_rng(5), 20)
    for rod in in_world(np.array([0.0, 0.24, 0.24]), axes):
        Scene.from_table(with_value("target", NOTE["target"] | {"inertia": rod.tolist(), "centre": [0.0, 0.0, 0.0]}))
