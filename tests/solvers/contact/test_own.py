"""A law from outside of the library: it is solved where it is whole, and else one sentence says what is missing."""

import math
from typing import NamedTuple

import numba
import pytest

import solvers
from solvers import Scene, SceneError
from solvers.contact import own
from solvers.contact.constants import read_stiffness
from solvers.numerics.law_functions import CONSTANTS
from tests.solvers.plain_scene import PLAIN


def _read(cls, given, impactor, target):
    return cls(read_stiffness(given, "N/m"))


SPRING = {  # the members of a law
    "NAME": "spring",
    "EXPONENT": 1.0,
    "VARIED": {},
    "KEYS": ("stiffness",),
    "LOSSY": False,
    "PLASTIC": False,
    "JUMPS": False,
    "read": classmethod(_read),
    "table": lambda self, speed: {"stiffness": self.stiffness},
    "limits": lambda self, deepest, impactor, target: [],
    "scaled": lambda self, length, speed, force: type(self)(self.stiffness * length / force),
    "force": lambda self, indentation, rate, deepest: self.stiffness * max(indentation, 0.0),
    "slopes": lambda self, indentation, rate, deepest: (self.stiffness if indentation > 0.0 else 0.0, 0.0),
    "stored": lambda self, indentation, deepest: 0.5 * self.stiffness * max(indentation, 0.0) ** 2,
    "dent": lambda self, deepest: 0.0,
    "corner": lambda self, indentation, deepest: math.inf,
    "mean": lambda self, start, end, rate, deepest: (0.5 * self.stiffness * (max(start, 0.0) + max(end, 0.0)), 0.0),
    "unloading": lambda self, deepest: (0.0, 0.0),
    "mean_force": solvers.contact.Power.mean_force,
}


class Spring(NamedTuple):
    stiffness: float


class Stiff(NamedTuple):  # without the constant that all have
    hardness: float


def law(base=Spring, without=(), **others):
    members = {name: value for name, value in (SPRING | others).items() if name not in without}
    return type("Own", (base,), {"__slots__": (), "__module__": __name__} | members)


def refusal(kind, monkeypatch):
    monkeypatch.setitem(solvers.LAWS, "spring", kind)
    with pytest.raises(SceneError) as refused:
        solvers.solve(Scene.from_table(PLAIN | {"contact": {"law": "spring", "stiffness": 1e8}}), "waves")
    assert refused.value.key == "contact.law" and "\n" not in str(refused.value) and len(str(refused.value)) < 300
    assert "Own" in str(refused.value)
    return refused.value.reason


def test_one_that_is_whole_is_taken(monkeypatch):
    kind = law()
    monkeypatch.setitem(solvers.LAWS, "spring", kind)
    scene = Scene.from_table(PLAIN | {"contact": {"law": "spring", "stiffness": 1e8}})
    known = scene.replace({"contact.law": "linear"})
    assert solvers.solve(scene, "waves").impulse == pytest.approx(solvers.solve(known, "waves").impulse, rel=1e-9)


@pytest.mark.parametrize("name", SPRING)
def test_one_that_forgets_a_member_is_told_which(name, monkeypatch):
    reason = refusal(law(without=[name]), monkeypatch)
    assert reason.code == "allowed.law-members" and reason.values["missing"] == [name]


def test_all_that_is_missing_is_said_at_once(monkeypatch):
    assert refusal(law(without=["mean", "dent"]), monkeypatch).values["missing"] == ["dent", "mean"]
    assert refusal(law(LOSSY=True), monkeypatch).values["missing"] == list(own.DAMPED)
    assert refusal(law(PLASTIC=True), monkeypatch).values["missing"] == list(own.YIELDING)
    assert refusal(law(Stiff), monkeypatch).values["missing"] == ["stiffness"]


@pytest.mark.parametrize("name", own.ANSWERS)
@pytest.mark.parametrize("found", [None, (), (1.0,), (0.0,) * 5, "1", 1.0j, [0.0, 0.0]], ids=repr)
def test_one_that_returns_something_else_is_told_so(name, found, monkeypatch):
    reason = refusal(law(**{name: lambda self, *arguments: found}), monkeypatch)
    assert (reason.code, reason.values["name"]) == ("allowed.law-answer", name)
    assert reason.values["found"] == repr(found)


@pytest.mark.parametrize("name", own.ANSWERS)
def test_one_that_takes_something_else_is_told_so(name, monkeypatch):
    reason = refusal(law(**{name: lambda self: 0.0}), monkeypatch)
    assert (reason.code, reason.values["name"]) == ("allowed.law-fails", name)
    assert "positional argument" in reason.values["why"]


def test_no_named_tuple_is_no_law(monkeypatch):
    bare = type("Own", (), {"__module__": __name__} | SPRING)
    assert refusal(bare, monkeypatch).code == "allowed.law-tuple"
    assert CONSTANTS == own.MOST_CONSTANTS


def test_what_fails_at_some_constants_only_is_no_matter():
    """Units are those of the law: what one is to it nobody knows."""
    own.check_law(law(dent=lambda self, deepest: 0.0 / (self.stiffness - 1.0)))


def test_one_that_was_never_named_is_looked_at_too():
    scene = Scene.from_table(PLAIN)
    with pytest.raises(SceneError, match="lacks mean"):
        Scene(scene.impactor, scene.target, law(without=["mean"])(1e8))


def test_one_that_was_made_without_a_module_is_taken():
    names = {"NamedTuple": NamedTuple, "members": SPRING}
    exec("class Plain(NamedTuple):\n    stiffness: float\n\n    def dent(self, deepest):\n        return 0.0", names)
    kind = names["Plain"]
    for name, member in SPRING.items():
        if name != "dent":
            setattr(kind, name, member)
    assert kind.dent.__module__ is None
    own.check_law(kind)


def helper(depth):
    return float(str(depth))


@pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")
def test_what_numba_cannot_compile_is_said_in_a_sentence(monkeypatch):
    kind = law(force=lambda self, indentation, rate, deepest: helper(indentation) * self.stiffness)
    reason = refusal(kind, monkeypatch)
    assert (reason.code, reason.values["name"]) == ("allowed.law-compiles", "force")
    assert "helper" in reason.values["why"]
