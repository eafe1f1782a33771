"""Every note that the library makes has its text, which takes exactly its values; and every text is used."""

import ast
import json
import pickle
from pathlib import Path

import pytest

import app
import solvers
from solvers.text.catalogue import CHOSEN, SOURCE, Catalogue, library, spoken
from solvers.text.messages import names_in, parsed, terms_in
from solvers.text.notes import Note, Severity, coded

ROOTS = [Path(package.__file__).parent for package in (solvers, app)]
SOURCES = sorted(path for root in ROOTS for path in root.rglob("*.py"))
# what makes a note of a code, and how it begins
MAKERS = {"allowed": "allowed.", "_remark": "", "RecordError": "record.refused."}


def called(tree: ast.AST) -> list[tuple[str, set[str] | None]]:
    """Codes and names of values of all notes in a module; None: the values are not written there."""
    nodes = list(ast.walk(tree))
    constants = {
        target.id: node.value.value
        for node in nodes
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant)
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    found = []
    for node in nodes:
        name = getattr(node, "func", None)
        name = getattr(name, "id", getattr(name, "attr", ""))
        if not isinstance(node, ast.Call) or name not in ("Note", *MAKERS) or not node.args:
            continue
        first = node.args[0]
        code = first.value if isinstance(first, ast.Constant) else constants.get(getattr(first, "id", ""))
        if code is None:  # made again of another note
            continue
        names = None if any(each.arg is None for each in node.keywords) else {each.arg for each in node.keywords}
        found.append((MAKERS.get(name, "") + code, names))
    return found


@pytest.fixture(scope="module")
def used() -> list[tuple[str, set[str] | None]]:
    """Of all modules."""
    texts = (path.read_text(encoding="utf-8") for path in SOURCES)
    some = (text for text in texts if any(f"{name}(" in text for name in ("Note", *MAKERS)))
    return [use for text in some for use in called(ast.parse(text))]


CODES = {code for code in library(SOURCE).texts if not code.startswith("terms.")}


def test_notes_have_texts_with_exactly_their_values(used):
    texts = library(SOURCE)
    wrong = [code for code, names in used if code not in CODES or names not in (None, texts.names(code))]
    assert wrong == []


def test_every_text_and_every_term_is_used(used):
    elsewhere = ("printed.", "left-out.", "name.")  # see `test_printed`, which prints the first two
    assert {code for code, _ in used} == {code for code in CODES if not code.startswith(elsewhere)}
    assert {term for text in library(SOURCE).texts.values() for term in terms_in(text)} == set(library(SOURCE).terms)


def test_a_note_is_data_and_reads_as_english():
    note = Note("near-grazing", Severity.WARNING, change=1.234, heavier=False, others=1, contacts=2)
    assert str(note).startswith("Near grazing: with the mass 1.2 % lighter there would be one contact instead of 2.")
    assert Note.from_table(json.loads(json.dumps(note.table()))) == note == pickle.loads(pickle.dumps(note))
    assert len({note, Note.from_table(note.table())}) == 1
    with pytest.raises(AttributeError):
        note.code = "other"


def test_the_table_of_a_solution_has_notes_as_text_and_as_codes():
    found = solvers.solve(solvers.load("fixed-rod"), "modal", modes=5).table()
    assert found["notes"] == [str(Note.from_table(note)) for note in found["note_codes"]] != []
    assert json.loads(json.dumps(found["note_codes"])) == found["note_codes"]
    assert coded([]) == {"notes": [], "note_codes": []}


@pytest.mark.parametrize("broken", ["{", "a }", "{x, plural, one {a}}", "{x, select, other {a}", "{x:.3g"])
def test_a_text_that_does_not_close_is_refused(broken):
    with pytest.raises(ValueError):
        parsed(broken)


def test_choices_and_plurals_nest():
    text = "{n, plural, =0 {none} one {one {kind, select, a {A} other {B}}} other {{n} {kind}s}}"
    assert names_in(text) == {"n", "kind"}


def catalogue(language: str, folder: Path, **files: str) -> Catalogue:
    """Of texts by language."""
    for name, text in files.items():
        (folder / name[:2]).mkdir(exist_ok=True)
        (folder / name[:2] / f"{name}.toml").write_text(text)
    return Catalogue(language, ((folder, ""),))


def test_a_code_stands_once(tmp_path):
    with pytest.raises(ValueError, match="same has a text already"):
        catalogue("en", tmp_path, en='same = "a text"\n', en2='same = "a text"\n')


def test_another_language_has_its_own_plurals_and_decimal_sign(tmp_path):
    found = catalogue("es", tmp_path, es='gap = "{n, plural, one {# uno} other {{n:.1f} mm}}"\n')
    assert found.text("gap", n=2.5) == "2,5 mm" and found.text("gap", n=1) == "# uno"


def test_what_a_language_lacks_is_said_in_that_of_the_source(tmp_path):
    found = catalogue("es", tmp_path, en='one = "one"\ntwo = "two"\n', es='one = "uno"\n')
    assert found.text("one") == "uno" and found.text("two") == "two"


def test_a_note_may_hold_codes_notes_and_plain_words(tmp_path):
    found = catalogue("en", tmp_path, en='all = "{one:note}: {more:notes}"\ndeep.er = "{size:g} mm"\nown = "name"\n')
    note = {"code": "deep.er", "values": {"size": 2.0}}
    assert found.text("all", one="own", more=["deeper", note]) == "name: deeper, 2 mm"


@pytest.mark.parametrize("named", ["xx", "../..", "", "EN", "__pycache__"])
def test_a_language_without_texts_is_that_of_the_source(monkeypatch, named):
    monkeypatch.setenv(CHOSEN, named)
    assert spoken() == SOURCE
