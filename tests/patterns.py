"""Every regular expression of the library and the page, and texts that take a careless one for ever."""

import ast
import importlib
import json
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from re import _parser as parser  # pyright: ignore[reportAttributeAccessIssue]

ROOT = Path(__file__).parents[1]
ODD = " 1a_.,(["  # what is repeated everywhere, beside what a pattern names itself
ENDS = ("", "!", "\n!")
SEARCHES = {"search", "sub", "split", "findall", "finditer"}  # which begin anew at each letter
METHODS = {"compile", "fullmatch", "match"} | SEARCHES
IMPORTED = re.compile(r"\bimport\b.*\bre\b")  # without which no pattern is made
COLLECT = """
import { readFileSync } from 'node:fs';
import { parse } from 'acorn';
const found = [];
const look = (node, file) => {
  if (node?.regex) found.push([file, node.regex.pattern, node.regex.flags]);
  if (node && typeof node === 'object') Object.values(node).forEach((part) => look(part, file));
};
const [, ...files] = process.argv;
const Own = RegExp;
for (const file of files) {
  const code = readFileSync(file, 'utf-8');
  look(parse(code, { ecmaVersion: 'latest', sourceType: 'module' }), file);
  if (!code.includes('new RegExp(')) continue;
  globalThis.RegExp = class extends Own {
    constructor(pattern, flags) {
      super(pattern, flags);
      found.push([file, this.source, this.flags]);
    }
  };
  await import(`${process.cwd()}/${file}`);
  globalThis.RegExp = Own;
}
console.log(JSON.stringify(found));
"""


def of_python(file: str) -> Iterator[tuple[str, re.Pattern, bool]]:
    """Where each stands, compiled, and whether it is searched for; one that is only known while running is an error."""
    text = (ROOT / file).read_text("utf-8")
    tree = ast.parse(text)
    names = {
        id(node.value): node.targets[0].id
        for node in tree.body
        if isinstance(node, ast.Assign)
        if isinstance(node.targets[0], ast.Name)
    }
    for node in ast.walk(tree):
        called = node.func if isinstance(node, ast.Call) else None
        if isinstance(called, ast.Attribute) and getattr(called.value, "id", "") == "re" and called.attr in METHODS:
            module = vars(importlib.import_module(file.removesuffix(".py").replace("/", ".")))
            call = ast.Call(ast.parse("re.compile", mode="eval").body, node.args, [])
            if called.attr != "compile":
                call.args = node.args[:1]
                call.keywords = [each for each in node.keywords if each.arg == "flags"]
            whole = ast.fix_missing_locations(ast.Expression(call))
            known = names.get(id(node))
            searched = called.attr in SEARCHES or (known is None and called.attr == "compile")
            searched = searched or any(f"{known}.{each}(" in text for each in SEARCHES)
            yield f"{file}:{node.lineno}", eval(compile(whole, file, "eval"), module), searched


def with_patterns() -> list[str]:
    """Files that may make some."""
    files = sorted([*ROOT.glob("solvers/**/*.py"), *ROOT.glob("app/**/*.py")])
    return [file.relative_to(ROOT).as_posix() for file in files if IMPORTED.search(file.read_text("utf-8"))]


def of_javascript() -> list[tuple[str, str, str]]:
    """File, pattern and flags of each."""
    files = sorted(str(file.relative_to(ROOT)) for file in ROOT.glob("app/static/**/*.js"))
    call = ["node", f"--import={ROOT / 'build/texts.mjs'}", "--input-type=module", "--eval", COLLECT, "--", *files]
    return [tuple(each) for each in json.loads(subprocess.run(call, cwd=ROOT, capture_output=True, check=True).stdout)]


def hostile(pattern: str) -> list[tuple[str, str, str]]:
    """Texts as beginning, what is repeated behind it, and end: what matches until a repeat, and then much."""
    spelled = pattern.replace("(?<", "(?P<").replace("(?P<=", "(?<=").replace("(?P<!", "(?<!")
    for letters, close in ((r"\p{L}", r"\w"), (r"\p{Lu}", "A"), (r"\p{N}", r"\d")):
        spelled = spelled.replace(letters, close)
    tree = parser.parse(spelled)
    found: dict[tuple[str, str], None] = {("", each): None for each in ODD}
    _walk(tree, "", found)
    return [(before, piece, end) for before, piece in found for end in ENDS]


def _walk(tree, before: str, found: dict[tuple[str, str], None]) -> str:
    """Add what may be repeated in this part of a pattern, behind what stands before it; a text that it matches."""
    text = ""
    for operator, given in tree:
        kind = str(operator)
        if kind in ("MAX_REPEAT", "MIN_REPEAT", "POSSESSIVE_REPEAT"):
            least, most, inner = given
            piece = _walk(inner, before + text, found)
            if most > 9:
                found |= {(before + text, each): None for each in (piece, *ODD) if each}
                found |= {(before + text + piece, each): None for each in ODD}
            text += piece * max(least, 1)
        elif kind == "SUBPATTERN":
            text += _walk(given[-1], before + text, found)
        elif kind == "ATOMIC_GROUP":
            text += _walk(given, before + text, found)
        elif kind == "BRANCH":
            branches = [_walk(each, before + text, found) for each in given[1]]
            text += branches[0]
        elif kind in ("ASSERT", "ASSERT_NOT"):
            _walk(given[1], before + text, found)
        elif kind == "LITERAL":
            text += chr(given)
        elif kind in ("IN", "NOT_LITERAL", "ANY"):
            text += _one_of(kind, given)
    return text


def _one_of(kind: str, given) -> str:
    """A letter that a class of a pattern matches."""
    if kind == "IN":
        classes = {"CATEGORY_WORD": "a", "CATEGORY_DIGIT": "1", "CATEGORY_SPACE": " "}
        (first, value), *_ = given
        if str(first) == "LITERAL":
            return chr(value)
        if str(first) == "RANGE":
            return chr(value[0])
        if str(first) == "CATEGORY":
            return classes.get(str(value), "-")
        taken = {chr(code) for what, code in given if str(what) == "LITERAL"}
    else:
        taken = {chr(given)} if kind == "NOT_LITERAL" else set()
    return next(letter for letter in "x-a." if letter not in taken)
