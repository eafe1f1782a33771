"""What a table of bars may be: each refusal names key, value and what is allowed."""

import math

import pytest
from pytest import approx

from solvers import SceneError
from solvers.studies.hopkinson.bars import load_bars, read_bars
from tests.solvers.studies.hopkinson.bench import BARS

PLAIN = {"length": 1.0, "diameter": 0.02, "gauge": 0.5}


def with_incident(**keys):
    return BARS | {"incident": PLAIN | keys}


@pytest.mark.parametrize(
    ("given", "key"),
    [
        ({}, "incident"),
        (BARS | {"incident": 3}, "incident"),
        (BARS | {"colour": 3}, "colour"),
        (with_incident(material="steel", color=1), "incident.color"),
        (with_incident(), "incident.material"),
        (with_incident(wave_speed=5000.0), "incident.youngs_modulus"),
        (with_incident(youngs_modulus=2e11), "incident.wave_speed"),
        (with_incident(material="cheese"), "incident.material"),
        (with_incident(material="steel", gauge=1.1), "incident.gauge"),
        (with_incident(material="steel", gauge="half"), "incident.gauge"),
        (with_incident(material="steel", length=-1.0), "incident.length"),
        (with_incident(material="steel", wave_speed=5.0), "incident.wave_speed"),
        (with_incident(material="steel", poisson=0.7), "incident.poisson"),
        (with_incident(wave_speed=5e3, youngs_modulus=2e11) | {"dispersion": "pochhammer"}, "incident.poisson"),
        (BARS | {"dispersion": "some"}, "dispersion"),
        (BARS | {"specimen": {"length": 0.01}}, "specimen.diameter"),
        (BARS | {"specimen": {"length": 0.01, "diameter": 0.03}}, "specimen.diameter"),
        (BARS | {"striker": {"velocity": 10.0}}, "striker.length"),
        (BARS | {"striker": {"length": 0.2, "velocity": 0.0}}, "striker.velocity"),
        (BARS | {"striker": {"length": 0.2, "wave_speed": 5e3}}, "striker.youngs_modulus"),
        ({name: table for name, table in BARS.items() if name != "specimen"}, "specimen"),
    ],
)
def test_a_wrong_key_is_named(given, key):
    with pytest.raises(SceneError) as error:
        read_bars(given)
    assert error.value.key == key and "\n" not in str(error.value)


def test_a_bar_by_its_material_or_by_its_waves():
    bars = read_bars(with_incident(wave_speed=5000.0, youngs_modulus=2e11, poisson=0.28))
    assert (bars.incident.wave_speed, bars.incident.young, bars.incident.poisson) == (5000.0, 2e11, 0.28)
    assert bars.incident.impedance == approx(2e11 / 5000.0 * math.pi * 0.01**2)
    both = read_bars(with_incident(material="steel", wave_speed=5100.0)).incident
    assert (both.wave_speed, both.young, both.poisson) == (5100.0, 210e9, 0.3)
    assert read_bars(BARS).striker is not None
    assert load_bars(bars) is bars


@pytest.mark.parametrize("content", [b"[incident", b"\xff\xfe", b"a = " + b"[" * 9000, b"x" * 200_000])
def test_a_file_that_is_no_table_is_refused(tmp_path, content):
    path = tmp_path / "bars.toml"
    path.write_bytes(content)
    with pytest.raises(SceneError) as error:
        load_bars(path)
    assert error.value.key == "bars" and "\n" not in str(error.value)
    with pytest.raises(SceneError):
        load_bars(tmp_path / "none.toml")
    with pytest.raises(SceneError):
        load_bars("a\0b")
