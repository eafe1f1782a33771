"""The documentation: examples run and print what stands below them, pages build, links and names are there.

In README and docs a block marked `python` is run, all of a page in one namespace; a block marked `console` has commands
after `$`. A `text` block after the one, and the lines after the other, are what it prints; `...` stands for anything.
Commands in `sh` blocks are read, not run: they take long, or write files. A `diff` applies to the sources as they are.
A page in another language has the sections and examples of the page that it translates.
"""

import doctest
import os
import re
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path

import pytest

import solvers
from app.command import main
from app.command.serve import DEFAULT_PORT
from app.serving.server import opened_at
from app.text.catalogues import LANGUAGES
from app.text.catalogues import page as catalogue
from bench import thesis
from solvers.text.catalogue import CHOSEN, SOURCE

from .patience import SECONDS

ROOT = Path(__file__).parents[1]
TOP = [ROOT / f"{name}.md" for name in ("README", "CONTRIBUTING", "CHANGELOG", "SECURITY")]
DOCS = ROOT / "docs"
PAGES = [*TOP, *sorted(DOCS.rglob("*.md"))]
IN_ENGLISH = {"es": ", en inglés"}  # what the page's help says of a document that a language does not have
TRANSLATED = sorted(DOCS.glob("*/*.md"))  # in a folder of their language
HOW = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def blocks(page: Path) -> list[tuple[str, str]]:
    """Fenced blocks of a page, (kind, text) each."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def pages_with(*kinds: str) -> list[Path]:
    return [page for page in PAGES if any(kind in kinds for kind, _ in blocks(page))]


def named(page: Path) -> str:
    """Its path without the ending: pages of other languages have the same names."""
    return page.relative_to(ROOT).with_suffix("").as_posix()


def assert_prints(wanted: str, printed: str) -> None:
    assert doctest.OutputChecker().check_output(wanted, printed, HOW), f"expected:\n{wanted}\nprinted:\n{printed}"


def commands(text: str) -> Iterator[tuple[list[str], str]]:
    """Words of each command of a console block, and what it is said to print."""
    for command in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        line, _, wanted = command.partition("\n")
        yield shlex.split(line), wanted


@pytest.mark.slow
@pytest.mark.parametrize("page", pages_with("python", "console", "toml"), ids=named)
def test_examples_print_what_stands_below_them(page, capsys, monkeypatch):
    monkeypatch.chdir(ROOT)
    if page in TRANSLATED:
        monkeypatch.setenv(CHOSEN, page.parent.name)
    names: dict[str, object] = {}
    for (kind, text), (following, wanted) in pairwise([*blocks(page), ("", "")]):
        if kind == "python":
            exec(compile(text, f"{page.name}, python", "exec"), names)
            assert_prints(wanted if following == "text" else "", capsys.readouterr().out)
        elif kind == "console":
            for (program, *arguments), shown in commands(text):
                assert program == "impact"
                main.main(arguments)
                assert_prints(shown, "".join(capsys.readouterr()))
        elif kind == "toml":
            solvers.Scene.from_table(tomllib.loads(text))


def test_the_readme_says_where_the_command_says_that_the_page_is():
    assert f"`http://{opened_at(DEFAULT_PORT, '127.0.0.1', [], False)}`" in TOP[0].read_text("utf-8")


def test_scenes_that_are_shown_are_the_files_they_name():
    shown = [text for page in pages_with("toml") for kind, text in blocks(page) if text.startswith("# docs/")]
    assert shown
    for text in shown:
        assert text == (ROOT / text.splitlines()[0].removeprefix("# ")).read_text(encoding="utf-8")


@pytest.mark.slow
def test_examples_have_the_types_that_pyright_asks_for(tmp_path):
    for page in pages_with("python"):
        text = "\n".join(text for kind, text in blocks(page) if kind == "python")
        (tmp_path / f"{re.sub(r'[/-]', '_', named(page))}.py").write_text(text, encoding="utf-8")
    call = [sys.executable, "-m", "pyright", "--level", "warning", "--pythonpath", sys.executable, str(tmp_path)]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, timeout=SECONDS)
    assert done.returncode == 0, done.stdout + done.stderr


def test_commands_that_are_only_shown_have_such_options():
    shown = "\n".join(text for page in pages_with("sh") for kind, text in blocks(page) if kind == "sh")
    read = [shlex.split(line) for line in re.findall(r"\bimpact [a-z].*", shown)]
    assert len(read) > 5
    for _, *arguments in read:
        main._parser().parse_args(arguments)


def test_make_targets_exist():
    makefile = (ROOT / "Makefile").read_text()
    for page in PAGES:
        for target in re.findall(r"(?:`|^ *)make ([a-z]+)(?:`|\s)", page.read_text(encoding="utf-8"), re.MULTILINE):
            assert f"\n{target}:" in makefile, (page.name, target)


def test_files_that_are_named_exist():
    for page in (page for page in PAGES if page.name != "CHANGELOG.md"):
        prose = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
        for path in re.findall(r"`((?:solvers|app|tests|bench|docs)/[\w./-]*)`", prose):
            assert (ROOT / path).exists(), (page.name, path)


def headings(page: Path) -> list[int]:
    """How deep each heading of a page is, in its order."""
    prose = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    return [len(marks) for marks in re.findall(r"^(#+) ", prose, re.MULTILINE)]


def rows(page: Path) -> list[list[str]]:
    """What stands as code in the first cell of each row of the tables: keys, and names of choices."""
    return [re.findall(r"`[^`]+`", cell) for cell in re.findall(r"^\|([^|]+)\|", page.read_text("utf-8"), re.MULTILINE)]


@pytest.mark.parametrize("page", TRANSLATED, ids=named)
def test_a_translated_page_has_all_that_its_source_has(page):
    source = DOCS / page.name
    assert headings(page) == headings(source)
    assert [kind for kind, _ in blocks(page)] == [kind for kind, _ in blocks(source)]
    for (kind, text), (_, own) in zip(blocks(page), blocks(source), strict=True):
        assert kind not in ("sh", "python", "toml", "diff") or text == own
    assert rows(page) == rows(source)


def test_the_help_of_the_page_leads_to_documents_that_there_are():
    """In each language to the page in that language, where there is one; else it says which language it is in."""
    for language in LANGUAGES:
        texts = catalogue(language)
        for name, address in texts.family("help.address").items():
            own = "" if language == SOURCE or not (DOCS / language / f"{name}.md").exists() else f"{language}/"
            assert address == f"{own}{name}.html" and (DOCS / own / f"{name}.md").exists()
            foreign = language != SOURCE and not own
            assert texts.texts[f"help.page.{name}"].endswith(IN_ENGLISH.get(language, "?")) == foreign


def test_diffs_apply_to_the_sources():
    for page in pages_with("diff"):
        for kind, text in blocks(page):
            if kind == "diff":
                _check_diff(text)


def _check_diff(text: str) -> None:
    """Every hunk's old lines stand in the file as they are reported; a file that is made is not there yet."""
    for part in re.split(r"^--- ", text, flags=re.MULTILINE)[1:]:
        old, new, *lines = part.splitlines()
        if old == "/dev/null":
            assert not (ROOT / new.removeprefix("+++ ")).exists(), new
            continue
        source = (ROOT / old).read_text(encoding="utf-8")
        for hunk in re.split(r"^@@.*\n", "\n".join(lines) + "\n", flags=re.MULTILINE)[1:]:
            before = "".join(line[1:] + "\n" for line in hunk.splitlines() if not line.startswith("+"))
            assert before in source, (old, before)


def test_every_public_name_is_in_the_reference():
    reference = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
    missing = [name for name in solvers.__all__ if not re.search(rf"\bsolvers\.{name}\b", reference)]
    assert missing == []


def test_links_beside_the_pages_lead_somewhere():
    for page in TOP:
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", page.read_text(encoding="utf-8")):
            assert (ROOT / target).exists(), (page.name, target)


def test_one_version_everywhere():
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert solvers.__version__ == version
    assert re.search(rf"^version: {re.escape(version)}$", (ROOT / "CITATION.cff").read_text(), re.MULTILINE)
    assert re.findall(r"^## (\d\S*)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)[0] == version


class _Addresses(HTMLParser):
    """What a page makes a browser fetch."""

    def __init__(self):
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag, attrs):
        if tag in ("script", "link", "img", "iframe", "source"):
            self.found += [value for name, value in attrs if name in ("src", "href", "srcset") and value]


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    """The pages, built by MkDocs: a page, link or name that does not exist ends it."""
    built = tmp_path_factory.mktemp("site")
    call = [sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict", "--site-dir", str(built)]
    quiet = os.environ | {"NO_MKDOCS_2_WARNING": "1"}
    done = subprocess.run(call, cwd=ROOT, env=quiet, capture_output=True, text=True, timeout=SECONDS)
    assert done.returncode == 0, done.stdout + done.stderr
    return built


@pytest.mark.slow
def test_pages_fetch_nothing_from_elsewhere(site):
    pages = sorted(site.rglob("*.html"))
    built = {page.relative_to(site).with_suffix("") for page in pages}
    assert built >= {page.relative_to(DOCS).with_suffix("") for page in DOCS.rglob("*.md")}
    for page in pages:
        found = _Addresses()
        found.feed(page.read_text(encoding="utf-8"))
        assert found.found
        assert [address for address in found.found if re.match(r"(https?:)?//", address)] == [], page.name
    for sheet in site.rglob("*.css"):
        assert not re.search(r"(url\(|@import)\s*['\"]?(https?:)?//", sheet.read_text(encoding="utf-8")), sheet.name


@pytest.mark.slow
def test_formulas_are_drawn_without_a_script(site):
    text = (site / "how-it-is-computed.html").read_text(encoding="utf-8")
    assert text.count("<math") > 50
    assert "arithmatex" not in text
    assert "merror" not in text


@pytest.mark.slow
def test_every_built_in_scene_is_listed(site):
    text = (site / "scenes.html").read_text(encoding="utf-8")
    assert [name for name in solvers.scene_names() if f"<code>{name}</code>" not in text] == []


def test_the_page_on_the_thesis_is_written_from_the_scenes():
    assert thesis.PAGE.read_text(encoding="utf-8") == thesis.text()  # else: python -m bench.thesis
    assert len(thesis.numbered()) == 143 and set(thesis.LACKS) <= set(thesis.numbered())
