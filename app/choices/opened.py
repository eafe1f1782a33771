"""Charts that a scene is opened with, as they show what it is named after, and the place that one of them is of."""

from typing import Any

_STRESS = {  # by scene: the place of its figure, from the struck end [m]
    "figure-9.12": 1.0,
    "figure-9.13": 1.0,
    "figure-9.14": 0.5,
    "figure-10.4": 0.74,
    "figure-10.5": 0.0,
    "figure-10.6": 0.74,
    "figure-10.7": 0.0,
}
_OF_TIME = {"figure-6.7": "moved", "figure-6.8": "moved"} | {
    f"figure-{number}": "force" for number in ("9.11", "10.2", "10.10")
}


def opened_charts(scene: str) -> dict[str, Any]:
    """Names of charts, and where the stress is told [m]; nothing for most scenes."""
    if scene in _STRESS:
        return {"charts": ["stress"], "place": _STRESS[scene]}
    return {"charts": [_OF_TIME[scene]] if scene in _OF_TIME else [], "place": None}
