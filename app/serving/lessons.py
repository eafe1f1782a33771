"""Lessons for the page as JSON: those that it lists, in the language of who asks, and those that are sent to it."""

import asyncio
import json
from collections.abc import Callable

from tornado.web import HTTPError, RequestHandler

from ..jobs.fair import Stranger
from ..jobs.loops import of_loop
from ..jobs.workers import GivenUp, Job, Workers
from ..lessons.document import LARGEST
from ..lessons.own import TRY_SECONDS, read_own, try_own
from ..lessons.record import lesson_record
from ..lessons.shipped import lesson_languages, shipped_lesson
from ..text.refusals import Refused
from .language import language_of
from .once import made_once
from .uploads import Upload

READ_SECONDS = 5.0  # of computing for a text; the worst that is known take 1.5 s
ONE_SOLVE = 2.0  # s of computing of the last solve, which may begin before the time for all of them is over


def lesson_text(name: str, language: str) -> str:
    """A lesson as JSON. Raises KeyError for a name of none."""
    found = lesson_record(shipped_lesson(name, language))
    return json.dumps(found, ensure_ascii=False, separators=(",", ":"))


def _answers(found: str) -> bool:
    """Whether all numbers that a lesson asks for are there: those of formulas are solved for with its scenes."""
    parts = [part for step in json.loads(found)["lesson"]["steps"] for part in step["parts"]]
    return all(part["answer"] is not None for part in parts if part["kind"] == "number")


class Lesson(RequestHandler):
    """What a lesson says; a browser keeps it, and asks whether it is still the same."""

    async def get(self, name: str) -> None:
        language = language_of(self.request, lesson_languages())
        self.set_header("Cache-Control", "no-cache")
        self.set_header("Vary", "Accept-Language, Cookie")
        self.set_header("Content-Type", "application/json")
        try:
            self.write(await made_once(lesson_text, name, language))
        except KeyError:
            raise HTTPError(404) from None

    head = get  # of which no body is sent


class OwnLesson(Upload):
    """A lesson of the visitor's own: read, its scenes tried for a while, and answered by the page's record of it, or by
    all that is wrong, by line. A visitor who leaves, or sends another one, ends it.
    """

    _job: Job | None = None

    def limit(self, size: int) -> None:
        if size > LARGEST:
            raise Refused("serving.lesson.large", size=-(-size // 1000), most=LARGEST // 1000)

    async def answered(self, content: bytes) -> str:
        language = language_of(self.request)
        try:
            found = await self._done(read_own, content, language, READ_SECONDS)
        except GivenUp:
            raise Refused("serving.lesson.slow", seconds=READ_SECONDS) from None
        if not found.startswith('{"lesson":'):
            return found
        try:
            tried = await self._done(try_own, content, language, TRY_SECONDS + ONE_SOLVE)
        except GivenUp:
            if not _answers(found):  # it cannot be asked without them
                raise Refused("serving.lesson.unsolved", seconds=TRY_SECONDS) from None
            tried = '{"whole":false}'
        known = json.loads(tried)
        return tried if {"problems", "lesson"} & known.keys() else f"{found[:-1]},{tried[1:]}"

    async def _done(self, work: Callable, content: bytes, language: str, seconds: float) -> str:
        who = Stranger("lessons", self.address)
        self._job = of_loop(Workers).start(work, content, language, visitor=who, seconds=seconds)
        try:
            return await self._job.answer
        except asyncio.CancelledError:  # nobody waits for it
            return "{}"

    def on_connection_close(self) -> None:
        super().on_connection_close()
        if self._job is not None:
            self._job.answer.cancel()
