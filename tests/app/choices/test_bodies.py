"""Bodies with other values: what follows from them, what stays, what cannot be."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

import solvers
from app.choices.bodies import LONGEST, RANGES, parts_of, read_values, split, with_values, written
from app.choices.body_value import with_body_value
from app.choices.built_in import body_keys
from app.choices.choices import SCENES, accepts, refusal
from app.choices.scene_of import acting_choices, chosen_scene, own_choices
from app.messages.encoding import read_header
from app.messages.solve import solve_frame
from app.page.address import from_address


def changed(scene: str, *values: str, **settings) -> dict:
    """The choices after these values were typed one after the other."""
    chosen = own_choices(scene) | settings
    for value in values:
        chosen |= with_body_value(chosen | {"body_value": value})
    return chosen


def told(chosen: dict, part: str = "target") -> dict:
    """What a message says of a body: its values, and what follows from them."""
    found = next(each for each in read_header(solve_frame(chosen))["parts"] if each["key"] == part)
    return {each["quantity"]: each["value"] for each in found["values"]} | dict(found["derived"])


def test_what_follows_from_length_and_material_is_as_computed_by_hand():
    rod = told(changed("fixed-rod", "target.length=0.6", "target.material=aluminium", "target.section.width=0.02"))
    wave_speed, area = math.sqrt(70e9 / 2700.0), 0.02 * 0.03
    assert rod["wave_speed"] == pytest.approx(wave_speed, rel=1e-12)
    assert rod["impedance"] == pytest.approx(2700.0 * wave_speed * area, rel=1e-12)
    assert rod["round_trip"] == pytest.approx(1.2 / wave_speed, rel=1e-12)
    assert rod["mass"] == pytest.approx(2700.0 * area * 0.6, rel=1e-12)


def test_a_changed_rod_is_solved_as_one_written_in_a_file():
    chosen = changed("fixed-rod", "target.length=0.6", "target.material.young=1e11")
    other = solvers.load("fixed-rod").replace(
        {"target.length": 0.6, "target.material": {"young": 1e11, "density": 7900.0}, "impactor.mass": 2.133}
    )
    found, expected = solvers.solve(chosen_scene(chosen)), solvers.solve(other)
    assert found.impactor_velocity == pytest.approx(expected.impactor_velocity, rel=1e-9)
    assert found.peak_force == pytest.approx(expected.peak_force, rel=1e-9)


@pytest.mark.parametrize("value", ["target.length=0.6", "target.material=bronze", "target.section.height=0.05"])
@pytest.mark.parametrize("scene", ["fixed-rod", "hammer-on-cantilever"])
def test_another_struck_body_leaves_the_striker_as_heavy_as_it_was(scene, value):
    for settings in ({}, {"mass_ratio": 7.5}):
        before, after = own_choices(scene) | settings, changed(scene, value, **settings)
        assert chosen_scene(after).impactor.mass == pytest.approx(chosen_scene(before).impactor.mass, rel=1e-11)
        assert after["mass_ratio"] == pytest.approx(chosen_scene(after).mass_ratio, rel=1e-11)


def test_the_mass_of_the_striker_is_the_mass_ratio_and_the_slider_is_the_mass():
    chosen = changed("fixed-rod", "impactor.mass=0.5")
    assert chosen["mass_ratio"] == pytest.approx(2.133 / 0.5, rel=1e-11) and chosen["bodies"] == ""
    assert told(chosen | {"mass_ratio": 4.0}, "impactor")["mass"] == pytest.approx(2.133 / 4.0, rel=1e-12)


def test_length_and_slenderness_of_a_beam_are_one():
    chosen = changed("hammer-on-cantilever", "target.length=0.8")
    assert (chosen["slenderness"], chosen["bodies"]) == (40.0, "")
    chosen = changed("hammer-on-cantilever", "target.section.height=0.01")
    assert chosen["slenderness"] == 40.0
    assert chosen_scene(chosen).target.length == pytest.approx(0.4, rel=1e-12)


def test_a_larger_ball_is_heavier_and_its_contact_stiffer():
    chosen = changed("two-balls", "impactor.radius=0.04")
    scene = chosen_scene(chosen)
    assert scene.impactor.mass == pytest.approx(4 / 3 * math.pi * 0.04**3 * 7900.0, rel=1e-11)
    radius, modulus = 1.0 / (1.0 / 0.04 + 1.0 / 0.03), 210e9 / (1.0 - 0.09) / 2.0
    assert scene.contact.stiffness == pytest.approx(4 / 3 * modulus * math.sqrt(radius), rel=1e-12)
    assert chosen["hertz_stiffness"] == scene.contact.stiffness
    scene = chosen_scene(changed("two-balls", "impactor.radius=0.04", hertz_stiffness=1e9))
    assert scene.contact.stiffness == 1e9  # set by hand, it stays


@pytest.mark.parametrize("scene", ["fixed-rod", "two-balls", "hammer-on-cantilever", "split-hopkinson", "spring-mass"])
def test_what_is_set_back_is_as_before(scene):
    keys = [key for key in body_keys(scene) if not key.endswith((".material", ".yield"))]
    own = own_choices(scene)
    values = told(own, "target") | {}
    chosen = dict(own)
    for key in keys:
        part, _, quantity = key.partition(".")
        if part == "target" and quantity in values:
            chosen |= with_body_value(chosen | {"body_value": f"{key}={1.1 * values[quantity]!r}"})
    chosen |= with_body_value(chosen | {"body_value": "target"})
    assert chosen["bodies"] == ""
    chosen |= with_body_value(chosen | {"body_value": "impactor"})
    assert chosen == own


def test_a_time_asked_for_is_so_many_round_trips_of_the_longer_rod():
    before, after = (chosen_scene(changed("split-hopkinson", *values)) for values in ((), ("target.rods.1.length=3",)))
    assert after.method["duration"] / after.time_unit == pytest.approx(before.method["duration"] / before.time_unit)
    assert after.target.rods[0].length == 3.0


def links(scene: str, *values: str) -> dict[str, tuple]:
    """Both ends of every link, and where the joints are."""
    target = chosen_scene(changed(scene, *values)).target
    return {link.name: (link.start, link.end) for link in target.links} | {
        "joints": tuple(joint.at for joint in target.joints)
    }


def test_a_joint_is_moved_with_all_that_meets_there_and_the_impact_comes_as_before():
    found = links("four-bar", "target.joints.2.y=0.35")
    assert found["crank"] == ((0.0, 0.0), (0.0, 0.35)) and found["coupler"] == ((0.0, 0.35), (0.4, 0.5))
    assert found["joints"][1] == (0.0, 0.35) and found["bar"] == links("four-bar")["bar"]
    before, after = (chosen_scene(changed("four-bar", *values)) for values in ((), ("target.joints.2.y=0.35",)))
    assert after.speed == pytest.approx(before.speed, rel=1e-12)
    assert after.target.velocity != pytest.approx(before.target.velocity, rel=1e-3)


def test_a_free_end_of_a_link_stays_on_its_line_and_as_far_from_the_next_joint():
    (start, end), joint = links("four-bar", "target.joints.4.x=0.5")["bar"], (0.4, 0.5)
    assert start == (0.5, 0.0) and math.dist(end, joint) == pytest.approx(0.3, rel=1e-12)
    assert math.dist(start, end) == pytest.approx(math.dist(start, joint) + 0.3, rel=1e-12)
    piston = links("slider-crank", "target.joints.3.x=0.09")["piston"]
    assert piston[0] == (0.09, 0.0) and piston[1] == pytest.approx((0.11, 0.0), rel=1e-12)
    table = links("bouncing-on-piston", "target.joints.3.y=0.06")["piston"]  # both of whose ends are free
    assert [*table[0], *table[1]] == pytest.approx([-0.02, 0.06, 0.02, 0.06], rel=1e-12)


def test_a_longer_link_of_a_mechanism_is_one_written_in_a_file():
    table = solvers.load("rotating-bar").target.table()
    table["links"][0] |= {"to": [0.45, 0.0]}
    other = solvers.load("rotating-bar").replace({"target": table})
    found = chosen_scene(changed("rotating-bar", "target.links.1.length=0.45"))
    assert found.target == other.target
    assert found.impactor.velocity == pytest.approx(solvers.load("rotating-bar").speed - 3.142 * 0.45, rel=1e-9)
    assert "length" not in {quantity for part in parts_of(solvers.load("four-bar")) for quantity in part.quantities
                            if part.name in ("crank", "coupler")}  # whose ends are joints  # fmt: skip


def test_a_mechanism_that_cannot_be_is_refused_in_a_sentence():
    with pytest.raises(ValueError, match=r"^The mechanism cannot be like that. Allowed: "):
        changed("four-bar", "target.joints.2.x=0.4", "target.joints.2.y=0.5")  # the coupler has no length
    with pytest.raises(ValueError, match=r"Place x of body 2, joint 9: the bodies of this scene have no such value\."):
        changed("four-bar", "target.joints.9.x=1")


def test_a_heavier_body_in_space_is_as_large_as_before():
    before, after = (told(changed("brick-off-centre", *values)) for values in ((), ("target.mass=7",)))
    assert after["mass"] == 7.0 and after["longest_side"] == pytest.approx(before["longest_side"], rel=1e-12)


@pytest.mark.parametrize("value", ["-1", "0", "nan", "inf", "1e400", "2 kg", "1_0", "0x1", "1e5", "<b>", "١"])
def test_what_no_length_can_be_is_refused_by_one_sentence(value):
    text = f"target.length={value}"
    assert not accepts("bodies", text)
    with pytest.raises(
        ValueError, match=r"^Length of body 2: .* is not possible. Choose a number from 1e-05 to 10000 m."
    ):
        changed("fixed-rod", text)
    assert str(refusal("bodies", text)).startswith("Bodies: ")


@pytest.mark.parametrize(
    "value, sentence",
    [
        ("target.rods.2.length=1", "Length of body 2, rod 2: the bodies of this scene have no such value."),
        ("impactor.length=1", "Length of body 1: the bodies of this scene have no such value."),
        ("target.colour=1", "No body has a value 'target.colour'."),
        ("<script>=1", "No body has a value “…”."),
        ("target.material=<b>", "Material of body 2: “…” is not possible. Choose one of steel, bronze, "),
        ("target.length=1e4", "Mass ratio would then be 3.333e+04; it can be from 0.001 to 1000."),
    ],
)
def test_what_a_scene_does_not_have_is_refused(value, sentence):
    with pytest.raises(ValueError) as refused:
        changed("fixed-rod", value)
    assert str(refused.value).startswith(sentence)


def test_what_the_library_refuses_has_the_name_that_the_page_gives_it():
    with pytest.raises(ValueError, match=r"^Mass of body 1: got 0.517; allowed: 1 to 1e\+18 kg"):
        changed("brick-off-centre", "target.mass=1e9")


def test_what_would_clash_with_the_scene_is_refused_where_it_is_solved():
    chosen = own_choices("fixed-rod") | {"bodies": "target.rods.2.length=1"}
    assert accepts("bodies", chosen["bodies"])  # some scene has it
    with pytest.raises(ValueError, match="the bodies of this scene have no such value"):
        solve_frame(chosen)
    assert not accepts("bodies", "target.length=1 " * LONGEST)


def test_an_address_names_values_as_a_scene_file_does():
    chosen = changed("fixed-rod", "target.length=0.6", "target.material=bronze", "impactor.mass=0.5")
    asked = {"target.length": [b"0.6"], "target.material": [b"bronze"], "impactor.mass": [b"0.5"]}
    kept, refused = from_address(asked)
    assert refused == [] and own_choices("fixed-rod") | kept == chosen
    kept, refused = from_address({"scene": [b"fixed-rod"], "target.length": [b"2 m"], "impactor.mass": [b"-1"]})
    assert kept["bodies"] == "" and len(refused) == 2


@pytest.mark.slow
@given(
    st.sampled_from(["fixed-rod", "two-balls", "split-hopkinson", "four-bar", "slider-crank"]),
    st.integers(0, 100),
    st.one_of(st.floats(1e-3, 1e3), st.sampled_from(["steel", "x", "1e999", "-0", "=", ";"])),
)
def test_no_value_breaks_anything(scene, number, value):
    key = body_keys(scene)[number % len(body_keys(scene))]
    try:
        chosen = changed(scene, f"{key}={value}")
    except ValueError as refused:
        assert str(refused).count("\n") == 0
    else:
        assert read_values(written(read_values(chosen["bodies"]))) == read_values(chosen["bodies"])
        chosen_scene(chosen)


@pytest.mark.slow
def test_every_value_of_every_kind_of_body_can_be_changed_and_set_back():
    kinds = {(scene.impactor.kind, scene.target.kind): name for name, scene in SCENES.items()}
    for name in kinds.values():
        own = own_choices(name)
        values = {f"{part.key}.{quantity}": part.value(quantity)
                  for part in parts_of(SCENES[name]) for quantity in part.quantities}  # fmt: skip
        for key in body_keys(name):
            wanted = "bronze" if key.endswith(".material") else 0.93 * (values[key] or 3e8)
            wanted = values[key] + 1e-3 if key.endswith((".x", ".y")) else wanted
            chosen = own | with_body_value(own | {"body_value": f"{key}={wanted}"})
            part, quantity = split(key)
            found = next(each for each in parts_of(chosen_scene(chosen)) if each.key == part).value(quantity)
            assert found == (wanted if isinstance(wanted, str) else pytest.approx(wanted, rel=1e-11)), (name, key)
            assert chosen | with_body_value(chosen | {"body_value": key}) == own, (name, key)


def test_every_scene_has_bodies_and_every_value_of_them_is_within_its_bounds():
    for name, scene in SCENES.items():
        assert body_keys(name) and "bodies" in acting_choices(own_choices(name))
        assert with_values(scene, {}) is scene
    for end in (0, 1):
        material = {key.split(".")[1]: ends[end] for key, ends in RANGES.items() if key.startswith("material.")}
        solvers.load("fixed-rod").replace({"target.material": material, "target.length": RANGES["length"][end]})
