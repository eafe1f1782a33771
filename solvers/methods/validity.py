"""What every method says of a result that is not to be trusted as it stands: notes with cause and remedy."""

import math
from collections.abc import Callable

from ..bodies import Bending, FlexiblePendulum
from ..contact.duration import contact_time
from ..contact.protocol import Damped
from ..scene import Scene
from ..solution.solution import Solution
from ..text.notes import Note, Severity
from .grazing import grazing_note, miscounted, one_front

# Shortest periods known that a rigid impact on a rod must last, for its contacts to be resolved and for its rebound
# to be right to 2 %. Measured at mass ratios 5 to 100; with smaller ones wrong answers pass without a note.
MIN_PERIODS_OF_A_CONTACT, MIN_PERIODS_OF_A_REBOUND = 1.5, 5.0
# Shortest periods known that a contact by a law must last; also on rods HEAVY_ROD_RATIO times the impactor. With less
# the peak force is off by 3 to 50 %, measured on rods of 0.3 to 30 times its mass.
MIN_PERIODS, MIN_PERIODS_HEAVY_ROD, HEAVY_ROD_RATIO = 2.5, 1.2, 10.0
MAX_TRUSTED_ERROR = 0.05  # of the speed of approach; a larger one is reported
# As estimated from other resolutions: twice the true error and more in half of all random impacts.
MAX_TRUSTED_ESTIMATE = 0.1
MAX_RESIDUAL = 1e-3  # of the energy and of the momentum at first: with more something is missing in the figures
# Notes that say what a method itself takes from them.
EXPLAINED = {"cut-short", "energy-changed", "energy-drifts", "fronts-unresolved", "loss-of-steps"}
EXPLAINED |= {"half-sine", "impulse-as-printed", "switching-impulse", "switching-ill-conditioned"}
STILL_TOUCHING = Note("still-touching", Severity.WARNING)
NEVER_PART = Note("contact-fades-for-ever", Severity.REMARK)
TOUCH_ON = Note("touches-for-ever", Severity.REMARK)
CUT_SHORT = "cut-short"


def ended_early(notes: list[Note]) -> bool:
    """Whether a solution ended by itself before all was over: others that end so may agree with it, all wrong."""
    return any(note.code == CUT_SHORT for note in notes)


def cut_short(limit: float, kind: str, reached: float | None = None, wanted: float | None = None) -> Note:
    """Of a solution that ended by itself at a limit of its method: so many steps, balances, pieces or trips; `reached`
    [s] of the time `wanted` [s], where one was.
    """
    asked = wanted is not None
    return Note("cut-short", Severity.INVALID, limit=limit, kind=kind, asked=asked, reached=reached, wanted=wanted)


def bodies_that_bend(scene: Scene) -> list[Bending]:
    """Which of both are beams."""
    return [body for body in (scene.impactor, scene.target) if isinstance(body, Bending)]


def notes_on_rigid_impact(scene: Scene, period: float, count: int, kind: str) -> list[Note]:
    """Where a mass leaves a rod or a beam in rigid contact sooner than `count` modes or elements, known down to a
    `period` [s], can resolve.
    """
    if bodies_that_bend(scene):
        if scene.halting_time >= period:
            return []
        return [Note("impact-unresolved-on-beam", Severity.INVALID, lasts=scene.halting_time, period=period)]
    if scene.halting_time >= MIN_PERIODS_OF_A_CONTACT * period:
        return []
    needed = math.ceil(count * MIN_PERIODS_OF_A_REBOUND * period / scene.halting_time)
    return [
        Note("impact-unresolved", Severity.INVALID, lasts=scene.halting_time, kind=kind, period=period, needed=needed)
    ]


def notes_on_front(scene: Scene, period: float, count: int, kind: str) -> list[Note]:
    """Where the contact law lets the force rise and fall faster in a rod than what is known down to a `period` [s]."""
    rods = [body for body in (scene.impactor, scene.target) if body.round_trip_time is not None]
    if scene.rigid_contact or not rods:
        return []
    touch = contact_time(scene.contact, scene.reduced_mass, scene.speed)
    periods = MIN_PERIODS_HEAVY_ROD if scene.mass_ratio >= HEAVY_ROD_RATIO else MIN_PERIODS
    if touch >= periods * period:
        return []
    needed = math.ceil(count * periods * period / touch)
    missed = missed_dashpot(scene, touch, period)
    if missed > MAX_TRUSTED_ERROR:
        values: dict = {"lasts": touch, "kind": kind, "period": period, "needed": needed, "missed": missed}
        return [Note("rebound-unresolved", Severity.INVALID, **values)]
    return [Note("front-unresolved", Severity.WARNING, lasts=touch, kind=kind, period=period, needed=needed)]


def missed_dashpot(scene: Scene, touch: float, period: float) -> float:
    """About what a contact by a law with a rod, shorter than any `period` [s] known, is off by, of the impact speed.

    What is left out meets it as a spring; a long rod is a dashpot, F / Z, and takes pi^2 / 2 m / (Z t) of the speed
    from a mass on a spring that swings back in t. The square, by which that falls to nothing as t comes up to the
    period, is fitted: to 200 impacts with 5 to 100 modes at mass ratios 10 to 5000 by all laws; 0.5 to 1.4 times the
    true error of nine in ten.
    """
    share = min(0.5 * math.pi**2 * scene.halting_time / touch, 1.0) if math.isfinite(scene.halting_time) else 0.0
    return share * max(1.0 - touch / period, 0.0) ** 2


def general_notes(
    solution: Solution,
    notes: list[Note],
    whole: bool,
    cause: str | None,
    resolution: str | None,
    trusted_error: float = MAX_TRUSTED_ESTIMATE,
) -> list[Note]:
    """What holds for every method. `notes`: what its own says; `whole`: solved until the bodies part; `cause`: why it
    may count contacts falsely, None where it cannot; `resolution`: the option that makes it finer; `trusted_error`: up
    to which an estimated error is not reported.
    """
    scene = solution.scene
    found = [note for body in (scene.impactor, scene.target) for note in body.notes()]
    if solution.peak_indentation is not None:
        found += scene.contact.limits(solution.peak_indentation, scene.impactor, scene.target)
    found += filter(None, [counted_twice(solution)])
    if cause is not None:
        found += notes_on_count(solution, whole, cause)
    open_books = [] if resolution == "steps" else _open_books(solution, notes)  # coarse steps lose some
    found += open_books
    notes = [*notes, *open_books]
    error = solution.diagnostics.get("estimated_error")
    trusted = not any(note.severity is Severity.INVALID for note in notes)  # which says more, or that it was cut short
    if error is not None and error >= trusted_error and resolution is not None and trusted:
        own = "links" if scene.target.own_modes else "pendulum" if isinstance(scene.impactor, FlexiblePendulum) else ""
        if own and resolution == "modes":
            found.append(Note("own-modes-coarse", Severity.WARNING, error=error, body=own))
        else:
            found.append(Note("velocity-coarse", Severity.WARNING, error=error, resolution=resolution))
    return found


def _open_books(solution: Solution, notes: list[Note]) -> list[Note]:
    """That energy or momentum do not add up, and why, where no other note says so. Each part is found by itself, so
    that what is left is what the method leaves out.
    """
    if any(note.code in EXPLAINED for note in notes):
        return []
    sizes = {name: abs(solution.diagnostics.get(f"{name}_error") or 0.0) for name in ("energy", "momentum")}
    frozen = next((note.values["whole"] / 100.0 for note in notes if note.code == "configuration-frozen"), 0.0)
    if max(sizes.values()) <= max(MAX_RESIDUAL, min(frozen, MAX_TRUSTED_ERROR)):
        return []
    cause = "turns" if frozen else "other"
    return [Note("books-open", Severity.INVALID, cause=cause, **sizes)]


def notes_on_count(solution: Solution, whole: bool, cause: str) -> list[Note]:
    """Contacts missed or invented, as far as exact waves know them, and such as hang by a hair."""
    scene = solution.scene
    wrong = miscounted(scene, solution.contacts, solution.duration, cause)
    if wrong is not None or not whole or not one_front(scene):
        return [] if wrong is None else [wrong]
    note = grazing_note(scene.mass_ratio, 1.0 if scene.target.fixed else -1.0)
    return [] if note is None else [note]


MIN_REPORTED_ENERGY = 1e-6  # share of it that damping or vibration takes; less is not reported
TWICE = "waves-counted-twice"


def counted_twice(solution: Solution) -> Note | None:
    """Of damping in the contact of a body whose waves are solved for as well: what each takes away; None elsewhere.

    Source: thesis 7.3.1 and conclusion 6: a viscous force may stand for the waves that leave the contact, and then has
    no place beside a body in which they run.
    """
    scene = solution.scene
    if not (scene.contact.LOSSY and isinstance(scene.contact, Damped) and scene.contact.damping):
        return None
    if solution.peak_indentation is None:
        return None  # of the contact nothing is solved for but a restitution, if that
    energy = solution.energy
    parts = [part / energy["initial"] for part in (energy["dissipated"], _ringing(solution))]
    if min(parts) < MIN_REPORTED_ENERGY:
        return None
    damped = any(body.damping for body in bodies_that_bend(scene))
    takes, stays = (100.0 * part for part in parts)
    return Note(
        "waves-counted-twice",
        Severity.WARNING,
        damped=damped,
        takes=takes,
        stays=stays,
        compared=False,
        velocity=None,
        elastic=None,
        elastic_stays=None,
    )


def _ringing(solution: Solution) -> float:
    """Energy of vibration at the end [J]."""
    impactor, found = solution.scene.impactor, solution.energy
    if impactor.time_unit is None:
        return found["target_vibration"]
    return found["target_vibration"] + found["impactor"] - 0.5 * impactor.mass * solution.impactor_velocity**2


def beside_elastic(solution: Solution, notes: list[Note], elastic: Callable[[Solution], Solution]) -> list[Note]:
    """The notes; where waves are counted twice, with what the elastic law gives: `elastic` solves the same by it."""
    if counted_twice(solution) is None:
        return notes
    found = elastic(solution)
    if ended_early(found.notes):
        return notes
    more = {
        "compared": True,
        "velocity": solution.impactor_velocity,
        "elastic": found.impactor_velocity,
        "elastic_stays": 100.0 * _ringing(found) / found.energy["initial"],
    }
    return [Note(note.code, note.severity, **note.values | more) if note.code == TWICE else note for note in notes]
