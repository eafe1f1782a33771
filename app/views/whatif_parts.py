"""A question of the map in parts, each a question of its own, and their answers as one."""

import json
from collections.abc import Iterable
from typing import Any

from .whatif import POINTS, STRESS, id_of, read_points


class Parts:
    """Of one question; nothing of it is kept but what it may say. Raises ValueError as `read_points` does."""

    def __init__(self, asked: dict[str, Any]):
        self._asked, points = asked, read_points(asked[POINTS])
        self.rows, self.divides = points.rows, not points.file
        models = {"models": dict(zip(("figure", "bounds"), points.models, strict=True))} if points.models else {}
        more = {"set": points.others, "stress": STRESS in points.figures} | models
        self._question = {"id": id_of(asked[POINTS]), "names": points.names, "rows": []} | more

    def part(self, start: int, stop: int) -> str:
        """As JSON what `whatif_data` is asked for these rows."""
        question = self._question | {"rows": self.rows[start:stop]}
        return json.dumps(self._asked | {POINTS: json.dumps(question)}, allow_nan=False)

    def joined(self, answers: Iterable[dict[str, Any]]) -> str:
        """Of parts that follow one another from the first row on, as `whatif_data` answers them."""
        whole: dict[str, Any] = {}
        for answer in answers:
            if not whole:
                whole = answer | {"rows": [], "why": {}}
            before = len(whole["rows"])
            whole["why"] |= {str(before + int(row)): reason for row, reason in answer["why"].items()}
            whole["rows"] += answer["rows"]
            whole |= {name: answer[name] for name in ("models", "shown") if name in answer and name not in whole}
        return json.dumps(whole, allow_nan=False)
