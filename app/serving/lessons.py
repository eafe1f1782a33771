"""Lessons for the page: each as JSON, in the language of who asks if there is a translation."""

import json
from functools import cache

from tornado.web import HTTPError, RequestHandler

from solvers.text.catalogue import SOURCE

from ..lessons.record import lesson_record
from ..lessons.shipped import lesson_files, shipped_lesson

MOST_ACCEPTED = 20  # languages that a browser may name
LANGUAGES = {SOURCE} | {path.name.split(".")[1] for path in lesson_files() if path.name.count(".") == 2}


def language_for(accepted: str) -> str:
    """The language that lessons are given in, of those that a browser accepts, the dearest first."""
    known = {language.lower(): language for language in LANGUAGES}
    for part in accepted.lower().split(",")[:MOST_ACCEPTED]:
        wanted = part.partition(";")[0].strip()
        for tag in (wanted, wanted.partition("-")[0]):
            if tag in known:
                return known[tag]
    return SOURCE


@cache
def lesson_text(name: str, language: str) -> str:
    """A lesson as JSON, read once. Raises KeyError for a name of none."""
    found = lesson_record(shipped_lesson(name, language))
    return json.dumps(found, ensure_ascii=False, separators=(",", ":"))


class Lesson(RequestHandler):
    """What a lesson says; a browser keeps it, and asks whether it is still the same."""

    def get(self, name: str) -> None:
        asked = self.get_query_argument("language", "")
        language = language_for(asked or self.request.headers.get("Accept-Language", ""))
        self.set_header("Cache-Control", "no-cache")
        self.set_header("Vary", "Accept-Language")
        self.set_header("Content-Type", "application/json")
        try:
            self.write(lesson_text(name, language))
        except KeyError:
            raise HTTPError(404) from None

    head = get  # of which no body is sent
