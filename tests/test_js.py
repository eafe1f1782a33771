"""The browser code: its types, rules, form and unit tests, by the tools that `make test` installs (package.json)."""

import json
import subprocess
from pathlib import Path

import pytest

from app.text.catalogues import script
from solvers.text.catalogue import SOURCE

from .patience import SECONDS

ROOT = Path(__file__).parents[1]
TEXTS = ROOT / "build/texts.mjs"  # what a page loads before its modules
CHECKS = {
    "types": ["node_modules/.bin/tsc"],
    "rules": ["node_modules/.bin/eslint", "."],
    "form": ["node_modules/.bin/prettier", "--check", "app/static/**/*.{js,css}", "tests/js/*.js", "*.js", "*.json"],
    "units": [
        "node",
        f"--import={TEXTS}",
        "--test",
        *sorted(str(test.relative_to(ROOT)) for test in ROOT.glob("tests/js/*.test.js")),
    ],
}


@pytest.mark.browser
@pytest.mark.parametrize("check", CHECKS)
def test_browser_code(check):
    TEXTS.parent.mkdir(exist_ok=True)
    TEXTS.write_text(script(SOURCE), encoding="utf-8")
    found = subprocess.run(CHECKS[check], cwd=ROOT, capture_output=True, text=True, timeout=SECONDS)
    assert found.returncode == 0, found.stdout + found.stderr


SAMPLES = {  # code, and whether its words belong in a catalogue
    "make('p', { textContent: 'Nothing to show' });": True,
    "const about = `The mass of ${1} touches the rod`;": True,
    "const word = 'Cancel';": True,
    "make('p', { title: 'raw' });": True,
    "make('p', { className: 'chart figure', textContent: '✕' });": False,
    "text('chart.zoom-in');": False,
    "new Error('the chart has no size yet');": False,
}
HANDLERS = {  # code, and whether a handler of it may return false
    "field.onkeydown = ({ key }) => key === 'Enter' && check();": True,
    "field.onkeydown = ({ key }) => { if (key === 'Enter') check(); };": False,
    "area.onpointerleave = (event) => event.touch || hide();": True,
    "range.onchange = () => (self.held = false);": True,
    "range.onclick = range.onchange = () => !self.held;": True,
    "make('input', { onkeydown: (event) => event.key !== 'Tab' });": True,
    "make('input', { onkeydown: () => field.focus() });": False,
    "const taken = ({ key }) => { return key === 'x'; }; field.onkeydown = (event) => taken(event);": True,
    "const taken = ({ key }) => { if (key) check(); }; field.onkeydown = (event) => taken(event);": False,
    "area.ondrop = function (event) { return event.files.length > 0; };": True,
    "area.onkeydown = (event) => event.large ? hide() : event.count > 1;": True,
    "area.onkeydown = (event) => event.large ? hide() : check();": False,
    "area.onkeydown = async (event) => event.count > 1;": False,
    "on.key = (event) => event.count > 1;": False,
}
LINT = """
import { ESLint } from 'eslint';
const eslint = new ESLint();
const linted = async (code) => {
  const [found] = await eslint.lintText(code, { filePath: 'app/static/sample.js' });
  return found.messages.map((message) => message.ruleId);
};
console.log(JSON.stringify(await Promise.all(JSON.parse(process.argv[1]).map(linted))));
"""


@pytest.fixture(scope="module")
def broken() -> dict[str, list[str]]:
    """The rules that each sample breaks."""
    samples = [*SAMPLES, *HANDLERS]
    names = "make, text, field, area, range, self, on, check, hide"
    codes = [f"/* global {names} */\n{code}" for code in samples]
    call = ["node", "--input-type=module", "--eval", LINT, json.dumps(codes)]
    found = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, timeout=SECONDS, check=True)
    return dict(zip(samples, json.loads(found.stdout), strict=True))


@pytest.mark.browser
@pytest.mark.parametrize("code, caught", SAMPLES.items())
def test_words_of_the_page_in_its_code_are_found(broken, code, caught):
    assert ("texts/catalogued" in broken[code]) == caught


@pytest.mark.browser
@pytest.mark.parametrize("code, caught", HANDLERS.items())
def test_a_handler_that_may_return_false_is_found(broken, code, caught):
    """Which cancels the event: no key would reach a field."""
    assert ("handlers/silent" in broken[code]) == caught


def test_the_tools_are_pinned():
    """A lock file would name the host that packages came from; exact versions do as well."""
    tools = json.loads((ROOT / "package.json").read_text())["devDependencies"]
    assert all(version[0].isdigit() for version in tools.values()), tools
    assert not (ROOT / "package-lock.json").exists()
