"""Scene file, command and Python of what is shown: they solve the same impact again."""

import contextlib
import io
import re

import pytest

import solvers
from app.command.main import main

pytestmark = pytest.mark.browser

CODE = "() => [...strikewave.page.root.querySelectorAll('.code-part pre')].map((each) => each.textContent)"
FINAL = """() => {
  const { bodies, exact, main } = strikewave.page.frame;
  return [bodies ? bodies.impactor.after.velocity : (exact ?? main).final];
}"""


@pytest.mark.parametrize(
    "query",
    [
        "?mass_ratio=2&law=hertz&modes=20",
        "?scene=hammer-on-cantilever&speed=2&modes=12",
        "?scene=four-bar",
        "?scene=brick-on-floor&friction=0.4",
    ],
)
def test_what_is_taken_along_solves_what_is_shown(open_page, tmp_path, monkeypatch, query):
    page = open_page(f"{query}&panel=code")
    page.wait("() => strikewave.page.root.querySelector('.code-part pre')?.textContent")
    command, python, scene = page.evaluate(CODE)
    (final,) = page.evaluate(FINAL)
    monkeypatch.chdir(tmp_path)
    name = re.findall(r"[\w.-]+\.toml", command)[0]
    (tmp_path / name).write_text(scene, encoding="utf-8")
    with contextlib.redirect_stdout(io.StringIO()) as said:
        exec(python)
        for line in command.splitlines():
            assert main(line.split()[1:]) == 0
    lines = command.splitlines()
    assert said.getvalue().count("Traceback") == 0 and len(lines) == len(python.splitlines()) - 2
    assert solvers.solve(name).impactor_velocity == pytest.approx(final, abs=1e-9)  # at 1 m/s along an axis


def test_code_is_copied_or_said_to_be_none(open_page):
    page = open_page("?panel=code")
    page.evaluate("() => { navigator.clipboard.writeText = () => Promise.reject(new Error('no')); }")
    page.tab.get_by_role("button", name="Copy the Python lines").click()
    page.wait("() => /select the lines/.test(strikewave.page.analyses.code.said.textContent)")
