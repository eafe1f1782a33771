"""The message of a mechanism that moves on: where links and mass go, impacts, reactions, energies, and how long."""

import numpy as np
import pytest
from pytest import approx

import solvers
from app.choices.request import DRAFT, Request
from app.choices.scene_of import acting_choices, own_choices
from app.messages.encoding import read_header
from app.messages.mechanism import moving
from app.messages.mechanism.frame import mechanism_solution
from app.messages.solve import solve_frame
from app.messages.transverse import method_at_impact
from solvers.bodies import Mechanism

from .own import arrays

LARGEST = 100_000  # bytes of a message


def chosen(scene: str, seconds: float | None = None, **changes) -> dict:
    own = own_choices(scene) | {"method": "multibody"} | changes
    return own if seconds is None else own | {"motion_seconds": seconds}


class Told:
    """A message, and the solution that it tells of."""

    def __init__(self, choices: dict):
        message = solve_frame(choices)
        self.size, self.header, self.arrays = len(message), read_header(message), arrays(message)
        self.solution = mechanism_solution(Request.of(choices))[0]

    @property
    def ends(self) -> np.ndarray:
        """(instants, links, ends, x and y) [m], unbent."""
        return self.arrays["linkPoints"] + self.arrays["linkMoves"]


@pytest.fixture(scope="module")
def piston() -> Told:
    return Told(chosen("bouncing-on-piston", 0.6))


@pytest.fixture(scope="module")
def pendulum() -> Told:
    return Told(chosen("double-pendulum", 1.0))


@pytest.fixture(scope="module")
def four_bar() -> Told:
    return Told(chosen("four-bar-moves", 0.06))


def test_links_keep_their_lengths_and_stay_joined(pendulum):
    lengths = np.hypot(*np.moveaxis(pendulum.ends[:, :, 1] - pendulum.ends[:, :, 0], -1, 0))
    assert lengths == approx(np.full(lengths.shape, 0.4), abs=1e-4)  # two bytes are sent
    assert pendulum.ends[:, 0, 1] == approx(pendulum.ends[:, 1, 0], abs=1e-4)
    assert np.abs(pendulum.arrays["linkMoves"]).max() > 0.05


def test_the_mass_flies_freely_and_meets_the_piston_at_every_impact(piston):
    time, (x, y) = piston.arrays["linkTime"], piston.arrays["massPlaces"].T
    assert np.abs(x).max() < 1e-12
    impacts = piston.arrays["contacts"]
    free = (time >= impacts[0, 1]) & (time <= impacts[1, 0])
    curve = np.polynomial.Polynomial.fit(time[free], y[free], 2).convert()
    assert curve.coef[2] == approx(-0.5 * 9.81, rel=1e-2)
    assert piston.header["main"]["contacts"] == len(impacts) > 1
    top = piston.ends[:, 2, :, 1].mean(axis=1)
    for start, _, impulse, _ in impacts:
        at = int(np.abs(time - start).argmin())
        assert y[at] == approx(top[at], abs=2e-5) and impulse > 0.0


def test_parts_of_the_energy_add_up_to_what_was_there(piston, pendulum):
    for told in (piston, pendulum):
        total = told.arrays["energies"].sum(axis=1)
        assert total == approx(np.full(total.shape, total[0]), rel=1e-3)  # histories are straight between steps
        known = told.header["main"]["diagnostics"]
        assert known["energy_drift"] < 1e-9 and known["constraint_error"] < 1e-12
    assert "dissipated" in piston.header["moving"]["energies"]
    assert "dissipated" not in pendulum.header["moving"]["energies"]


def test_the_first_impact_is_the_rigid_impulse_and_its_joints_get_what_the_library_says(piston):
    scene = Request.of(chosen("bouncing-on-piston")).scene
    alone = solvers.solve(scene, "rigid", restitution=0.6)
    assert piston.arrays["contacts"][0, 2] == approx(alone.impulse, rel=1e-6)  # four bytes are sent
    jolts = piston.header["moving"]["jolts"]
    assert jolts[0] == approx([np.hypot(*joint["impulse"]) for joint in alone.reactions], rel=1e-9)
    assert len(jolts) == min(moving.JOLTS, piston.header["main"]["contacts"])


def test_reactions_are_those_of_the_motion(pendulum):
    forces, time = pendulum.arrays["reactions"], pendulum.arrays["reactionTime"]
    middle, most = len(forces) // 2, np.abs(forces).max()
    expected = pendulum.solution.motion.reaction_forces(time[middle])[0]
    assert forces[middle] == approx(expected, abs=1e-4 * most)
    assert forces[:, 0, 1].mean() == approx(2.0 * 9.81, rel=0.05)  # the pin bears both bars of 1 kg


def test_bent_links_are_where_the_motion_has_them_and_their_moments_are_its_own(four_bar):
    motion, found = four_bar.solution.motion, four_bar.arrays
    amounts = found["amountsOf2"]
    rows = {name: found[f"{name}Of2"] * found[f"{name}ScaleOf2"][:, None] for name in ("shape", "moment", "shear")}
    fine, time = found["bendTime"], found["linkTime"]
    x = np.linspace(0.0, 0.8, rows["shape"].shape[1])
    for name, field in (("moment", motion.moment), ("shear", motion.shear)):
        expected = field(fine, x)
        assert amounts @ rows[name] == approx(expected, abs=2e-3 * np.abs(expected).max())
    at = [0, 100, 300]
    bent = np.stack([np.interp(time[at], fine, values) for values in amounts.T], axis=1) @ rows["shape"]
    ends = four_bar.ends[at, 2]
    along = (ends[:, 1] - ends[:, 0]) / 0.8
    across = np.stack((-along[:, 1], along[:, 0]), axis=1)
    drawn = ends[:, :1] + x[:, None] * along[:, None] + bent[:, :, None] * across[:, None]
    true = motion.link_points(time[at], len(x) - 1)["bar"]
    assert np.abs(bent).max() > 1e-3 and drawn == approx(true, abs=2e-4)  # places are sent to 2e-5 m
    joint = round(0.625 * (len(x) - 1))
    assert (
        np.abs(bent[:, [0, joint]]).max() < 0.05 * np.abs(bent).max()
    )  # joints stay closed, however large it is drawn


def test_rigid_links_stand_beside_those_that_bend(four_bar):
    beside = four_bar.header["reference"]
    assert beside["name"] == "rigid-links" and beside["contacts"] == 1
    assert four_bar.arrays["referenceReactions"].shape[1:] == (4, 3)
    assert beside["impulse"] > four_bar.arrays["contacts"][0, 2]


@pytest.mark.parametrize(("seconds", "flexible"), [(0.004, True), (0.5, False)])
def test_links_that_bend_are_followed_as_long_as_their_vibrations_can_be(seconds, flexible):
    told = Told(chosen("rotating-bar", seconds))
    target = told.solution.scene.target
    assert isinstance(target, Mechanism) and target.flexible == flexible
    rigid = told.header["moving"]["rigid"]
    assert (rigid is None) == flexible == told.header["mechanism"]["links"][0]["flexible"]
    if not flexible:
        assert rigid["code"] == "refusals.flexible-steps"
    assert told.header["duration"] == approx(seconds) and ("amountsOf0" in told.arrays) == flexible


def test_links_can_be_taken_as_rigid_and_are_in_a_draft():
    for changes in ({"motion_links": "rigid"}, {DRAFT: 0.125}):
        told = Told(chosen("four-bar-moves", 0.06, **changes))
        assert not told.header["mechanism"]["links"][2]["flexible"] and told.header["moving"]["rigid"] is None
        assert told.header["reference"] is None and told.header["duration"] == approx(0.06)


def test_a_contact_law_gives_a_force_over_time():
    told = Told(chosen("slider-crank", 0.004, law="hertz"))
    start, end, impulse, peak = told.arrays["contacts"][0]
    assert told.header["moving"]["restitution"] is None and end > start
    time, force = told.arrays["mainTime"], told.arrays["mainForce"]
    assert force.max() == approx(peak, rel=1e-6) == approx(told.header["main"]["peakForce"])
    assert np.trapezoid(force, time) == approx(impulse, rel=1e-3)  # thinned
    assert "local" in told.header["moving"]["energies"]


def test_a_law_decides_not_the_restitution_of_the_scene():
    told = Told(chosen("bouncing-on-piston", 0.1, law="hertz")).header
    assert told["moving"]["restitution"] is None
    assert [note["code"] for note in told["main"]["notes"]] == ["configuration-followed"]


def test_a_draft_takes_fewer_and_simpler_steps_and_shows_the_same_motion(piston):
    told = Told(chosen("bouncing-on-piston", 0.6, **{DRAFT: 0.125}))
    assert told.header["draft"] and told.header["main"]["diagnostics"]["steps"] == moving.DRAFT_STEPS
    assert told.solution.diagnostics["energy_drift"] < 1e-4 and told.header["main"]["diagnostics"]["steps"] < 1_400
    time = np.linspace(0.0, 0.6, 100)
    here, there = (np.stack([*each.solution.motion.link_points(time).values()]) for each in (told, piston))
    assert here == approx(there, abs=1e-3 * np.ptp(there[:, 0], axis=0).max())


def test_what_would_take_too_long_is_cut_short_and_said(monkeypatch):
    monkeypatch.setattr(moving, "MOST_RIGID_STEPS", 100)  # of the 200 that a turn of its crank takes
    cut = Told(chosen("slider-crank", 0.04)).header
    assert cut["moving"]["cut"] and cut["duration"] == approx(0.025, rel=1e-2)
    assert not Told(chosen("slider-crank", 0.02)).header["moving"]["cut"]


@pytest.mark.parametrize("scene", ["table-6.8", "bouncing-on-piston"])
def test_messages_are_small(scene):
    assert len(solve_frame(chosen(scene, 0.01 if scene == "table-6.8" else None))) <= LARGEST


def test_what_acts_where_links_move_on():
    assert {"motion_seconds", "motion_links", "restitution"} <= set(acting_choices(chosen("four-bar-moves")))
    by_law = acting_choices(chosen("four-bar"))
    assert {"motion_seconds", "hertz_stiffness"} <= set(by_law) and "restitution" not in by_law
    assert "motion_links" not in acting_choices(chosen("slider-crank"))  # no link of it bends
    for scene, method in (("four-bar", "modal"), ("trip-hammer", "multibody"), ("fixed-rod", "multibody")):
        assert "motion_seconds" not in acting_choices(own_choices(scene) | {"method": method})


def test_other_scenes_are_shown_by_a_method_that_can_solve_them():
    fallen = read_header(solve_frame(chosen("trip-hammer")))
    assert fallen["main"]["name"] == "modal" and fallen["refused"]["code"] == "refusals.mass-on-mechanism"
    assert read_header(solve_frame(chosen("fixed-rod")))["other"]["name"] == "modal"


def test_who_asks_for_the_impact_many_times_gets_that_alone():
    assert method_at_impact(Request.of(chosen("four-bar-moves"))).NAME == "modal"
    assert method_at_impact(Request.of(chosen("slider-crank"))).NAME == "rigid"
