"""What each cheap model misses, over mass ratio and contact time: maps for a page or a notebook to draw."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .. import validation
from .contours import contour
from .models import MODELS, QUESTIONS
from .tables import models_table

if TYPE_CHECKING:
    from ..notebook.plots import Drawn

LEVELS = (0.01, 0.05, 0.2)  # of error, drawn on the maps
FAMILIES = ("fixed-rod", "free-rod", "cantilever", "pinned-pinned", "clamped-clamped", "free-free")


@dataclass(frozen=True)
class RegimeMap:
    """Errors of each model over mass ratio and contact time, as measured; for a page to draw.

    mass_ratio (n,), target over impactor; relative_time (m,), duration of the contact of two rigid bodies over the
    round trip of a wave in the rod, or over the period of the slowest vibration of the beam, 0 being a rigid contact;
    errors (models, n, m), infinite where the model has none. contours[model][level]: arrays of relative time and
    mass ratio along the lines of that error, NaN between the lines; models are better on the side of smaller errors.
    smallest (n, m): index of the first model within the tolerance, len(models): none of them is.
    """

    question: str
    family: str
    law: str
    tolerance: float
    models: list[str]
    mass_ratio: np.ndarray
    relative_time: np.ndarray
    errors: np.ndarray
    contours: dict[str, dict[float, tuple[np.ndarray, np.ndarray]]]
    smallest: np.ndarray

    def plot(self, what: str = "smallest") -> "Drawn":
        """A HoloViews object over relative time and mass ratio: the `smallest` model within the tolerance, or the
        error of one of `models` with its lines of equal error. Rigid contacts, at time zero, are left out.

        Raises SceneError for another word.
        """
        from ..notebook import plots  # loads HoloViews, which nothing else here needs

        return plots.regimes(self, what)


def regime_map(
    question: str = "final-velocities", family: str = "fixed-rod", law: str = "linear", tolerance: float = 0.05
) -> RegimeMap:
    """What each cheap model misses, for a family: fixed-rod, free-rod (law linear or hertz), or a beam's support."""
    number = QUESTIONS.index(validation.choice("question", question, QUESTIONS))
    validation.choice("family", family, FAMILIES)
    validation.choice("law", law, ("linear", "hertz") if family.endswith("-rod") else ("linear",))
    tolerance = validation.number("tolerance", tolerance, 1e-6, 1.0)
    table = models_table(family, law)
    errors = np.moveaxis(table.errors[:, :, :, number], 2, 0)
    shown = table.time > 0.0
    contours = {
        name: {level: contour(table.time[shown], table.ratio, errors[k][:, shown], level) for level in LEVELS}
        for k, name in enumerate(MODELS)
    }
    within = np.concatenate((errors <= tolerance, np.ones((1, *errors.shape[1:]), bool)))
    return RegimeMap(
        question, family, law, tolerance, list(MODELS), table.ratio, table.time, errors, contours, within.argmax(axis=0)
    )
