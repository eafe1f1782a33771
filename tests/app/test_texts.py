"""Every word of the page is in its catalogue: what the browser asks for is there, and what is there is asked for."""

import ast
import json
import re
import subprocess
from pathlib import Path

import pytest

import app
from app.choices.choices import Choices
from app.text.asked import asked_in
from app.text.catalogues import LANGUAGES, command, page, script
from solvers import LAWS, METHODS
from solvers.text.catalogue import SOURCE, library
from solvers.text.messages import engineering, terms_in

from ..patience import SECONDS

STATIC = Path(app.__file__).parent / "static"
SOURCES = "\n".join(path.read_text(encoding="utf-8") for path in sorted(STATIC.rglob("*.js")))
MODULES = {path: path.read_text(encoding="utf-8") for path in sorted(STATIC.parent.rglob("*.py"))}
SERVER = "\n".join(source for path, source in MODULES.items() if path.parent.name != "command")
ASKED, BEGUN = asked_in(SOURCES)
ASKED |= set(re.findall(r'"([a-z][\w-]*(?:\.[\w-]+)+)"', SERVER))  # by the server, for the page
BEGUN += ("question.",)  # of what is refused, as app/choices/choices.py names it
BEGUN += tuple(f"{family}." for family in re.findall(r'texts\.family\("([\w.-]+)"', SERVER))
BEGUN += tuple(re.findall(r'texts\.text\(f"([\w.-]+\.)\{', SERVER))
COMMANDED = command(SOURCE).texts.keys() - library(SOURCE).texts.keys()
UNBROKEN = "\u00a0"
OWN = {code for code in page(SOURCE).texts if code not in library(SOURCE).texts and not code.startswith("terms.")}


def test_every_choice_has_a_title():
    """One without would leave the whole page undrawn, as a constant of a new law does that is not in the catalogue."""
    assert {f"control.{name}" for name in Choices.CHOSEN} <= page(SOURCE).texts.keys()


def test_notes_know_how_far_sliders_reach():
    most = int(re.findall(r"^const SLIDER_END = (\d+);", SOURCES, re.M)[0])
    assert Choices.param["modes"].bounds[1] == Choices.param["elements"].bounds[1] == most


def test_what_the_browser_asks_for_is_there():
    known = set(page(SOURCE).texts)
    files = {code for code in ASKED if re.search(r"\.(js|css|csv|html)$", code)}
    rooms = {code.split(".")[0] for code in OWN}
    for code in ASKED - files - COMMANDED:
        if code.split(".")[0] in rooms:
            assert code in known or any(other.startswith(f"{code}.") for other in known), code


def test_what_is_there_is_asked_for():
    assert {code for code in OWN if code not in ASKED and not code.startswith(BEGUN)} == set()


def test_the_browser_decides_by_no_name_of_a_law_or_a_method():
    """What is so of one is said by the message: a law or a method that is added changes no line of the browser's."""
    names = "|".join([*LAWS, *METHODS])
    decided = rf"[!=]== '(?:{names})'|'(?:{names})' [!=]==|^ *'(?:{names})': .*"
    assert re.findall(decided, SOURCES, re.M) == []


def test_every_term_has_a_name_on_the_page():
    used = {term for text in page(SOURCE).texts.values() for term in terms_in(text)}
    assert used <= set(page(SOURCE).terms)
    assert set(page(SOURCE).terms) <= used | set(library(SOURCE).terms)


def test_page_and_command_name_the_same_note_in_their_own_words():
    values = {"slenderness": 3.0, "theory": "euler-bernoulli", "least": 10}
    assert page(SOURCE).text("beam-not-slender", **values).endswith("use Theory: Timoshenko.")
    assert command(SOURCE).text("beam-not-slender", **values).endswith("use theory = 'timoshenko'.")
    assert command(SOURCE).text("refusals.frozen-law", law="hertz").split("got ")[1].startswith("'hertz'")
    assert SOURCE in LANGUAGES


@pytest.mark.browser
def test_browser_and_python_fill_a_text_alike(tmp_path):
    """But for signs: the browser writes a true minus and powers of ten."""
    cases = {
        "near-grazing": {"change": 1.234, "heavier": False, "others": 1, "contacts": 2},
        "mesh-chatter": {"touches": 12, "contacts": 1, "remedy": "shorter"},
        "contact-missed": {"start": 2.12462, "end": 2.1628, "impulse": 0.66, "cause": "modes"},
        "switching-loses": {"modes": 5, "ratio": 3.0, "lost": 0.129, "affordable": True, "needed": 70, "offered": True},
        "switching-pulls": {"pull": 78_345.6},
        "contact-times": {"contacts": 1, "apparent": 0.00099961, "case": "none"},
        "not-refined": {"ladder": "modal", "resolution": "modes", "size": 640, "seconds": 0.0213},
        "plan-beside-sweeps": {
            "case": "compact", "impactor": "body", "target": "body", "question": "peak-force",
            "model": {"name": "rigid-impulse"}, "method": "rigid",
        },
    }  # fmt: skip
    (tmp_path / "texts.mjs").write_text(script(SOURCE), encoding="utf-8")
    asked = "".join(f"console.log(text({json.dumps(code)}, {json.dumps(values)}));" for code, values in cases.items())
    (tmp_path / "ask.mjs").write_text(f"import {{ text }} from '{STATIC}/text/catalogue.js';\n{asked}")
    command_line = ["node", f"--import={tmp_path / 'texts.mjs'}", str(tmp_path / "ask.mjs")]
    said = subprocess.run(command_line, capture_output=True, text=True, check=True, timeout=SECONDS).stdout.splitlines()
    for (code, values), sentence in zip(cases.items(), said, strict=True):
        plain = (
            page(SOURCE)
            .text(code, **values)
            .replace("'rigid'", "rigid bodies")
            .replace("'modal'", "modes")
            .replace("rigid-impulse", "rigid impulse")
        )
        assert sentence.replace(UNBROKEN, " ") == plain


@pytest.mark.parametrize(
    "value, unit, shown",
    [
        (1e-4, "s", "100 µs"),
        (2.351e-6, "s", "2.35 µs"),
        (0.00099961, "s", "1 ms"),  # rounded before the prefix is chosen
        (12.0, "s", "12 s"),
        (0.0, "s", "0 s"),
        (-78_345.6, "N", "-78.3 kN"),
        (3.2e-10, "m", "0.32 nm"),
    ],
)
def test_values_get_the_prefix_that_suits_them(value, unit, shown):
    assert engineering(value, unit) == shown


TALKING = ("command", "page", "views", "choices", "lessons", "serving", "jobs")  # folders with something to say
TWO_WORDS = re.compile(r"[A-Za-z]{2,}[,.;:]? \(?[A-Za-z]{2,}")
FOR_MACHINES = re.compile(
    r"^(not allowed|too many messages|not compiled|public, max-age.*|[a-z-]+-src '.*|"
    r"<.*|.*preserveAspectRatio.*|application/json.*|.*; charset=.*|.* blob:; .*|Accept-Language, Cookie|"
    r"preload\" as=\"style|modulepreload)$"
)


def written_in(tree: ast.AST) -> list[str]:
    """Texts of a module, but for docstrings, documentation of parameters, and what goes into the log."""
    apart = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            apart.add(node.value)
        if isinstance(node, ast.keyword) and node.arg == "doc":
            apart.add(node.value)
        if isinstance(node, ast.Call) and ast.unparse(node.func).startswith("log."):
            apart |= set(node.args)
    texts = (node for node in ast.walk(tree) if isinstance(node, ast.Constant) and isinstance(node.value, str))
    return [node.value for node in texts if node not in apart]


@pytest.mark.parametrize("folder", TALKING)
def test_no_sentence_stands_in_the_code_of_page_and_command(folder):
    for path, source in MODULES.items():
        if path.relative_to(STATIC.parent).parts[0] == folder:
            for text in written_in(ast.parse(source)):
                assert not TWO_WORDS.search(text) or FOR_MACHINES.match(text.strip()), f"{path.name}: {text}"


def test_every_text_of_the_command_is_asked_for_and_there():
    sources = "\n".join(source for path, source in MODULES.items() if path.parent.name in ("command", "serving"))
    asked = set(re.findall(r"\"([a-z][\w-]*(?:\.[\w-]+)+)\"|'([a-z][\w-]*(?:\.[\w-]+)+)'", sources))
    codes = {one or other for one, other in asked}
    families = set(re.findall(r"(?:family|named)\([\"']([\w.-]+)[\"']", sources)) | {"residual"}
    for code in COMMANDED:
        assert code in codes or code.startswith(tuple(f"{family}." for family in families)), code
    direct = set(re.findall(r"(?<!\.)\btext\([\"']([\w.-]+)[\"']", sources))
    assert direct - command(SOURCE).texts.keys() == set()


@pytest.mark.browser
def test_numbers_of_another_language_have_its_decimal_sign(tmp_path):
    """Also those that no text asks for: of tables, ticks and fields."""
    (tmp_path / "texts.mjs").write_text(
        script(SOURCE).replace('"language": "en"', '"language": "es"'), encoding="utf-8"
    )
    (tmp_path / "ask.mjs").write_text(
        f"""import {{ text }} from '{STATIC}/text/catalogue.js';
        import {{ decade, engineering, figures, grouped, percent, pretty, signed }} from '{STATIC}/text/format.js';
        console.log(text('contact-times', {{ contacts: 1, apparent: 2.351e-6, case: 'none' }}));
        console.log([signed(-0.5), figures(1.25), pretty(0.5), percent(0.0174), decade(-1), engineering(1.5e-3, 'm')]);
        console.log([grouped(52000), grouped(7.5)]);
        """
    )
    call = ["node", f"--import={tmp_path / 'texts.mjs'}", str(tmp_path / "ask.mjs")]
    said = subprocess.run(call, capture_output=True, text=True, check=True, timeout=SECONDS).stdout
    assert f"2,35{UNBROKEN}µs" in said
    assert re.findall(r"'(.*?)'", said) == ["−0,500", "1,25", "0,5", "1,74 %", "0,1", "1,5 mm", "52\u202f000", "7,5"]
