"""A model that may be enough for a scene."""

import math
from dataclasses import dataclass
from typing import Any

from ..text.catalogue import SOURCE, library
from ..text.messages import WORDED


@dataclass(frozen=True)
class Candidate:
    """A model for this scene. `changes` turn the scene into the one to solve; expected_error: of the answer, relative
    (of the final velocity as a share of the speed of approach); infinite where the model cannot predict it, NaN where
    nobody has measured. `theory` and `contact` ("elastic" or "elastoplastic") only where there is a choice of them."""

    name: str
    changes: dict[str, Any]
    expected_error: float
    modes: int | None = None
    theory: str | None = None
    contact: str | None = None

    @property
    def parts(self) -> dict[str, Any]:
        """What it is made of, without what it is not."""
        parts = {"name": self.name, "modes": self.modes, "theory": self.theory, "contact": self.contact}
        return {key: value for key, value in parts.items() if value is not None}

    @property
    def model(self) -> str:
        """All of it in one line, in whatever language: it names the model for programs, too."""
        return WORDED["model"](self.parts, library(SOURCE))

    def table(self) -> dict[str, Any]:
        error = self.expected_error if math.isfinite(self.expected_error) else None
        return {"model": self.model, "changes": self.changes, "expected_error": error}
