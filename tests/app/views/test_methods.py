"""The table of methods says of the method on the page what the page says of it."""

import json

from app.choices.choices import Choices
from app.choices.request import Request
from app.messages.solutions import beside
from app.views.methods import methods_table
from solvers.accuracy.reference import exact_solution


def test_the_method_beside_is_solved_as_on_the_page():
    """71 touches of 50 modes on the page; the table solved for another duration, and counted 70."""
    chosen = Choices().chosen()
    request = Request.of(chosen)
    shown = beside(request, exact_solution(request.scene, request.restitution))
    rows = json.loads(methods_table(chosen))["rows"]
    (own,) = [row for row in rows if row["name"] == "modal"]
    assert own["raw_contacts"] == shown.diagnostics["raw_contacts"]
    assert own["contacts"] == len(shown.contacts)
