"""How views answer: a function of the request finds values, which go out as JSON, or why there are none."""

import json
from collections.abc import Callable
from functools import wraps
from typing import Any

from ..choices.request import Request
from ..text.refusals import reason_of


def answering(work: Callable[..., dict[str, Any]]) -> Callable[..., str]:
    """Work of a view, as the registry takes it. Asked a dict of the choices and of what is asked besides, then
    in `Request.chosen`, it answers as JSON: `chosen`, all that was asked, and what `work` finds, or `error`, a note why
    there is nothing.
    """

    @wraps(work)
    def answered(asked: dict[str, Any], *more: Any) -> str:
        try:
            found = work(Request.of(asked), *more)
        except ValueError as refusal:
            found = {"error": reason_of(refusal)}
        return json.dumps({"chosen": asked} | found, allow_nan=False)

    return answered
