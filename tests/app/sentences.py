"""What the server says by codes, as who reads English has it."""

import json
from collections.abc import Mapping
from typing import Any

from app.text.refusals import said
from solvers.text.catalogue import SOURCE


def sentence(reason: Mapping[str, Any]) -> str:
    """Of a note, as it stands in JSON."""
    return said(reason, SOURCE)


def refusals(refused: str) -> list[str]:
    """Of the laboratory's property `refused`."""
    return [sentence(reason) for reason in json.loads(refused)]
