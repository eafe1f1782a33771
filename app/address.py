"""What is open on the page, and asked there, as its address says it."""

from typing import Any

from solvers import SceneError

from .questions import Questions, accepted
from .state import refusal, text_of, told_of, value_of

PANELS = {  # by name in the address: the property that opens it
    "energy": "energy_shown",
    "needs": "plan_shown",
    "tolerance": "auto_shown",
    "tradeoff": "tradeoff_shown",
    "trust": "trust_shown",
    "convergence": "convergence_shown",
    "methods": "methods_shown",
    "stability": "stability_shown",
    "ratios": "ratios_shown",
}
ASKED = {  # by name in the address: the property, the panel in which it is asked, and what `auto_within` must be
    "question": ("question", "needs", ""),
    "error": ("plan_tolerance", "needs", ""),
    "quantity": ("auto_quantity", "tolerance", ""),
    "tolerance": ("auto_tolerance", "tolerance", "tolerance"),
    "budget": ("auto_budget", "tolerance", "time"),
    "waves": ("auto_waves", "tolerance", ""),
    "follow": ("auto_follows", "tolerance", ""),
    "axis": ("stability_axis", "stability", ""),
}


def opened_from_address(arguments: dict[str, list[bytes]]) -> tuple[dict[str, Any], list[str]]:
    """Open panels and their questions from the query of an address: what can be used, and a sentence for each that
    cannot. A budget goes before a tolerance."""
    kept: dict[str, Any] = {}
    refused = []
    for name in filter(None, text_of(arguments["panel"]).split(",") if "panel" in arguments else ()):
        if name in PANELS:
            kept[PANELS[name]] = True
        else:
            refused.append(str(SceneError("panel", told_of(name, name), "some of " + ",".join(PANELS))))
    for key, (name, _, within) in ASKED.items():
        if key not in arguments:
            continue
        text = text_of(arguments[key])
        value = value_of(Questions.param[name], text)
        if not accepted(name, value):
            refused.append(refusal(name, told_of(text, value), Questions, key))
            continue
        kept[name] = value
        if within:
            kept["auto_within"] = within
    return kept, refused
