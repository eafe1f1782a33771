"""Constants of contact laws in a scene: read, written back, refused; and the limits that laws report."""

import math

import pytest
from pytest import approx

import solvers
from solvers import LAWS as CLASSES
from solvers import Scene, SceneError
from tests.catalog import struck_rod
from tests.solvers.contact.spheres import STEEL_400, sphere_scene


@pytest.mark.parametrize("name", CLASSES)
def test_constants_are_read_back(name):
    scene = struck_rod(1.0, "free", {"law": name} | CLASSES[name].EXAMPLE)
    again = Scene.from_table(scene.table())
    assert again.contact == scene.contact
    outright = {"law": name} | scene.contact.table(scene.speed)
    assert struck_rod(1.0, "free", outright).contact == scene.contact
    assert set(scene.table()["contact"]) <= {"law", *CLASSES[name].KEYS}


@pytest.mark.parametrize(
    "contact, key",
    [
        ({"law": "linear"}, "contact.stiffness"),
        ({"law": "power", "stiffness": 1e9}, "contact.exponent"),
        ({"law": "power", "stiffness": 1e9, "exponent": 0.9}, "contact.exponent"),
        ({"law": "power", "stiffness": 1e9, "exponent": 3.1}, "contact.exponent"),
        ({"law": "hertz"}, "contact.stiffness"),  # no radius anywhere
        ({"law": "kelvin-voigt", "restitution": 0.5}, "contact.stiffness"),
        ({"law": "kelvin-voigt", "stiffness": 1e9}, "contact.restitution"),
        ({"law": "kelvin-voigt", "stiffness": 1e9, "restitution": 0.0}, "contact.restitution"),
        ({"law": "kelvin-voigt", "stiffness": 1e9, "restitution": 1.1}, "contact.restitution"),
        ({"law": "hunt-crossley", "stiffness": 1e9, "nominal_restitution": -0.1}, "contact.nominal_restitution"),
        ({"law": "hunt-crossley", "stiffness": 1e9, "damping": -1.0}, "contact.damping"),
        ({"law": "hunt-crossley", "stiffness": 1e9, "damping": math.nan}, "contact.damping"),
        ({"law": "hunt-crossley", "stiffness": 1e9, "damping": 1e9}, "contact.damping"),
        ({"law": "lee-wang", "stiffness": 1e9, "damping": 1.0, "restitution": 0.5}, "contact.damping"),
        ({"law": "lee-wang", "exponent": 2.0, "restitution": 0.5}, "contact.stiffness"),
        ({"law": "plastic-linear", "stiffness": 1e9}, "contact.yield_indentation"),
        ({"law": "plastic-linear", "stiffness": 1e9, "yield_indentation": 0.0}, "contact.yield_indentation"),
        ({"law": "plastic-power", "stiffness": 1e9, "yield_indentation": 1e-6, "full_indentation": 2e-5},
         "contact.full_indentation"),
        ({"law": "hertz", "stiffness": 1e9, "damping": 1.0}, "contact.damping"),
    ],
)  # fmt: skip
def test_bad_constants_are_refused(contact, key):
    with pytest.raises(SceneError) as refused:
        struck_rod(1.0, "free", contact)
    assert refused.value.key == key


@pytest.mark.parametrize(
    "material, key",
    [({"yield": 0.0}, "yield"), ({"yield": -1.0}, "yield"), ({"poisson": 0.5}, "poisson"), ({"young": 0.0}, "young")],
)
def test_unphysical_materials_are_refused(material, key):
    with pytest.raises(SceneError) as refused:
        sphere_scene({"law": "plastic-power"}, {"material": STEEL_400 | material})
    assert refused.value.key == f"impactor.material.{key}"


def test_a_yield_strength_is_needed():
    with pytest.raises(SceneError, match="yield in the material"):
        sphere_scene({"law": "plastic-power"}, {"material": "steel"}, {"kind": "half-space", "material": "bronze"})


def test_limits_are_reported():
    def sentences(contact, depth):
        scene = sphere_scene(contact)
        return [str(note) for note in scene.contact.limits(depth, scene.impactor, scene.target)]

    assert sentences({"law": "hertz"}, 3.0e-6) == []
    (yields,) = sentences({"law": "hertz"}, 6.1e-6)
    assert "2.01 times that of first yield" in yields
    assert "third" in sentences({"law": "hertz"}, 0.04 / 8.9)[1]  # a^2 = alpha R
    assert sentences({"law": "plastic-linear"}, 3e-4) == []
    (wide,) = sentences({"law": "plastic-linear"}, 0.04 / 17.9)  # a^2 = 2 alpha R
    assert "third" in wide
    (full,) = sentences({"law": "plastic-power"}, 7.7e-4)
    assert "2 times that of full plastic flow" in full
    assert sentences({"law": "power", "stiffness": 1e9, "exponent": 1.2}, 1.0) == []


@pytest.mark.parametrize(
    ("material", "speed", "told"),
    [
        ({"young": 210e9, "density": 7900.0}, 3.13, True),  # a ball of 1 kg from 0.5 m: 5.6 GPa, and nobody's yield
        ({"young": 210e9, "density": 7900.0}, 0.3, False),
        ({"young": 210e9, "density": 7900.0, "yield": 350e6}, 3.13, False),  # compared with that
        ({"young": 3e9, "density": 1200.0}, 10.0, True),
        ({"young": 5e6, "density": 1100.0, "poisson": 0.49}, 3.13, False),  # rubber
    ],
)
def test_a_pressure_that_hardly_any_material_bears_is_told(material, speed, told):
    scene = sphere_scene(
        {"law": "hertz"},
        {"material": material, "radius": 0.0313, "velocity": speed},
        {"kind": "half-space", "material": material},
    )
    found = {note.code: note for note in solvers.solve(scene).notes}
    assert ("pressure-large" in found) == told
    if told:
        # p0 = 3 F / (2 pi a^2), of the peak force by energy
        radius, modulus = 0.0313, 0.5 * material["young"] / (1.0 - 0.3**2)  # of both
        depth = (1.25 * scene.impactor.mass * speed**2 / (4.0 / 3.0 * modulus * math.sqrt(radius))) ** 0.4
        force = 4.0 / 3.0 * modulus * math.sqrt(radius) * depth**1.5
        pressure = 1.5 * force / (math.pi * radius * depth)
        assert found["pressure-large"].values["pressure"] == approx(pressure, rel=1e-6)
        assert found["pressure-large"].values["share"] == approx(pressure / material["young"], rel=1e-6)
