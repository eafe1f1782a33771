"""What every method says of a result that is not to be trusted as it stands: sentences with cause and remedy."""

import math
from collections.abc import Callable
from typing import Any

from .grazing import grazing_note, miscounted, one_front
from .scene import Scene, contact_time
from .solution import Solution

RESOLVED_BLOW = 1.5  # shortest periods known that a rigid blow on a rod must last for its contacts to be told apart
TOLD_BLOW = 5.0  # that it must last for its rebound to be right to 2 %; measured, mass ratios 5 to 100
RESOLVED_LAW = 2.5, 1.2  # that a contact by a law must last, and on rods HEAVY times the impactor: with less the peak
HEAVY = 10.0  # is off by 3 to 50 %, measured on rods of 0.3 to 30 times its mass
COARSE = 0.05  # of the speed of approach: a larger estimated error is told
STILL_TOUCHING = (
    "The bodies are still in contact at the end of the time solved: their velocities are not final; solve for longer."
)
NEVER_PART = (
    "The bodies are still in contact at the end of the time solved, as no wave comes back from a rod without end: the "
    "force fades and never ends. What is left of it changes the velocities by a millionth."
)

TOUCH_ON = (
    "The bodies touch again and again, ever more weakly, as no wave comes back from a rod without end. What is left "
    "changes the velocities by a millionth."
)


ENDS_EARLY = "do not trust its end"  # what every note says of a solution that could not be followed to its end


def ended_early(notes: list[str]) -> bool:
    """Whether a solution ended by itself before all was over: others that end so may agree with it, all wrong."""
    return any(ENDS_EARLY in note for note in notes)


def cut_short(bound: str) -> str:
    """Of a solution that ended by itself at a limit of its method, such as "4000000 steps"."""
    return (
        f"The solution stopped at its limit of {bound} before the bodies had parted for good: {ENDS_EARLY}; a "
        "shorter duration is solved whole."
    )


def bodies_that_bend(scene: Scene) -> list[Any]:
    """Which of both are beams."""
    return [body for body in (scene.impactor, scene.target) if body.kind == "beam"]


def doubts_of_a_rigid_blow(scene: Scene, period: float, count: int, kind: str) -> list[str]:
    """Where a mass leaves a rod or a beam in rigid contact sooner than `count` modes or elements, known down to a
    `period` [s], can tell.
    """
    if bodies_that_bend(scene):
        if scene.blow >= period:
            return []
        return [
            f"Bending waves slow down so light a mass within {scene.blow:.3g} s, too short for what is known down to a "
            f"period of {period:.3g} s only: there the beam is heavier than the mass and throws it back. Do not trust "
            "rebound and contacts: keep more modes or elements, or give the contact a law."
        ]
    if scene.blow >= RESOLVED_BLOW * period:
        return []
    needed = math.ceil(count * TOLD_BLOW * period / scene.blow)
    return [
        f"The blow fades within {scene.blow:.3g} s, which is too short for {kind} down to a period of {period:.3g} s:"
        f" do not trust its rebound and contacts; {needed} {kind} tell them to some 2 %, or use 'waves'."
    ]


def doubts_of_a_front(scene: Scene, period: float, count: int, kind: str) -> list[str]:
    """Where the contact law lets the force rise and fall faster in a rod than what is known down to a `period` [s]."""
    rods = [body for body in (scene.impactor, scene.target) if body.round_trip_time is not None]
    if scene.contact.NAME == "rigid" or not rods:
        return []
    touch = contact_time(scene.contact, scene.reduced_mass, scene.speed)
    share = RESOLVED_LAW[scene.mass_ratio >= HEAVY]
    if touch >= share * period:
        return []
    needed = math.ceil(count * share * period / touch)
    return [
        f"The contact by itself lasts {touch:.3g} s, too short for {kind} down to a period of {period:.3g} s: the peak "
        f"force and the front are blurred; {needed} {kind} would show them, or use 'waves'."
    ]


def general_doubts(
    solution: Solution, notes: list[str], whole: bool, remedy: str | None, knob: str | None
) -> list[str]:
    """What holds for every method. `notes`: what its own says; `whole`: solved until the bodies part; `remedy`: against
    contacts that it counts falsely, None where it cannot; `knob`: the option that makes it finer.
    """
    scene = solution.scene
    found = [doubt for body in bodies_that_bend(scene) for doubt in body.doubts()]
    if solution.peak_indentation is not None:
        found += scene.contact.limits(solution.peak_indentation, scene.impactor, scene.target)
    found += filter(None, [counted_twice(solution)])
    if remedy is not None:
        found += doubts_of_the_count(solution, whole, remedy)
    error = solution.diagnostics.get("estimated_error")
    trusted = not any("o not trust" in note for note in notes)  # which says more, or that it was cut short
    if error is not None and error >= COARSE and knob is not None and trusted:
        found.append(
            f"By its own estimate the final velocity is off by {100.0 * error:.2g} % of the speed of approach, too "
            f"coarse to be used: take more {knob}."
        )
    return found


def doubts_of_the_count(solution: Solution, whole: bool, remedy: str) -> list[str]:
    """Contacts missed or invented, as far as exact waves know them, and such as hang by a hair."""
    scene = solution.scene
    wrong = miscounted(scene, solution.contacts, solution.duration, remedy)
    if wrong is not None or not whole or not one_front(scene):
        return [] if wrong is None else [wrong]
    note = grazing_note(scene.mass_ratio, 1.0 if scene.target.fixed else -1.0)
    return [] if note is None else [note]


SLIGHT = 1e-6  # of the energy
TWICE = "Waves may be counted twice"


def counted_twice(solution: Solution) -> str | None:
    """Of damping in the contact of a body whose waves are solved for as well: what each takes away; None elsewhere.

    Source: thesis 7.3.1 and conclusion 6: a viscous force may stand for the waves that leave the contact, and then has
    no place beside a body in which they run.
    """
    scene, energy = solution.scene, solution.energy
    if not getattr(scene.contact, "damping", 0.0) or solution.peak_indentation is None:
        return None  # of the contact nothing is solved for but a restitution, if that
    parts = [part / energy["initial"] for part in (energy["dissipated"], _ringing(solution))]
    if min(parts) < SLIGHT:
        return None
    damped = any(body.damping for body in bodies_that_bend(scene))
    taker = "the law and the damping of the beam take" if damped else "the law takes"
    takes, stays = (f"{100.0 * part:.2g} %" for part in parts)
    return (
        f"{TWICE} (thesis 7.3.1): if the damping of this law stands for them, they are in the law "
        f"and in the bodies. Here {taker} {takes} of the energy and {stays} stay in the bodies as vibration."
    )


def _ringing(solution: Solution) -> float:
    """Energy of vibration at the end [J]."""
    impactor, found = solution.scene.impactor, solution.energy
    if impactor.time_unit is None:
        return found["target_vibration"]
    return found["target_vibration"] + found["impactor"] - 0.5 * impactor.mass * solution.impactor_velocity**2


def beside_elastic(solution: Solution, notes: list[str], elastic: Callable[[Solution], Solution]) -> list[str]:
    """The notes; where waves are counted twice, with what the elastic law gives: `elastic` solves the same by it."""
    told = counted_twice(solution)
    if told is None:
        return notes
    found = elastic(solution)
    if ended_early(found.notes):
        return notes
    velocities = f"{found.impactor_velocity:+.4g} m/s instead of {solution.impactor_velocity:+.4g} m/s"
    stays = 100.0 * _ringing(found) / found.energy["initial"]
    more = f" With the elastic law the impactor leaves at {velocities}, and {stays:.2g} % stay."
    return [note + more if note == told else note for note in notes]
