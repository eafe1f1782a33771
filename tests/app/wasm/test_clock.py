"""How the kernels of browsers ask the clock: often enough that none goes on for long once its time is over."""

from functools import cache

import pytest

from app.wasm.entry import INSTANTS
from app.wasm.modal_entries import STRIDE
from solvers.scenes.library import scene_of

from .answered import Answers, by_node
from .test_balances import given_of as given_of_balance
from .test_balances import random_impacts as balanced
from .test_chains import given_of as given_of_chain
from .test_chains import random_scenes as chains
from .test_compact import given_of as given_of_compact
from .test_compact import random_impacts as pressed
from .test_module import given_of, random_beam, random_march, random_scene, random_time, struck_by

LEFT, LOOKS = 7, 10  # impacts of each kind; times that the longest of these look at the clock, at least
INSTANTS_A_LOOK = 64  # at most, of what is drawn; of what takes longer fewer


@cache
def random_impacts() -> Answers:
    """Some of each kind."""
    through, marched = [(random_scene(), random_time()) for _ in range(LEFT)], [random_march() for _ in range(LEFT)]
    given = given_of(through, marched, [random_beam() for _ in range(LEFT)])
    given["rod"] = given["rod"][:LEFT]
    given["balance"] = [[given_of_balance(scene, method.solve(scene)), 0.0] for scene, method in balanced()[:LEFT]]
    given["chain"] = [given_of_chain(scene) for scene in chains()[:LEFT]]
    given["compact"] = [[*given_of_compact(scene), sine] for scene, sine in pressed()[:LEFT]]
    return given


@pytest.mark.browser  # needs Node
@pytest.mark.parametrize("share", [0.01, 0.5, 0.99])
def test_a_kernel_whose_time_is_over_is_left_and_the_next_answer_is_the_same(share):
    for kind, impacts in by_node(random_impacts(), share=share).items():
        for impact in impacts:
            allowed = int(share * (impact["looks"] - 2))
            assert impact["late"] and impact["until"] == allowed + 2, kind  # the first look begins, the last is late
            assert impact["again"] == impact["answer"], kind
        assert max(impact["looks"] for impact in impacts) > LOOKS, kind


@pytest.mark.browser  # needs Node
def test_a_march_looks_at_the_clock_after_so_many_steps():
    given = random_impacts()
    found = by_node({kind: given[kind] for kind in ("modes", "beam", "chain", "balance")}, share=0.0)
    for kind, impacts in found.items():
        for impact in impacts:
            answer = impact["answer"]
            steps = len(answer["force"]) if kind == "modes" else answer.get("steps", 0)
            assert impact["looks"] > steps / STRIDE, kind


@pytest.mark.browser  # needs Node
def test_of_a_rigid_rod_the_paths_look_at_the_clock_as_the_histories_do():
    """Those of a light mass take longer than all else."""
    for impact in by_node({"rod": [[beta, side] for beta in (50.0, 1e3) for side in (1, -1)]}, share=0.0)["rod"]:
        drawn = sum(len(set(impact["answer"][name])) for name in ("wave_time", "force_time"))
        assert impact["looks"] > drawn / INSTANTS_A_LOOK + INSTANTS / 16


@pytest.mark.browser  # needs Node
def test_every_contact_of_a_long_march_looks_at_the_clock():
    """When it ends is looked for in all steps behind it."""
    scene = scene_of("hammer-on-cantilever")
    struck, *_ = struck_by(scene, 10)
    given = [[{**struck, "duration": share * scene.time_unit}, "rigid", []] for share in (2.0, 5.0)]
    for impact in by_node({"beam": given}, share=0.0)["beam"]:
        answer = impact["answer"]
        assert len(answer["contacts"]) > LOOKS
        assert impact["looks"] > answer["steps"] / STRIDE + len(answer["contacts"])


@pytest.mark.browser  # needs Node
def test_what_stands_beside_two_compact_bodies_looks_at_the_clock():
    impacts = [(scene, sine) for scene, sine in pressed()[:60] if not sine]
    found = by_node({"compact": [[*given_of_compact(scene), sine] for scene, sine in impacts]}, share=0.0)["compact"]
    for (scene, _), impact in zip(impacts, found, strict=True):
        assert impact["looks"] > LOOKS, scene.table()
