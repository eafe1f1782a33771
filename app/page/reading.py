"""What strangers write is read by workers: scenes of their own, and values of bodies in links and beside records.

The event loop has what follows of it: choices, and `Facts` of scenes, which are known while somebody holds them.
"""

from collections.abc import Callable, Hashable
from typing import Any, NamedTuple

from solvers.jit.compiling import NotCompiled

from ..choices.bodies import is_key
from ..choices.choices import Choices
from ..choices.facts import Facts, facts_of, keep, known_facts
from ..choices.own import LONGEST, is_own
from ..jobs.loops import of_loop
from ..jobs.workers import Lost, Workers
from ..text.refusals import Refused, note, reason_of
from ..views.record import record_answer
from ..views.registry import VIEWS
from .address import from_address, opened_from_address, text_of

READ_SECONDS = 5.0  # of computing for an address or a scene; the longest that is known takes 2 s
Arguments = dict[str, list[bytes]]


class Taken(NamedTuple):
    """Of an address."""

    choices: dict[str, Any]
    opened: dict[str, Any]  # panels, and what is asked in them
    refused: list[dict[str, Any]]  # what of it cannot be, as notes
    facts: Facts | None = None  # of the scene, if that is the visitor's own


TAKEN: dict[str, Taken] = {}  # by session that is about to be made


def take(arguments: Arguments) -> Taken:
    """What can be used of an address, and why the rest cannot."""
    choices, refused = from_address(arguments)
    opened, refused_too = opened_from_address(arguments)
    name = _scene_in(arguments)
    return Taken(choices, opened, [*map(reason_of, (*refused, *refused_too))], facts_of(name) if name else None)


async def taken_by_worker(arguments: Arguments, who: Hashable) -> Taken:
    """The same; by a worker, if there is anything in it to be read."""
    name = _scene_in(arguments)
    facts = known_facts(name) if name else None
    if (facts or not name) and not any(map(is_key, arguments)):
        return take(arguments)
    try:
        taken = await by_worker(take, arguments, who=who)
    except (ValueError, Lost) as failure:
        return Taken({}, {}, [_why(failure)])
    return taken._replace(facts=keep(taken.facts) if taken.facts else None)


async def facts_by_worker(name: str, who: Hashable) -> Facts:
    """Of a scene of a visitor's own, as long as who asks holds them."""
    if (known := known_facts(name)) is not None:
        return known
    try:
        return keep(await by_worker(facts_of, name, who=who))
    except (ValueError, Lost) as failure:
        return keep(Facts(name, refused=_why(failure)))


async def by_worker(work: Callable, *arguments: Any, who: Hashable) -> Any:
    """Its result; what is not compiled yet is compiled there. Raises ValueError, for the visitor, or Lost."""
    start = of_loop(Workers).start
    try:
        return await start(work, *arguments, visitor=who, seconds=READ_SECONDS).answer
    except NotCompiled:
        return await start(work, *arguments, visitor=who, seconds=READ_SECONDS, compiled=False).answer


def chosen_in(arguments: Arguments) -> dict[str, Any]:
    """The choices in a query. Raises ValueError for the first that cannot be."""
    choices, refused = from_address(arguments)
    if refused:
        raise refused[0]
    return Choices(**choices).chosen()


def compared(content: bytes, arguments: Arguments) -> str:
    """A record beside the choices in a query. Raises ValueError for what cannot be."""
    return record_answer(content, chosen_in(arguments), arguments)


def depends_on(view: str, asked: dict[str, Any]) -> Hashable:
    """What the answer of a view depends on, of what was asked; None where the scene is none for it."""
    return next(each for each in VIEWS if each.name == view).depends_on(asked)


def _scene_in(arguments: Arguments) -> str:
    """The name of a scene of the visitor's own, or nothing."""
    name = text_of(arguments["scene"], LONGEST) if "scene" in arguments else ""
    return name if is_own(name) else ""


def _why(failure: Exception) -> dict[str, Any]:
    if isinstance(failure, Refused):
        return reason_of(failure)
    return note("serving.not-worked-out").table()
