"""Which points a study has, and what is refused before any is solved."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pytest import approx
from scipy import stats

import solvers
from solvers import SceneError
from solvers.studies.study.axes import LAWS, axes_of, number_of, parse_values
from solvers.studies.study.design import MOST_POINTS, design_of

SCENE = solvers.load("bronze-rod-steel-ball")
SPEED = SCENE.impactor.velocity


def points(vary, sample=None, count=None, seed=0) -> list[tuple]:
    design = design_of(SCENE, vary, sample, count, seed)
    return design.rows(0, design.size)


def test_a_grid_has_each_value_with_each_of_the_others():
    design = design_of(
        SCENE, {"impactor.velocity": [1, 2.5], "contact.law": "hertz,rigid", "method.modes": "2..4:3"}, None, None, 0
    )
    assert design.shape == (2, 2, 3) and design.keys == ("impactor.velocity", "contact.law", "method.modes")
    assert design.rows(0, 4) == [(1, "hertz", 2), (1, "hertz", 3), (1, "hertz", 4), (1, "rigid", 2)]
    assert design.rows(11, 12) == [(2.5, "rigid", 4)]


@given(st.lists(st.integers(1, 6), min_size=1, max_size=4), st.data())
def test_rows_of_a_part_are_those_of_the_whole(sizes, data):
    vary = {f"key{number}": list(range(size)) for number, size in enumerate(sizes)}
    design = design_of(SCENE, vary, None, None, 0)
    whole = design.rows(0, design.size)
    assert len(set(whole)) == design.size == math.prod(sizes)
    start = data.draw(st.integers(0, design.size - 1))
    stop = data.draw(st.integers(start + 1, design.size))
    assert design.rows(start, stop) == whole[start:stop]


@pytest.mark.parametrize(
    "given_, rows",
    [
        ([1.0, 2], [(1.0,), (2,)]),
        (np.array([1.0, 2.0]), [(1.0,), (2.0,)]),
        (range(2), [(0,), (1,)]),
        (3, [(3,)]),
        (np.array(3.0), [(3.0,)]),
        ("1,2.5,steel", [(1,), (2.5,), ("steel",)]),
        ("1..3:3", [(1.0,), (2.0,), (3.0,)]),
        ("1..100:3:log", [(1.0,), (10.0,), (100.0,)]),
        ("true", [(True,)]),
    ],
)
def test_what_values_may_be_written_as(given_, rows):
    assert [tuple(map(approx, row)) if isinstance(row[0], float) else row for row in rows] == points(
        {"impactor.velocity": given_}
    )


def test_keys_that_vary_together():
    together = {"target.length,impactor.radius": "(1,0.01),(2,0.02)", ("impactor.velocity", "impactor.gravity"): [1, 2]}
    design = design_of(SCENE, together, None, None, 0)
    assert design.shape == (2, 2) and [axis.name for axis in design.axes] == ["target.length", "impactor.velocity"]
    assert design.rows(1, 3) == [(1, 0.01, 2, 2), (2, 0.02, 1, 1)]


@pytest.mark.parametrize(
    "law, frozen",
    [
        ("normal(2,0.1)", stats.norm(2.0, 0.1)),
        ("uniform(1, 3)", stats.uniform(1.0, 2.0)),
        ("loguniform(1e3,1e6)", stats.loguniform(1e3, 1e6)),
        ("triangular(1,1.5,4)", stats.triang(0.5 / 3.0, 1.0, 3.0)),
        ("lognormal(2,0.3)", stats.lognorm(0.3, scale=2.0)),
        ("5%", stats.uniform(0.95 * SPEED, 0.1 * SPEED)),
        ("±5 %", stats.uniform(0.95 * SPEED, 0.1 * SPEED)),
        ("1..3", stats.uniform(1.0, 2.0)),
        ("1..3:log", stats.loguniform(1.0, 3.0)),
        ("1..1000", stats.loguniform(1.0, 1000.0)),  # as on a grid
        ("1..1000:linear", stats.uniform(1.0, 999.0)),
        (stats.weibull_min(2.0), stats.weibull_min(2.0)),
    ],
)
@pytest.mark.parametrize("sample", ["random", "lhs", "sobol"])
def test_values_drawn_have_the_distribution_that_is_asked_for(law, frozen, sample):
    drawn = np.array(points({"impactor.velocity": law}, sample, 2_000, seed=3))[:, 0]
    # of 2 000 values from the law itself, a distance of 0.05 is seen once in 10 000 times
    assert stats.kstest(drawn, frozen.cdf).statistic < 0.05
    assert (points({"impactor.velocity": law}, sample, 2_000, seed=3) == drawn[:, None]).all()
    assert (points({"impactor.velocity": law}, sample, 2_000, seed=4) != drawn[:, None]).any()


def test_a_latin_hypercube_has_one_value_in_each_share_of_each_key():
    vary = {"impactor.velocity": "uniform(0,1)", "target.length": "uniform(0,1)", "contact.law": ["hertz", "rigid"]}
    found = points(vary, "lhs", 40)
    for column in range(2):
        assert sorted(int(40.0 * row[column]) for row in found) == list(range(40))
    assert sum(row[2] == "hertz" for row in found) == 20


def test_whole_numbers_are_drawn_whole():
    design = design_of(solvers.load("figure-10.1"), {"method.modes": "3..9"}, "random", 500, 0)
    found = {row[0] for row in design.rows(0, 500)}
    assert found == set(range(3, 10)) and all(type(value) is int for value in found)


@pytest.mark.parametrize(
    "vary, sample, count, said",
    [
        ({}, None, None, "a distribution"),
        (None, None, None, "a distribution"),
        ({"impactor.velocity": []}, None, None, "values with commas"),
        ({"impactor.velocity": "1,,2"}, None, None, "values with commas"),
        ({"impactor.velocity": "(1,2"}, None, None, "values with commas"),
        ({"impactor.velocity": "1..3:4:cubic"}, None, None, "LOW..HIGH[:COUNT]"),
        ({"impactor.velocity": "1..3:4"}, "lhs", 5, "without a count"),
        ({"impactor.velocity": [1.0, math.nan]}, None, None, "finite numbers"),
        ({"impactor.velocity": "1,inf"}, None, None, "finite numbers"),
        ({"impactor.velocity": "1979-05-27,3"}, None, None, "finite numbers"),
        ({"impactor.velocity": [1 + 2j]}, None, None, "finite numbers"),
        ({5: [1]}, None, None, "a distribution"),
        ({"impactor.velocity": stats.uniform([1, 2], 2)}, "lhs", 5, "LOW..HIGH"),
        ({"impactor.velocity": "x%"}, "lhs", 3, "LOW..HIGH[:COUNT]"),
        ({"impactor.velocity": "3..1:4"}, None, None, "impactor.velocity"),
        ({"impactor.velocity": "1..3:1"}, None, None, "whole number from 2"),
        ({"impactor.velocity": "-1..3:4:log"}, None, None, "above zero"),
        ({"impactor.velocity": [(1, 2)]}, None, None, "1 values"),
        ({"a,b": [(1, 2, 3)]}, None, None, "2 values"),
        ({"a,b": [1], "b": [2]}, None, None, "each key once"),
        ({"a,,b": [1]}, None, None, "a distribution"),
        ({"impactor.velocity": "normal(1,0.1)"}, None, None, "sample 'random', 'lhs', 'sobol'"),
        ({"impactor.velocity": "normal(1)"}, "lhs", 5, "normal(mean, deviation)"),
        ({"impactor.velocity": "normal(1,-1)"}, "lhs", 5, "above zero"),
        ({"impactor.velocity": "uniform(2,2)"}, "lhs", 5, "uniform(low, high)"),
        ({"impactor.velocity": "triangular(3,2,4)"}, "lhs", 5, "rising order"),
        ({"impactor.velocity": "loguniform(-1,2)"}, "lhs", 5, "above zero"),
        ({"impactor.velocity": "uniform(1,inf)"}, "lhs", 5, "finite"),
        ({"impactor.velocity": "cauchy(1,2)"}, "lhs", 5, "LOW..HIGH"),
        ({"contact.law": "5%"}, "lhs", 5, "number other than zero"),
        ({"impactor.velocity": [1]}, None, 5, None),
        ({"impactor.velocity": [1]}, "grid", 5, "nothing for a grid"),
        ({"impactor.velocity": [1]}, "halton", 5, "'grid', 'random', 'lhs', 'sobol'"),
        ({"impactor.velocity": [1]}, "lhs", 0, "whole number from 1"),
        ({"impactor.velocity": [1]}, "lhs", MOST_POINTS + 1, "whole number from 1"),
        ({f"key{k}": list(range(1000)) for k in range(4)}, None, None, "at most 1e+07 points"),
    ],
)
def test_what_is_refused(vary, sample, count, said):
    if said is None:
        assert len(points(vary, sample, count)) == count
        return
    with pytest.raises(SceneError) as refused:
        design_of(SCENE, vary, sample, count, 0)
    assert said in str(refused.value)


def test_every_law_says_what_its_numbers_are():
    for name, numbers in LAWS.items():
        text = f"{name}({', '.join(map(str, range(1, 1 + len(numbers))))})"
        (axis,) = axes_of(SCENE, {"impactor.velocity": text}, drawn=True)
        assert axis.law is not None and axis.law.text == text
        assert np.isfinite(axis.law.quantiles(np.array([0.1, 0.5, 0.9]))).all()


@pytest.mark.parametrize(
    "vary, values",
    [
        ({"method.name": ["modal"], "method.modes": "5.5..8:4"}, {6, 7, 8}),
        ({"method.name": "modal", "method.modes": "0.5..3:4"}, {0, 1, 2, 3}),
        ({"method.name": ["modal"], "method.modes": "20%"}, set(range(40, 61))),
        ({"method.name": ["modal"], "method.modes": "normal(20, 1)"}, set(range(14, 27))),
    ],
)
def test_whole_numbers_are_those_of_the_method_that_is_varied(vary, values):
    """By default there are 50."""
    drawn = not any(":" in str(given) for given in vary.values())
    found = {row[1] for row in points(vary, "lhs" if drawn else None, 300 if drawn else None)}
    assert found <= values and all(type(value) is int for value in found)
    assert len(found) >= min(4, len(values)) - 1


def test_words_in_pairs_need_no_quotes():
    design = design_of(SCENE, {"method.name,method.modes": "(modal,20),(fe-modal, 10)"}, None, None, 0)
    assert design.rows(0, 2) == [("modal", 20), ("fe-modal", 10)]


def test_a_share_of_several_keys_is_one_of_each():
    chain = solvers.load("split-hopkinson")
    keys = ("target.rods.1.length", "target.rods.3.length")
    one, other = (number_of(chain, key) for key in keys)
    rows = np.array(design_of(chain, {keys: "10%"}, "lhs", 50, 0).rows(0, 50))
    assert rows[:, 0] / one == approx(rows[:, 1] / other, rel=1e-12)
    assert np.ptp(rows[:, 0] / one) > 0.18 and np.abs(rows[:, 0] / one - 1.0).max() < 0.1


def test_numbers_in_lists_of_a_scene_are_found():
    chain = solvers.load("split-hopkinson")
    assert number_of(chain, "target.rods.1.length") == chain.target.rods[0].length
    with pytest.raises(SceneError):
        number_of(chain, "target.rods.9.length")


@given(st.text(alphabet="(),.0123456789eE[]abc \"'=\n{}-", max_size=30))
def test_no_words_end_in_anything_but_values_or_a_refusal(written):
    try:
        assert isinstance(parse_values("key", written), list)
    except SceneError as refused:
        assert refused.key == "key"
