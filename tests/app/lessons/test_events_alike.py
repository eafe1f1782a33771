"""The page has the same events and quantities of goals in its messages as the check of a lesson has in the solution."""

import json
import subprocess

import pytest

from app.lessons.events import times_of
from app.lessons.lesson import Step
from app.lessons.solving import QUANTITIES, solved
from app.messages.solve import solve_frame
from app.serving.pages import STATIC
from app.text.catalogues import script
from solvers.text.catalogue import SOURCE

from ...patience import SECONDS

READ = f"""
import {{ readFileSync }} from 'node:fs';
import {{ eventsOf, quantityOf }} from '{STATIC}/lesson/events.js';
import {{ decode }} from '{STATIC}/wire/message.js';
const {{ file, quantities }} = JSON.parse(readFileSync(0, 'utf-8'));
const frame = decode(new Uint8Array(readFileSync(file)).buffer);
const values = quantities.map((quantity) => quantityOf(frame, quantity));
console.log(JSON.stringify({{ events: eventsOf(frame), values }}));
"""
SHOWN = [
    ("fixed-rod", {}),
    ("split-hopkinson", {}),
    ("two-balls", {"law": "hunt-crossley", "restitution": 0.5}),
    ("bouncing-ball", {}),
    ("timoshenko-1913-long", {"modes": 6}),
    ("hammer-on-cantilever", {}),
    ("four-bar", {}),
    ("four-bar-moves", {}),
    ("compound-pendulum", {}),
    ("spinning-ball", {}),
    ("note-rod-friction", {"restitution_model": "newton"}),
    ("painleve-rod", {}),
    ("note-rod", {}),
]


@pytest.mark.browser  # needs Node
@pytest.mark.parametrize("scene, choices", SHOWN, ids=[scene for scene, _ in SHOWN])
def test_page_and_check_find_the_same(tmp_path, scene, choices):
    shown = solved(Step(title="", scene=scene, choices=choices, parts=()))
    file = tmp_path / "frame"
    file.write_bytes(solve_frame(shown.request.chosen))
    quantities = [*QUANTITIES[shown.kind]]
    asked = json.dumps({"file": str(file), "quantities": quantities})
    texts = tmp_path / "texts.mjs"
    texts.write_text(script(SOURCE), encoding="utf-8")
    call = ["node", f"--import={texts}", "--input-type=module", "--eval", READ]
    found = json.loads(
        subprocess.run(call, input=asked, capture_output=True, text=True, check=True, timeout=SECONDS).stdout
    )
    times = times_of(shown.solution)
    assert found["events"].keys() == times.keys() and "touch" in times
    for name, time in times.items():
        assert found["events"][name] == pytest.approx(time, rel=1e-6, abs=1e-9), name
    for name, value in zip(quantities, found["values"], strict=True):
        true = QUANTITIES[shown.kind][name](shown)
        assert value == (true if true is None else pytest.approx(true, rel=1e-6, abs=1e-9)), name
