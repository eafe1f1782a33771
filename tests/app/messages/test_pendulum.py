"""Pendulums on the page: what is felt of them, how they bend, and the waves that their force sends."""

import numpy as np
import pytest
from pytest import approx

from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.messages.encoding import read_header
from app.messages.pendulum import pendulum_fields, striker_arrays, waves_of_force
from app.messages.solve import solve_frame
from solvers.accuracy.reference import exact_solution

from .own import arrays, own_message

SCENES = ["rigid-pendulum", "figure-9.2", *(f"figure-9.{k}" for k in (10, 11, 14))]
SCENES += [f"figure-10.{k}" for k in range(8, 13)]


@pytest.fixture(scope="module")
def bent():
    """Figure 9.11 as the page knows it best."""
    return exact_solution(Request.of(own_choices("figure-9.11")).scene, 0.8)


@pytest.mark.parametrize("name", SCENES)
def test_every_pendulum_is_shown(name):
    header = read_header(own_message(name))
    told = header["impactor"]
    assert told["kind"] == "pendulum"
    assert told["mass"] == approx(0.0041 / 0.19**2)
    assert told["ownMass"] == approx(0.1968, rel=1e-9)
    assert (told["place"], told["length"]) == (approx(0.19), approx(0.25))
    bends = name not in SCENES[:2]
    assert (header["exact"]["name"] == "converged") == bends
    assert {array[0] for array in header["arrays"]} >= ({"exactBar", "otherBar"} if bends else set())


def test_waves_follow_the_contact_force(bent):
    """The front that runs away from the struck end is the force there, F = Z v."""
    motion, unit = waves_of_force(bent)
    t = np.linspace(0.02, 0.9, 200)  # in round trips, before an echo is back
    force = bent.motion.force(t * bent.scene.time_unit) / (bent.scene.target.impedance * bent.scene.speed)
    assert unit * motion.sent(0, True, t) == approx(force, abs=2e-3 * force.max())


def test_the_bar_bends_where_it_strikes(bent):
    """Its face is not where its turning as a whole has it, and never deeper in the rod than the indentation."""
    time = np.linspace(0.0, bent.duration, 101)
    arrays = striker_arrays("exact", bent, time, 1.0)
    depth = arrays["exactMass"] - bent.motion.end_position(time)
    assert depth.max() == approx(bent.peak_indentation, rel=1e-2)
    assert arrays["exactBar"][0][:, 0] == approx(np.zeros(101), abs=1e-15)
    struck = bent.scene.impactor.place
    along = np.linspace(1e-300, bent.scene.impactor.length, 25)[::2]
    k = int(np.argmin(np.abs(along - struck)))
    bending, unit = arrays["exactBend"]
    assert bending[:, k] * unit == approx(bent.motion.moment(time[::2], -along[[k]])[:, 0], abs=unit)
    whole = bent.motion.impactor_position(time)
    assert np.abs(arrays["exactMass"] - whole).max() > 1e-5
    assert pendulum_fields(bent.scene.target) == {}


def test_modes_of_a_pendulum_on_a_stop_are_chosen():
    """They are its own, as nothing else rings; on a rod they are the rod's."""
    chosen = own_choices("figure-10.11")
    assert chosen["modes"] == 5
    assert Request.of(chosen | {"modes": 3}).scene.impactor.count == 3
    assert Request.of(own_choices("figure-9.11") | {"modes": 12}).scene.impactor.count == 5
    moments = [read_header(solve_frame(chosen | {"modes": n}))["other"]["diagnostics"]["pivot_moment"] for n in (3, 10)]
    assert moments == [approx(31.61, rel=1e-3), approx(0.805, rel=1e-2)]


def test_rods_that_turn_are_drawn():
    """Along it by fields of many modes, in the place of waves; across it by its own shapes; with what rotation does."""
    along, across = (read_header(solve_frame(own_choices(f"figure-5.{k}"))) for k in (24, 22))
    assert {array[0] for array in along["arrays"]} >= {"exactStress", "exactVelocity", "exactDisplacement"}
    assert along["rods"][0]["to"] == 0.3
    assert along["exact"]["name"] == across["exact"]["name"] == "converged"
    assert "turningBar" in {array[0] for array in across["arrays"]}
    rotation = along["target"]["rotation"]
    assert rotation["axial"] == approx([23379.0, 79854.4, 134302.0], rel=1e-5)
    assert rotation["stretch"] == approx(0.0819718, rel=1e-5)
    assert rotation["simplified"][:2] == [None, None]


def test_moments_at_the_pivot_over_time_are_those_of_the_solution():
    """Shapes clamped there make one that a pivot cannot bear, figure 10.11; many that are pinned make none."""
    message = solve_frame(own_choices("figure-10.11"))
    found, told = arrays(message), read_header(message)["other"]["diagnostics"]
    exact, other = (np.abs(found[f"{name}Moments"]).max(axis=0) for name in ("exact", "other"))
    assert other[[0, 2]] == approx([told["pivot_moment"], told["contact_moment"]], rel=2e-2)  # on 151 instants
    assert exact[0] < 1e-9 * exact[2]


def test_moments_at_three_places_are_those_of_figure_10_12():
    found = np.abs(arrays(solve_frame(own_choices("figure-10.12")))["otherMoments"]).max(axis=0)
    assert found == approx([31.61, 27.22, 45.20], rel=5e-3)


def test_a_rod_that_turns_bends_at_its_axis():
    found = arrays(solve_frame(own_choices("figure-5.22")))
    axis, between, tip = np.abs(found["exactMoments"]).max(axis=0)
    assert axis > 100.0 and tip < 1e-6 * axis  # it is struck at its free end
    assert 1e-2 * axis < between < 2.0 * axis


@pytest.mark.parametrize("name, printed", [("figure-10.8", 6.282), ("figure-10.9", 6.286)])
def test_a_pendulum_turns_back_at_the_angular_velocity_that_is_printed(name, printed):
    """6.282 rad/s, thesis figure 10.8; of figure 10.9 6.286, see its note."""
    header = read_header(own_message(name))
    assert header["other"]["spins"] == [approx(-printed, abs=1e-3), None]
    assert header["exact"]["spins"][0] == approx(-6.345, abs=5e-3)
    assert header["exact"]["spins"][0] == approx(header["exact"]["final"] * header["speed"] / 0.19)


def test_what_hangs_on_no_pivot_has_no_angular_velocity():
    assert read_header(own_message("fixed-rod"))["exact"]["spins"] == [None, None]
