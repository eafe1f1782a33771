"""The message for a struck beam: small, finite, and what the library says."""

import itertools
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import solvers
from app.choices.choices import Choices
from app.choices.request import Request
from app.choices.scene_of import choices_of, chosen_scene
from app.messages.encoding import instants, read_header
from app.messages.histories import struck_velocity
from app.messages.solve import solve_frame
from app.messages.transverse import CONTACTS, PLACES, chosen_method
from app.page.picker import scene_groups
from app.text.refusals import Refused
from app.views.convergence import convergence_data
from app.views.trust import trust_data
from solvers import METHODS
from tests.app.sentences import sentence
from tests.catalog import SCENES

from .own import arrays, own_message

BEAMS = [name for name, scene in SCENES.items() if scene.target.kind == "beam"]
PLASTIC = "figure-8.15"


def choices(name: str, **changed) -> dict:
    return Choices(scene=name, **choices_of(name) | changed).chosen()


@pytest.mark.parametrize("name", BEAMS)
def test_every_beam_is_drawn_as_the_library_solves_it(name):
    message = own_message(name)
    header, found = read_header(message), arrays(message)
    request = Request.of(choices(name))
    scene = request.scene
    assert scene == solvers.load(name) or scene.target == solvers.load(name).target
    solution = chosen_method(request)[0].solve(scene, scene.method.get("duration"))
    assert header["kind"] == "beam" and header["refused"] is None
    assert header["main"]["final"] == pytest.approx(solution.impactor_velocity, rel=1e-12)
    assert header["duration"] == pytest.approx(solution.duration)
    rows = found["contacts"]
    assert rows[:, 0] == pytest.approx([c.start for c in solution.contacts[: len(rows)]], rel=1e-6, abs=1e-12)


def test_the_histories_are_those_of_the_motion():
    chosen = choices(PLASTIC)
    request, found = Request.of(chosen), arrays(solve_frame(chosen))
    motion = chosen_method(request)[0].solve(request.scene).motion
    time = found["time"].astype(float)
    assert found["impactorPath"] == pytest.approx(motion.impactor_position(time), rel=1e-4, abs=1e-8)
    assert found["struckPath"] == pytest.approx(motion.end_position(time), rel=1e-4, abs=1e-8)
    assert found["impactorRate"] == pytest.approx(motion.impactor_velocity(time), rel=1e-4, abs=1e-6)
    assert np.abs(found["struckRate"] - motion.end_velocity(time)).max() < 0.02  # with the modes left out giving way


def test_the_tables_rebuild_the_fields():
    """Shapes of whole numbers against those of the library, to half a unit of the largest."""
    chosen = choices(PLASTIC)
    found = arrays(solve_frame(chosen))
    beam = chosen_scene(chosen).target
    modes, x = beam.modes(chosen["modes"]), np.linspace(0.0, beam.length, PLACES)
    for name, table in (("shape", modes.shapes(x)), ("moment", modes.moments(x)), ("shear", modes.shears(x))):
        rows = found[f"{name}Rows"] * found[f"{name}Scale"][:, None]
        assert np.abs(rows - table).max(axis=1) == pytest.approx(0.0, abs=2e-5 * np.abs(table).max())
    assert found["modalAtContact"] == pytest.approx(modes.at_contact, rel=1e-6)


def test_the_dispersion_curve_passes_through_the_kept_modes():
    found = arrays(solve_frame(choices(PLASTIC)))
    below = found["modeFrequencies"] < found["lower"][-1]
    on_curve = np.interp(found["modeWavenumbers"], found["wavenumbers"], found["lower"])
    assert below.all()
    assert on_curve == pytest.approx(found["modeFrequencies"], rel=2e-2)  # the curve is drawn through 60 points


@pytest.mark.slow
@settings(max_examples=20, deadline=None)
@given(
    scene=st.sampled_from(BEAMS),
    support=st.sampled_from(Choices.param.support.objects),
    theory=st.sampled_from(Choices.param.theory.objects),
    slenderness=st.floats(0, 3).map(lambda x: 10.0**x),
    damping=st.floats(0, 0.2),
    place=st.floats(0, 1),
    law=st.sampled_from(Choices.param.law.objects),
    method=st.sampled_from(Choices.param.method.objects),
    mass_ratio=st.floats(-3, 3).map(lambda x: min(max(10.0**x, 1e-3), 1e3)),
    speed=st.floats(-2, 2).map(lambda x: min(max(10.0**x, 1e-2), 1e2)),
    modes=st.integers(1, 25),  # of 200 some are solved for a minute, which the page gives up
    elements=st.integers(1, 60),
)
def test_whatever_is_chosen_of_a_beam_is_answered_or_refused_with_a_sentence(**chosen):
    chosen = Choices(**choices_of(chosen["scene"]) | chosen).chosen()
    try:
        message = solve_frame(chosen)
    except Refused as refusal:
        assert str(refusal).startswith("Struck at: ")
        return
    assert len(message) <= 100_000
    for name, values in arrays(message).items():
        assert np.isfinite(values).all(), name
    header = read_header(message)
    assert (header["refused"] is None) == (header["refusals"][chosen["method"]] is None)
    assert header["reference"] is None or header["reference"]["diagnostics"]["energy_error"] < 1e-9


def test_modes_left_out_give_way_where_the_contact_is_made_rigid():
    """Also in scenes that neglect them: modes were listed as able and refused all the same."""
    header = read_header(solve_frame(choices("figure-8.11", law="rigid", method="modal")))
    assert header["refused"] is header["refusals"]["modal"] is None
    assert header["main"]["name"] == "modal"


def test_a_choice_changes_the_beam_and_nothing_else():
    base = solvers.load(PLASTIC)
    for name, value, read in (
        ("support", "free-free", lambda beam: beam.support),
        ("theory", "euler-bernoulli", lambda beam: beam.theory),
        ("slenderness", 20.0, lambda beam: beam.slenderness),
        ("damping", 0.01, lambda beam: beam.damping),
        ("place", 0.25, lambda beam: beam.at),
    ):
        scene = chosen_scene(choices(PLASTIC, **{name: value}))
        assert read(scene.target) == pytest.approx(value) if name != "support" else read(scene.target) == value
        assert scene.contact == base.contact
        assert scene.mass_ratio == pytest.approx(base.mass_ratio, rel=1e-9)


def test_what_another_support_does_not_allow_is_left_out():
    heavy = {"scene": PLASTIC, **choices_of(PLASTIC)}
    scene = chosen_scene(Choices(**heavy | {"support": "pinned-pinned", "place": 0.5}).chosen())
    assert scene.target.end_mass == 0.0 and scene.target.support == "pinned-pinned"


def test_instants_lie_closer_together_at_first():
    time = instants(2.0, 101)
    assert time[0] == 0.0 and time[-1] == 2.0
    assert (np.diff(time, 2) > 0.0).all()


def test_the_struck_place_moves_as_its_path_says():
    scene = solvers.load(PLASTIC)
    solution = solvers.solve(scene)
    time = np.linspace(0.0, solution.duration, 4_001)
    travelled = np.trapezoid(struck_velocity(solution, time), time)
    assert travelled == pytest.approx(float(solution.motion.end_position(time[-1:])[0]), rel=2e-2)


def test_beams_have_a_heading_of_their_own_in_the_picker():
    headings = {sentence(heading): [name for name, _ in scenes] for heading, scenes in scene_groups()}
    assert all(solvers.load(name).target.kind == "beam" for name in headings.get("Beams", []))
    assert "figure-8.15" in headings["Thesis, chapter 8"]


@pytest.mark.slow
def test_the_studies_are_plain_data():
    chosen = choices("figure-8.25")
    trust = json.loads(trust_data(chosen))
    assert trust["chosen"] == chosen
    rows = {row["quantity"]: row for row in trust["spread"]}
    assert rows["final_velocity"]["verdict"] == "firm" and not trust["ill"]  # one contact of a light striker
    for band in (trust["force"], trust["displacement"]):
        bounds = [np.array(band[name]) for name in ("lowest", "low", "high", "highest")]
        assert all((a <= b + 1e-4 * np.abs(b).max()).all() for a, b in itertools.pairwise(bounds))
        assert bounds[0].size == len(trust["time"])
    study = json.loads(convergence_data(chosen | {"convergence_by": "own"}))
    assert study["counts"] == [3, 5, 10, 20, 40]
    assert len(study["values"]["support_shear"]) == 5
    assert "error" in json.loads(trust_data(choices("figure-8.25", place=0.0)))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("scene", ["slider-crank", "four-bar"])
def test_a_mechanism_is_answered_whatever_the_method(scene, method):
    asked = Choices(**({"scene": scene} | choices_of(scene) | {"method": method})).chosen()
    header = read_header(solve_frame(asked))
    assert header["main"]["name"] == method or header["refused"]
    assert len(header["main"]["joints"]) == len(header["mechanism"]["joints"])
    assert (header["reference"] is None) == (scene == "slider-crank")


def test_of_very_many_contacts_the_last_is_there_too():
    message = solve_frame(choices("hammer-on-cantilever", law="rigid", mass_ratio=0.0441))
    found, listed = read_header(message)["main"], arrays(message)["contacts"]
    assert found["contacts"] > CONTACTS == len(listed)
    assert listed[-1, 0] > listed[-2, 1] and listed[-1, 1] > 0.5 * read_header(message)["span"]["apparent"]
