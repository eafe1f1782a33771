"""The browser code: its types, rules, form and unit tests, by the tools that `make test` installs (package.json)."""

import json
import subprocess
from pathlib import Path

import pytest

from app.text.catalogues import script

ROOT = Path(__file__).parents[1]
TEXTS = ROOT / "build/texts.mjs"  # what a page loads before its modules
CHECKS = {
    "types": ["npx", "tsc"],
    "rules": ["npx", "eslint", "."],
    "form": ["npx", "prettier", "--check", "app/static/**/*.{js,css}", "tests/js/*.js", "*.js", "*.json"],
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
    TEXTS.write_text(script(), encoding="utf-8")
    found = subprocess.run(CHECKS[check], cwd=ROOT, capture_output=True, text=True, timeout=300)
    assert found.returncode == 0, found.stdout + found.stderr


@pytest.mark.browser
@pytest.mark.parametrize(
    "code, caught",
    [
        ("make('p', { textContent: 'Nothing to show' });", True),
        ("const about = `The mass of ${1} touches the rod`;", True),
        ("const word = 'Cancel';", True),
        ("make('p', { title: 'raw' });", True),
        ("make('p', { className: 'chart figure', textContent: '✕' });", False),
        ("text('chart.zoom-in');", False),
        ("new Error('the chart has no size yet');", False),
    ],
)
def test_words_of_the_page_in_its_code_are_found(code, caught):
    call = ["npx", "eslint", "--stdin", "--stdin-filename", "app/static/sample.js"]
    globals_ = "/* global make, text */\n"
    found = subprocess.run(call, cwd=ROOT, input=globals_ + code, capture_output=True, text=True, timeout=100)
    assert ("texts/catalogued" in found.stdout) == caught, found.stdout + found.stderr


def test_the_tools_are_pinned():
    """A lock file would name the host that packages came from; exact versions do as well."""
    tools = json.loads((ROOT / "package.json").read_text())["devDependencies"]
    assert all(version[0].isdigit() for version in tools.values()), tools
    assert not (ROOT / "package-lock.json").exists()
