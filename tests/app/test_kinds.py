"""Only a kind's own code asks what kind an impact is: all else asks the view of the kind, or the message for a fact."""

import re
from pathlib import Path

import pytest

import app
from app.views.registry import KINDS

STATIC = Path(app.__file__).parent / "static"
ROOMS = {"axial", "beam", "mechanism", "space", "fall"}
# which answer impacts along an axis and across, or read what an answer of either says
LEFT = {"wasm/answers.js", "wasm/columns.js", "wasm/mapped.js"}
NAMES = "|".join(sorted(KINDS))
ASKS = re.compile(rf"kind\b\W{{0,3}}[!=]==? *['\"]({NAMES})['\"]|['\"]({NAMES})['\"] *[!=]==|case ['\"]({NAMES})['\"]:")


def test_no_other_code_asks_for_the_kind():
    asking = {
        path.relative_to(STATIC).as_posix()
        for path in STATIC.rglob("*.js")
        if path.relative_to(STATIC).parts[0] not in ROOMS and ASKS.search(path.read_text(encoding="utf-8"))
    }
    assert asking <= LEFT


@pytest.mark.parametrize(
    "code", ["frame.kind === 'axial'", "one?.kind !== 'bodies'", "'beam' === kind", "case 'beam':"]
)
def test_what_asks_is_found(code):
    assert ASKS.search(code)


@pytest.mark.parametrize("code", ["now.kind !== kept.kind", "views[frame.kind]", "name !== 'mass'", "kind === 'rod'"])
def test_what_does_not_ask_is_left_alone(code):
    assert not ASKS.search(code)
