"""Energy over time: every share there is, adding up to the whole."""

import numpy as np
import pytest

from app.choices.choices import Choices
from app.choices.request import Request
from app.choices.scene_of import choices_of
from app.messages.transverse import main_solution
from app.views.energy import COLOURS, energy_shares, of_impacts
from solvers import LAWS

BEAM = "figure-8.15"


@pytest.mark.parametrize("law", Choices.param.law.objects)
@pytest.mark.parametrize("scene", ["fixed-rod", "free-rod"])
def test_the_shares_add_up_at_every_instant(scene, law):
    shares = energy_shares(Request.of(Choices(scene=scene, law=law, restitution=0.5).chosen()))
    parts = [shares[name] for name in COLOURS if name in shares]
    assert np.sum(parts, axis=0) == pytest.approx(100.0, abs=1e-5)  # the tolerance of the contact's integration
    assert np.min(parts) > -1e-6
    lost = shares["dissipated"]
    assert (np.diff(lost) >= -1e-6).all()
    if LAWS[law].LOSSY:  # once the bodies have parted nothing is lost, and nothing comes back
        assert np.diff(lost).min() >= -1e-13
    assert (lost[-1] > 1.0) == (LAWS[law].LOSSY or LAWS[law].PLASTIC)


def test_the_energy_of_a_beam_is_split_into_motion_and_bending():
    shares = energy_shares(Request.of(Choices(**choices_of(BEAM), scene=BEAM).chosen()))
    parts = [shares[name] for name in COLOURS if name in shares]
    assert np.sum(parts, axis=0) == pytest.approx(100.0, abs=1e-6)
    assert {"target_kinetic", "target_strain"} <= shares.keys()
    assert shares["target_strain"].max() > 30.0  # the impactor is stopped by the beam as a spring
    assert shares["time"][-1] > 1e-3 and shares["unit"] == "s"


def test_what_drives_bring_in_is_part_of_the_whole():
    """Of the energy of the bar and the mass before it alone, the mass would have 1169 % at the end."""
    shares = energy_shares(Request.of(Choices(**choices_of("rotating-bar"), scene="rotating-bar").chosen()))
    parts = [shares[name] for name in COLOURS if name in shares]
    assert 80.0 < shares["fed"] < 100.0
    assert np.sum(parts, axis=0)[0] == pytest.approx(100.0 - shares["fed"], abs=1e-3)
    assert np.sum(parts, axis=0)[-1] == pytest.approx(100.0, abs=0.1)


def test_the_energy_of_a_beam_follows_every_contact():
    chosen = Choices(**choices_of(BEAM), scene=BEAM).chosen()
    time = energy_shares(Request.of(chosen))["time"]
    for contact in main_solution(Request.of(chosen))[0].contacts:
        within = (time >= contact.start * (1.0 - 1e-9)) & (time <= contact.end * (1.0 + 1e-9))
        assert within.sum() >= 24


def test_a_mechanism_that_moves_on_has_its_energies_beside_its_picture():
    own = Choices(scene="four-bar", **choices_of("four-bar")).chosen()
    assert of_impacts(own) is not None and of_impacts(own | {"method": "multibody"}) is None
    assert of_impacts(own | {"bodies": "target.nothing=1"}) is None


@pytest.mark.parametrize("law", ["linear", "kelvin-voigt"])
def test_weight_is_part_of_the_whole_from_its_lowest_place(law):
    """It falls on while it touches, a soft contact far, and rises again: no share is negative at any instant."""
    own = choices_of("drop-test") | {"law": law, "linear_stiffness": 1e3, "speed": 0.2}
    shares = energy_shares(Request.of(Choices(scene="drop-test", **own).chosen()))
    parts = [shares[name] for name in COLOURS if name in shares]
    assert np.sum(parts, axis=0) == pytest.approx(100.0, abs=1e-3) and np.min(parts) > -1e-6
    assert shares["weight"].min() == 0.0 and shares["weight"][0] > 1.0 and shares["gap"] is None
