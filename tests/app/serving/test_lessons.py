"""Lessons as the browser fetches them."""

import json
import urllib.error
import urllib.request

import pytest

from app.lessons.record import lesson_record
from app.lessons.shipped import lesson_languages, lesson_names, shipped_lesson
from app.text.catalogues import language_for

from ...patience import SECONDS


def fetched(server: str, address: str, **headers: str):
    asked = urllib.request.Request(f"http://{server}/lessons/{address}", headers=headers)
    return urllib.request.urlopen(asked, timeout=SECONDS)


@pytest.mark.parametrize("name", lesson_names())
def test_a_lesson_is_sent_as_it_is_read_and_again_only_if_it_has_changed(server, name):
    answer = fetched(server, name)
    assert json.load(answer) == json.loads(json.dumps(lesson_record(shipped_lesson(name))))
    assert answer.headers["Vary"] == "Accept-Language, Cookie"
    assert answer.headers.get_content_type() == "application/json"
    with pytest.raises(urllib.error.HTTPError, match="304"):
        fetched(server, name, **{"If-None-Match": answer.headers["Etag"]})


@pytest.mark.parametrize(
    "address, accepted, language",
    [
        ("bounce-twice", "es-MX,en;q=0.8", "es"),
        ("bounce-twice", "fr,en;q=0.8", "en"),
        ("bounce-twice?language=es", "en", "es"),
        ("bounce-twice?language=xx", "es", "en"),
    ],
)
def test_a_lesson_is_in_the_language_of_who_asks(server, address, accepted, language):
    assert json.load(fetched(server, address, **{"Accept-Language": accepted}))["language"] == language


@pytest.mark.parametrize("name", ["none-such", "bounce-twice.es", "..%2Fbounce-twice", "B", "a" * 61])
def test_a_name_of_none_is_not_found(server, name):
    with pytest.raises(urllib.error.HTTPError, match="404"):
        fetched(server, name)


def test_languages_are_those_of_translations():
    languages = lesson_languages()
    assert {"en", "es"} <= languages
    assert [language_for(each, languages) for each in ("", "ES", "de,es", "*" * 9_000)] == ["en", "es", "es", "en"]
