"""Rods that turn: dispersion, critical speed, steady stretch, impacts; thesis 5.6 and its corrections."""

import json

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene, SceneError
from tests.catalog import STEEL_ROD

ROD = {name: STEEL_ROD[name] for name in ("length", "section", "material")} | {"kind": "rotating-rod"}
CRITICAL = 26995.708130449257  # rad/s, (5.50)


def turning(share: float, impactor: dict | None = None, **keys) -> Scene:
    """The steel rod of chapter 5 at this share of its critical speed."""
    tables: dict = {"target": ROD | {"speed": share * CRITICAL} | keys}
    return Scene.from_table(tables if impactor is None else tables | {"impactor": impactor})


def test_frequencies_along_it():
    """(5.48)-(5.50) at half the critical speed."""
    found = solvers.solve(turning(0.5)).table()
    assert found["critical_speed"] == approx(CRITICAL, rel=1e-14)
    assert found["frequencies"][:3] == approx([23378.96903411917, 79854.38155050439, 134301.95222797027], rel=1e-13)
    phases, groups = (np.array(found["axial"][name]) for name in ("phase_speeds", "group_speeds"))
    assert phases[:3] == approx([4465.054183406904, 5083.68782052361, 5129.956695353532], rel=1e-13)
    assert phases * groups == approx(solvers.solve(turning(0.5)).scene.target.wave_speed ** 2, rel=1e-13)


@pytest.mark.parametrize(
    ("share", "stretch", "half"),
    [
        (0.01, 8.225482157744048e-05, 0.6875017349112734),
        (0.1, 0.008306663459730667, 0.6876736881232767),
        (0.3, 0.08124658557544277, 0.6890776757654794),
        (0.5, 0.2732395447351627, 0.691965272983629),
        (0.9, 3.466065613397665, 0.7029966210105063),
        (0.999, 404.69009132728985, 0.7070624701406493),
    ],
)
def test_steady_stretch(share, stretch, half):
    """u(L) / L = tan(a) / a - 1, and u(L/2) / u(L): not one shape at all speeds, as the text after (5.54) has it."""
    rod = turning(share).target
    ends = rod.steady_displacement(np.array([0.15, 0.3]))
    assert rod.steady_stretch / 0.3 == approx(stretch, rel=1e-10)
    assert ends[0] / ends[1] == approx(half, rel=1e-10)
    assert rod.steady_series(np.array([0.15, 0.3]), 4_000) == approx(ends, rel=1e-7)


def test_series_converges_with_the_third_power():
    rod = turning(0.3).target
    errors = [rod.steady_stretch - float(rod.steady_series(np.array([0.3]), n)[0]) for n in (50, 100)]
    assert np.log2(errors[0] / errors[1]) == approx(3.0, abs=0.05)


def test_slow_rotation_stretches_without_cancelling():
    """To second order u = Omega^2 (L^2 x / 2 - x^3 / 6) / c^2; the series joins the closed form."""
    for share in (1e-6, 5e-4, 7e-4):  # a = 1e-3 lies between the last two
        rod = turning(share).target
        assert rod.steady_stretch == approx(0.3 * rod.angle**2 / 3.0, rel=1e-6)
    assert turning(0.0).target.steady_stretch == 0.0


@pytest.mark.slow
def test_bending_and_the_simplified_equation():
    """In units of the beam at rest: right by 0.193 Omega^2, (5.56) unstable above the lowest frequency."""
    unit = 1744.355409282128 / 3.516015268500151
    for speed in (0.5, 2.0, 5.0):
        found = solvers.solve(turning(speed * unit / CRITICAL, support="cantilever")).table()
        squares = (np.array(found["frequencies"][:1]) / unit) ** 2
        assert 12.36236336832619 < squares[0] < 12.36236336832619 + 0.1933363 * speed**2
        simple = found["simplified"]["frequencies"][0]
        by_thesis = 12.36236336832619 - speed**2
        assert (simple is None) == (by_thesis < 0.0) == (not found["simplified"]["stable"])
        assert simple is None or (simple / unit) ** 2 == approx(by_thesis, rel=1e-9)
    assert found["simplified"]["critical_speed"] == approx(3.516015268500151 * unit, rel=1e-9)
    assert found["bending"]["frequencies"] == found["frequencies"]


def test_struck_along():
    """Slow, it is the fixed rod; faster it is softer. Energy is kept, in the turning frame."""
    ball = {"kind": "mass", "mass": 0.2, "velocity": 1.0}
    hertz = {"law": "hertz", "stiffness": 1e10}
    fixed = Scene.from_table({"impactor": ball, "target": STEEL_ROD, "contact": hertz})
    exact = solvers.solve(fixed, "modal", modes=50)
    slow = solvers.solve(turning(1e-4, ball).replace({"contact": hertz}))
    assert slow.impactor_velocity == approx(exact.impactor_velocity, rel=1e-6)
    fast = solvers.solve(turning(0.9, ball).replace({"contact": hertz}))
    assert abs(fast.diagnostics["energy_error"]) < 1e-12
    assert fast.scene.target.softness > 2.0 * slow.scene.target.softness
    modes = fast.scene.target.modes(400)
    a = fast.scene.target.angle
    whole = 0.3 / (210e9 * 9e-4) * np.tan(a) / a
    assert modes.residual_compliance + np.sum((modes.at_contact / modes.frequencies) ** 2) == approx(whole, rel=1e-12)
    assert modes.static_shapes(np.array([0.0, 0.3])) == approx([whole, 0.0], abs=1e-18)
    assert any(note.code == "rotation-strains" for note in fast.notes)
    assert not any(note.code == "rotation-strains" for note in slow.notes)


def test_struck_across():
    """At rest it is the cantilever, by every law alike."""
    ball = {"kind": "mass", "mass": 0.2, "velocity": 1.0}
    hertz = {"law": "hertz", "stiffness": 1e10}
    beam = ROD | {"kind": "beam", "support": "cantilever"}
    still = solvers.solve(Scene.from_table({"impactor": ball, "target": beam, "contact": hertz}), "modal", modes=10)
    scene = turning(1e-6, ball, support="cantilever").replace({"contact": hertz})
    slow = solvers.solve(scene, "modal", modes=10)
    assert slow.contacts[0].impulse == approx(still.contacts[0].impulse, rel=1e-4)
    assert abs(slow.diagnostics["energy_error"]) < 1e-11


def test_without_an_impactor_its_own_mass_strikes():
    scene = turning(0.1)
    assert scene.impactor.mass == approx(scene.target.mass)
    assert Scene.from_table(json.loads(json.dumps(scene.table()))) == scene
    assert scene.replace({"impactor.velocity": 2.0}).speed == 2.0
    with pytest.raises(SceneError) as refused:
        Scene.from_table({"target": STEEL_ROD})
    assert refused.value.key == "impactor"


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"speed": CRITICAL}, "target.speed"),
        ({"speed": -1.0}, "target.speed"),
        ({"speed": None}, "target.speed"),
        ({"support": "free"}, "target.support"),
        ({"support": "cantilever", "theory": "timoshenko"}, "target.theory"),
        ({"theory": "euler-bernoulli", "support": "fixed"}, "target.theory"),
        ({"at": 0.5}, "target.at"),
        ({"velocity": 1.0}, "target.velocity"),
        ({"support": "cantilever", "section": {"area": 9e-4}}, "target.section.second_moment"),
    ],
)
def test_refused(changes, key):
    given = {name: value for name, value in (ROD | {"speed": 100.0} | changes).items() if value is not None}
    with pytest.raises(SceneError) as refused:
        Scene.from_table({"target": given})
    assert refused.value.key == key
