"""Measured records: how they lie on a solution."""

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import SceneError
from solvers.records.record import Record, align, as_stress, expected, rod_at
from tests.catalog import SCENES

BALL = solvers.solve(SCENES["bronze-rod-steel-ball"], duration=1.5e-3)
ROD = BALL.scene.target
STEP = 1e-6


def measured(x=1.0, kind="strain", shift=0.0, scale=1.0, noise=0.0):
    """What a gauge at x would have written, its clock late by `shift` and its values too large by `scale`."""
    time = np.arange(-50, 1_000) * STEP
    values = expected(BALL, kind, time, x)
    values += noise * np.abs(values).max() * np.random.default_rng(2).normal(size=values.size)
    return Record(time + shift, scale * values, kind)


def test_strain_is_positive_in_tension_and_stress_in_compression():
    rod, after_front = ROD, np.array([1.05 / ROD.wave_speed])
    stress, strain, force = (expected(BALL, kind, after_front, 1.0)[0] for kind in ("stress", "strain", "force"))
    assert stress > 0.0 > strain
    assert strain == approx(-stress / rod.material.young) and force == approx(stress * rod.area)
    for kind in ("strain", "stress", "force"):
        assert as_stress(Record(after_front, expected(BALL, kind, after_front, 1.0), kind), rod) == approx(stress)


def test_a_gauge_sees_nothing_before_the_impact_and_nothing_is_known_after_the_solution():
    found = expected(BALL, "strain", np.array([-1.0, -1e-9, 0.5 / ROD.wave_speed, 1.0]), 1.0)
    assert found[:3].tolist() == [0.0, 0.0, 0.0] and np.isnan(found[3])


def test_without_a_place_it_is_the_contact():
    time = np.linspace(0.0, 1e-4, 30)
    for x in (None, 0.0):
        assert expected(BALL, "force", time, x) == approx(BALL.motion.force(time))
        assert expected(BALL, "stress", time, x) == approx(BALL.motion.force(time) / ROD.area)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["strain", "stress", "force"])
@pytest.mark.parametrize("shift, scale", [(0.0, 1.0), (123.4567e-6, 0.5), (-3.3e-4, 2.0), (1.0, 1e3)])
def test_a_moved_record_is_put_back(kind, shift, scale):
    found = align(measured(1.0, kind, shift, scale), BALL, 1.0)
    assert found.shift == approx(-shift, abs=0.01 * STEP)
    assert found.scale == approx(1.0 / scale, rel=1e-4)
    assert found.residual.relative < 1e-3  # the model is straight between its points, half a step apart
    assert found.residual.samples == 1_050


def test_a_shift_that_is_given_is_kept():
    found = align(measured(1.0, shift=2e-5, scale=0.5), BALL, 1.0, shift=-3e-5)
    assert found.shift == -3e-5
    assert found.residual.relative > 0.05  # ten microseconds off a pulse of 115
    right = align(measured(1.0, shift=2e-5, scale=0.5), BALL, 1.0, shift=-2e-5)
    assert right.scale == approx(2.0, rel=1e-4)


def test_noise_moves_it_by_less_than_a_sample():
    found = align(measured(1.0, shift=2e-5, noise=0.03), BALL, 1.0)
    assert found.shift == approx(-2e-5, abs=STEP)
    assert found.scale == approx(1.0, abs=0.01)
    record = measured(1.0, noise=0.03)
    signal = expected(BALL, "strain", record.time, 1.0)
    noise = 0.03 * np.abs(signal).max() * np.sqrt(record.time.size) / np.linalg.norm(signal)
    assert found.residual.relative == approx(noise, rel=0.1)  # what is left is the noise


def test_a_rigid_impact_with_its_jumps_is_put_back_to_a_step():
    solution = solvers.solve(solvers.load("fixed-rod"))
    time = np.linspace(-2e-5, solution.duration, 900)
    record = Record(time + 1e-4, expected(solution, "force", time), "force")
    found = align(record, solution)
    assert found.shift == approx(-1e-4, abs=record.step)
    assert found.residual.relative < 0.1


def test_residual_of_a_known_misfit():
    time = np.linspace(0.0, 1.0, 101)
    record = Record(time, 1.1 * np.sin(time), "force")
    found = record.residual(time, np.sin(time))
    assert (found.relative, found.greatest, found.samples) == (approx(0.1), approx(0.1), 101)
    # zero before the solution, not compared after it
    later = Record(time - 0.5, np.where(time < 0.5, 0.0, np.sin(time - 0.5)), "force").residual(
        time[:26], np.sin(time[:26])
    )
    assert later.relative == approx(0.0, abs=1e-12) and later.samples == 76


def test_shifting_scaling_and_resampling_leave_the_original_alone():
    record = measured()
    moved = record.shifted(1e-5).scaled(-2.0)
    assert moved.time == approx(record.time + 1e-5) and moved.values == approx(-2.0 * record.values)
    assert record.values is not moved.values and moved.kind == "strain"
    coarse = record.resampled(record.time[::10])
    assert coarse.values == approx(record.values[::10])
    assert record.at(np.array([-1.0, record.time[5]])) == approx([0.0, record.values[5]])
    assert np.isnan(record.at(np.array([1.0]))[0])


@pytest.mark.parametrize("by", [np.nan, np.inf, "far"])
def test_shifts_and_scales_that_are_none_are_refused(by):
    with pytest.raises(SceneError, match="shift"):
        measured().shifted(by)
    with pytest.raises(SceneError, match="scale"):
        measured().scaled(by)


@pytest.mark.parametrize("times", [[0.0], [1.0, 0.0], [0.0, 2e-3], [-1e-3, 0.0]])
def test_resampling_stays_within_the_record(times):
    with pytest.raises(SceneError, match="times: got"):
        measured().resampled(np.array(times))


def test_a_record_that_never_changes_or_never_meets_the_solution_is_refused():
    time = np.linspace(0.0, 1e-3, 50)
    with pytest.raises(SceneError, match="values that change"):
        align(Record(time, np.full(50, 3.0), "force"), BALL)
    with pytest.raises(SceneError, match="where the solution is known"):
        Record(time + 1.0, np.sin(time), "force").residual(time, np.sin(time))


def test_a_force_of_the_wrong_sign_is_refused_with_the_remedy():
    time = np.linspace(0.0, 1.2e-4, 100)
    with pytest.raises(SceneError, match="turn it by sign -1"):
        align(Record(time, -BALL.motion.force(time), "force"), BALL)


def test_gauges_sit_on_rods():
    compact = solvers.load("fixed-rod").replace(
        {"target": {"kind": "stop"}, "contact": {"law": "linear", "stiffness": 1e8}}
    )
    solution = solvers.solve(compact, "quasi-static")
    time = np.linspace(0.0, solution.duration, 20)
    assert expected(solution, "force", time) == approx(solution.motion.force(time))
    with pytest.raises(SceneError, match="only where the target is a rod"):
        expected(solution, "strain", time)
    with pytest.raises(SceneError, match="at: got 2"):
        expected(BALL, "strain", time, 2.0)
    with pytest.raises(SceneError, match="only where the target is a rod"):
        expected(solvers.solve(solvers.load("note-rod")), "force", time)


def test_the_rod_of_a_chain_in_which_a_gauge_sits():
    chain = SCENES["fixed-rod"].replace(
        {"target": {"kind": "rods", "rods": [
            {"length": 0.5, "section": {"radius": 0.01}, "material": "steel"},
            {"length": 1.0, "section": {"radius": 0.02}, "material": "bronze"},
        ]}}
    ).target  # fmt: skip
    names = [rod_at(chain.rods, x).material for x in (0.1, 0.6, 1.5)]
    assert names == [chain.rods[0].material, chain.rods[1].material, chain.rods[1].material]


def test_a_ringing_rod_is_not_taken_for_itself_a_period_later():
    time = np.linspace(0.0, 10.0, 4001)
    ringing = (1.0 + 0.02 * time) * np.sin(2.0 * np.pi * time) ** 3  # whose product with itself grows with the shift
    kept = time <= 4.0
    found = Record(time[kept] + 0.3, ringing[kept], "force").aligned(time, ringing)
    assert found.shift == pytest.approx(-0.3, abs=2.5e-5)  # a hundredth of a step
    assert found.scale == pytest.approx(1.0, abs=1e-6)
