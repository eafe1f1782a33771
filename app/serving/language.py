"""The language of a visitor."""

from collections.abc import Iterable

from tornado.httputil import HTTPServerRequest

from ..page.address import text_of
from ..text.catalogues import language_for

ASKED = "language"  # the key of an address that asks for one
KEPT = "strikewave-language"  # the cookie of one that was chosen by the switch, see app/static/frame/language.js


def language_of(request: HTTPServerRequest, languages: Iterable[str] = ()) -> str:
    """The one that the address asks for, else that of the switch, else the first that the browser accepts; of
    `languages`, or of those of the page.
    """
    asked = text_of(request.query_arguments[ASKED]) if ASKED in request.query_arguments else ""
    kept = request.cookies[KEPT].value if KEPT in request.cookies else ""
    return language_for(asked or kept or request.headers.get("Accept-Language", ""), languages)
