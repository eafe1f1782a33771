"""Orders of convergence, fitted and asserted for every method, resolution and contact law: one table.

How smooth the contact force is limits the order in modes, those left out being a spring that follows slowly: a jump of
the force is missed by 1 / modes of a rod, a bend by modes^-2, a jump of its curvature by modes^-3. A mesh of a rod
smears a front over h^(2/3), with averaged mass over h^(4/5): that is what a jump is missed by, and its square what a
bend is, down to the order of the mesh itself, which is 2.
Waves by steps have their order in `test_waves`, beam frequencies and explicit kernels in the tests of their kernels.
"""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene
from solvers.methods import METHODS, Balance, FeModal, FeNodal, Modal, ModeSwitch, Waves
from tests.catalog import WITH_INDENTATION, T, contact_table, struck_beam, struck_rod

QUICK = {"estimate": False}
SHARP = Waves(tolerance=1e-12)
NEAR = 8  # neighbouring resolutions per level: where in a step a contact opens or yields is a matter of chance
SMOOTH = {"hertz", "power", "hunt-crossley", "lankarani-nikravesh"}  # no bend at first touch


class Case(NamedTuple):
    """A method with one resolution on scenes that differ by the law, and for each law the order in that resolution."""

    name: str
    at: Callable[[int], object]  # the method on a level
    resolution: str
    ladder: tuple[int, ...]
    orders: dict[str, float]
    exact: object  # the method that the others tend to, or what the figure tends to
    band: float
    scene: Callable[[str], Scene]
    duration: float | None = 6.0 * T
    figure: Callable[[solvers.Solution], float] = lambda solution: solution.impactor_velocity


def rod(support: str = "fixed", mass_ratio: float = 1.0) -> Callable[[str], Scene]:
    return lambda law: struck_rod(mass_ratio, support, contact_table(law, softness=3.0, restitution=0.6))


def beam(theory: str, mass_ratio: float = 1.0) -> Callable[[str], Scene]:
    """Soft enough for some contacts to be followed one by one."""

    def scene(law: str) -> Scene:
        return struck_beam(mass_ratio, contact_table(law, softness=150.0, restitution=0.6), theory=theory)

    return scene


def doubling(first: int, levels: int = 4) -> tuple[int, ...]:
    return tuple(first * 2**k for k in range(levels))


def every(order: float, **others: float) -> dict[str, float]:
    """The same for all laws but some (underscores for hyphens)."""
    return dict.fromkeys(WITH_INDENTATION, order) | {law.replace("_", "-"): own for law, own in others.items()}


def some(order: float, *laws: str) -> dict[str, float]:
    return dict.fromkeys(laws, order)


def in_steps(
    name: str, at: Callable[[int], object], orders: dict[str, float], support="fixed", first=2000
) -> list[Case]:
    """A few modes or elements, so that all of the error is that of the step; rigid faces until the front is back."""
    over, exact = (name, at, "steps", doubling(first)), at(50 * first)
    whole = Case(*over, orders, exact, 0.35, rod(support))
    return [whole, Case(*over, {"rigid": 2.0}, exact, 0.2, rod(support), 0.9 * T)]


def nodal(**options) -> Callable[[int], FeNodal]:
    return lambda n: FeNodal(elements=8, steps=n, **options, **QUICK)


def modes_of_a_mesh(**options) -> Callable[[int], FeModal]:
    return lambda n: FeModal(elements=8, modes=8, steps=n, **options, **QUICK)


def all_modes(steps: int, **options) -> Callable[[int], FeModal]:
    return lambda n: FeModal(elements=n, modes=2 * n, steps=steps, **options, **QUICK)


def few_modes(n: int) -> Modal:
    return Modal(modes=3, steps=n, **QUICK)


def many_modes(n: int) -> Modal:
    return Modal(modes=n, steps=40_000, **QUICK)


STEPS = [
    *in_steps("modal", few_modes, every(2.0)),
    *in_steps("modal", few_modes, some(2.0, "linear", "kelvin-voigt", "plastic-power"), "free"),
    *in_steps("fe-nodal", nodal(), every(2.0), first=4000),
    # at first touch a force that jumps is felt from the end of the step on
    *in_steps("fe-nodal", nodal(scheme="central-difference"), every(2.0, kelvin_voigt=1.0)),
    # the status is wrong for a part of a step, in which the spring hardly presses
    *in_steps("fe-nodal", nodal(status="frozen"), {"linear": 2.0}),
    *in_steps("fe-modal", modes_of_a_mesh(), every(2.0)),
    # the rule of 'fe-nodal' in other coordinates
    *in_steps(
        "fe-modal", modes_of_a_mesh(scheme="newmark"), some(2.0, "hertz", "kelvin-voigt", "plastic-power"), first=4000
    ),
]

RODS = [
    # a stretch of length h is a polynomial of order 7 in h, and h goes as tolerance^(1/6); stretches end at events
    Case("waves", lambda n: Waves(tolerance=1.0 / n), "tolerance", (10**2, 10**4, 10**6, 10**8), every(7 / 6), SHARP,
         0.5, rod()),
    # the curvature of the force jumps where it starts or turns, which for plastic laws more modes shift; the force of
    # Kelvin and Voigt itself jumps, and ends in a bend
    Case("modal", many_modes, "modes", doubling(6), every(3.0, kelvin_voigt=2.0), SHARP, 0.8, rod()),
    Case("fe-nodal", lambda n: FeNodal(elements=n, steps=6000, **QUICK), "elements", doubling(6),
         every(2.0, kelvin_voigt=4 / 3), SHARP, 0.5, rod()),
    Case("fe-modal", all_modes(4000), "elements", doubling(6), every(2.0, kelvin_voigt=4 / 3), SHARP, 0.5, rod()),
]  # fmt: skip

# Rigid faces: on a free rod the front parts them by a jump, on a fixed one the force fades to zero in a bend.
RIGID_FACES = [
    Case("modal", lambda n: Modal(modes=n, steps=20_000, **QUICK), "modes", doubling(8, 5), {"rigid": 1.0}, SHARP, 0.25,
         rod("free")),
    # between a bend and a jump, as the faces chatter on the modes left out
    Case("modal", lambda n: Modal(modes=n, steps=20_000, **QUICK), "modes", doubling(8, 5), {"rigid": 1.5}, SHARP, 0.3,
         rod("fixed", 0.3)),
    Case("mode-switch", lambda n: ModeSwitch(modes=n, **QUICK), "modes", doubling(8, 5), {"rigid": 1.0}, SHARP, 0.05,
         rod("free")),
    Case("mode-switch", lambda n: ModeSwitch(modes=n, **QUICK), "modes", doubling(8, 5), {"rigid": 2.0}, SHARP, 0.3,
         rod("fixed", 3.0)),
    Case("fe-nodal", lambda n: FeNodal(elements=n, steps=8000, **QUICK), "elements", doubling(10, 5), {"rigid": 2 / 3},
         SHARP, 0.1, rod("free")),
    # the local stiffness is that of one element, whose compliance falls as 1 / elements
    Case("fe-nodal", lambda n: FeNodal(elements=n, steps=8000, **QUICK), "elements", doubling(20), {"rigid": 1.0},
         SHARP, 0.2, rod("fixed", 3.0)),
    Case("fe-nodal", lambda n: FeNodal(elements=n, scheme="central-difference", **QUICK), "elements", doubling(10, 5),
         {"rigid": 1.0}, SHARP, 0.2, rod("fixed", 3.0)),
    Case("fe-modal", lambda n: FeModal(elements=n, steps=20_000, **QUICK), "elements", doubling(10), {"rigid": 4 / 5},
         SHARP, 0.1, rod("free", 0.3)),
    Case("fe-modal", lambda n: FeModal(elements=n, steps=20_000, **QUICK), "elements", doubling(15), {"rigid": 2.0},
         SHARP, 0.5, rod("fixed", 1.0)),
]  # fmt: skip


def lost(solution: solvers.Solution) -> float:
    return solution.energy["dissipated"]


def first_impact(solution: solvers.Solution) -> float:
    return solution.motion.impulses[1][0]


def first_parting(solution: solvers.Solution) -> float:
    return solution.contacts[0].end


# Velocities after many balances do not converge, for restitution 1 nothing does; what must vanish does.
BALANCES = [
    # each balance loses what the node or the highest modes carry
    Case("balance", lambda n: Balance(elements=n, restitution=0.0, **QUICK), "elements", doubling(6), {"rigid": 1.0},
         0.0, 0.2, rod(), figure=lost),
    Case("balance", lambda n: Balance(elements=n, restitution=0.5, **QUICK), "elements", doubling(6), {"rigid": 1.0},
         0.0, 0.2, rod(), figure=lost),
    Case("balance", lambda n: Balance(modes=n, restitution=0.0, **QUICK), "modes", doubling(6), {"rigid": 1.0},
         0.0, 0.2, rod(), figure=lost),
    Case("balance", lambda n: Balance(modes=n, restitution=0.0, **QUICK), "modes", doubling(6), {"rigid": 1.0},
         0.0, 0.1, beam("euler-bernoulli"), 1e-4, figure=first_impact),
]  # fmt: skip

THREE_CONTACTS = 3e-3  # [s]
EULER = ("euler-bernoulli", doubling(3), doubling(4), 96)
TIMOSHENKO = ("timoshenko", doubling(12), doubling(6), 144)


def on_beams(theory, modes, elements, finest, in_modes, band, in_elements):
    many = Modal(modes=4 * modes[-1], steps=60_000, **QUICK)
    made, mesh = all_modes(8000), lambda n: FeNodal(elements=n, steps=8000, **QUICK)
    return [
        Case("modal", lambda n: Modal(modes=n, steps=60_000, **QUICK), "modes", modes, in_modes, many, band,
             beam(theory), THREE_CONTACTS),
        Case("modal", lambda n: Modal(modes=8, steps=n, **QUICK), "steps", doubling(8000),
             some(2.0, "hertz", "hunt-crossley", "plastic-power"), Modal(modes=8, steps=400_000, **QUICK), 0.3,
             beam(theory), THREE_CONTACTS),
        Case("fe-modal", made, "elements", elements, some(in_elements["hertz"], "hertz"), made(finest), 0.5,
             beam(theory), THREE_CONTACTS),
        Case("fe-nodal", mesh, "elements", elements, in_elements, mesh(finest), 0.5, beam(theory),
             THREE_CONTACTS),
    ]  # fmt: skip


BEAMS = [
    # frequencies go as modes^2, so that a jump of the curvature leaves modes^-7
    *on_beams(*EULER, some(7.0, "linear", "hertz", "hunt-crossley"), 1.0, some(4.0, "hertz", "plastic-power")),
    # shear waves are as those of rods, and a straight element of constant shear is of second order
    *on_beams(*TIMOSHENKO, some(3.0, "linear", "hertz", "power"), 0.75, some(2.0, "hertz", "plastic-power")),
    # each contact ends with the echo of the highest mode; later ones, and the rebound, are ill-conditioned
    Case("mode-switch", lambda n: ModeSwitch(modes=n, **QUICK), "modes", doubling(6), {"rigid": 1.0}, 0.0, 0.25,
         beam("euler-bernoulli"), 1e-3, figure=first_parting),
]  # fmt: skip

CASES = [*STEPS, *RODS, *RIGID_FACES, *BALANCES, *BEAMS]


def named() -> Iterator:
    for case in CASES:
        given = case.at(case.ladder[0])
        words = [getattr(given, option, "") for option in ("scheme", "status")]
        for law in case.orders:
            target = case.scene(law).target
            reported = [case.name, *words, case.resolution, getattr(target, "theory", target.support), law]
            yield pytest.param(case, law, id="-".join(filter(None, reported)))


@pytest.mark.slow
@pytest.mark.parametrize("case, law", named())
def test_order(case, law):
    scene = case.scene(law)

    def figure(method) -> float:
        return case.figure(method.solve(scene, case.duration))

    def error(level: int) -> float:
        near = (
            1
            if case.resolution in ("steps", "elements") and law in SMOOTH
            else NEAR
            if case.resolution == "steps"
            else 3
        )
        found = [figure(case.at(level + level * k // (2 * near))) for k in range(near)]
        return math.sqrt(np.mean((np.array(found) - exact) ** 2))

    exact = case.exact if isinstance(case.exact, float) else figure(case.exact)
    errors = [error(level) for level in case.ladder]
    order = -np.polyfit(np.log(case.ladder), np.log(errors), 1)[0]
    assert order == approx(case.orders[law], abs=case.band), errors


def test_every_resolution_of_every_method_is_here_with_every_law():
    reported = {(case.name, case.resolution, law) for case in CASES for law in case.orders}
    reported |= {("waves", "steps", "rigid"), ("waves", "tolerance", "rigid")}  # see `test_waves`; exact whatever it is
    scenes = {law: struck_rod(contact=contact_table(law)) for law in solvers.LAWS}
    for name, method in METHODS.items():
        for resolution in method.RESOLUTIONS:  # closed forms have none
            coarse = method.read({resolution: 100}) if resolution != "tolerance" else method.read({})
            able = {(name, resolution, law) for law, scene in scenes.items() if coarse.refusal(scene) is None}
            assert {one for one in able if name != "balance" or one[2] == "rigid"} <= reported  # which knows no law


def test_the_law_has_no_say_in_balances():
    impacts = [struck_rod(contact=contact_table(law)) for law in ("rigid", "hertz", "plastic-power")]
    found = {
        Balance(elements=20, restitution=0.5, **QUICK).solve(impact, 2.0 * T).impactor_velocity for impact in impacts
    }
    assert len(found) == 1
