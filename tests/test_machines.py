"""The same figures and keys on other machines that can be had on this one: a share of `bench --only machines`."""

import pytest

from tests import machines

# None is chaotic, as the fixture asserts.
SCENES = "fixed-rod", "hammer-on-cantilever", "brick-off-centre", "four-bar", "trip-hammer"
ROUNDING = 1e-14  # relative, of what is computed before it is amplified as any change of what is given


@pytest.fixture(scope="module")
def own():
    return {name: machines.seen(name) for name in SCENES}


@pytest.fixture(scope="module")
def allowed(own):
    import solvers

    factors = {name: machines.sensitivity(solvers.load(name), own[name].figures) for name in SCENES}
    assert max(factors.values()) < machines.CHAOTIC
    return {name: ROUNDING * max(factor, 100.0) for name, factor in factors.items()}


@pytest.mark.slow
@pytest.mark.parametrize("name", machines.of_this_processor())
def test_scenes_give_the_same_on_another_machine(name, own, allowed):
    theirs = machines.measured(machines.of_this_processor()[name], SCENES)
    for scene, seen in own.items():
        assert theirs[scene].key == seen.key
        found, of = machines.difference(seen.figures, theirs[scene].figures)
        assert found <= allowed[scene], (scene, of)
