"""The page judges a line by the same rules as the check of a lesson file."""

import json
import subprocess

import numpy as np
import pytest

from app.lessons.judging import judged
from app.serving.pages import STATIC

from ...patience import SECONDS
from .test_judging import LINE, SKETCH, TIME, TIMES

JUDGE = f"""
import {{ judged }} from '{STATIC}/lesson/judge.js';
const {{ axis, criteria, lines }} = JSON.parse((await import('node:fs')).readFileSync(0, 'utf-8'));
const outcomes = (line) => judged(line, criteria, axis, () => 0).map(({{ outcome }}) => outcome);
console.log(JSON.stringify(lines.map(outcomes)));
"""


def by_hand(seed: int) -> np.ndarray:
    """Straight from corner to corner, some at the times of the exact curve, some of no force, some jumps."""
    random = np.random.default_rng(seed)
    corners = np.sort(np.concatenate([random.uniform(0, 2.6, 8), random.normal([1, 1, 1.69, 2.03, 2.2], 0.1)]))
    forces = random.uniform(0, 110, corners.size) * (random.uniform(size=corners.size) < 0.6)
    return np.round(np.interp(TIME, corners, forces), 3)


@pytest.mark.browser  # needs Node
def test_browser_and_python_judge_a_line_alike():
    lines = [LINE, 0.8 * LINE, 0 * LINE, np.full(LINE.size, 37.0), *map(by_hand, range(400))]
    criteria = [
        {
            "criterion": each.criterion,
            "at": [TIMES[time] for time in each.at] if isinstance(each.at, tuple) else TIMES[str(each.at)],
            **{name: getattr(each, name) for name in ("within", "slack", "by", "above")},
        }
        for each in SKETCH.judges
    ]
    asked = json.dumps({"axis": SKETCH.axis, "criteria": criteria, "lines": [line.tolist() for line in lines]})
    call = ["node", "--input-type=module", "--eval", JUDGE]
    found = subprocess.run(call, input=asked, capture_output=True, text=True, check=True, timeout=SECONDS).stdout
    said = [[each.outcome for each in judged(line, SKETCH, TIMES)] for line in lines]
    assert json.loads(found) == said
    for place in range(len(criteria)):
        assert len({each[place] for each in said}) >= 2  # not all of them alike
