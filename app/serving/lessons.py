"""Lessons for the page: each as JSON, in the language of who asks if there is a translation."""

import json
from functools import cache

from tornado.web import HTTPError, RequestHandler

from solvers.text.catalogue import SOURCE

from ..lessons.record import lesson_record
from ..lessons.shipped import lesson_files, shipped_lesson
from .language import language_of

LANGUAGES = {SOURCE} | {path.name.split(".")[1] for path in lesson_files() if path.name.count(".") == 2}


@cache
def lesson_text(name: str, language: str) -> str:
    """A lesson as JSON, read once. Raises KeyError for a name of none."""
    found = lesson_record(shipped_lesson(name, language))
    return json.dumps(found, ensure_ascii=False, separators=(",", ":"))


class Lesson(RequestHandler):
    """What a lesson says; a browser keeps it, and asks whether it is still the same."""

    def get(self, name: str) -> None:
        language = language_of(self.request, LANGUAGES)
        self.set_header("Cache-Control", "no-cache")
        self.set_header("Vary", "Accept-Language, Cookie")
        self.set_header("Content-Type", "application/json")
        try:
            self.write(lesson_text(name, language))
        except KeyError:
            raise HTTPError(404) from None

    head = get  # of which no body is sent
