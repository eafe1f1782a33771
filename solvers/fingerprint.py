"""Which code a measured table was made with: fingerprints that change with what is computed, not with what is said."""

import ast
import json
import re
from collections.abc import Iterable
from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path

from .jit.cache import LIBRARY, cache_home, keep_text, sources_key

# Parts of the library that decide no result: what is said of it, and how kernels are compiled. What the latter does to
# times is seen by `python -m bench --only shipped`, as is what a machine does.
COMPUTES_NOTHING = ("text", "notebook", "jit", "provenance.py", "fingerprint.py")
DEFINES = ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef
EMPTY = re.compile(r"\w+=\[\]|[, ]")  # fields that are left out by some versions of Python, and what stands between


def fingerprint(sources: Iterable[Path], deep: bool) -> str:
    """Twelve letters that change with the code of these files of the library, `deep`: or of any that they import.

    Comments, docstrings and line breaks do not count, nor do modules that decide no result.
    """
    found, ahead = set(), list(sources)
    while ahead:
        source = ahead.pop()
        if source not in found and source.relative_to(LIBRARY).parts[0] not in COMPUTES_NOTHING:
            found.add(source)
            ahead += _imported(source) if deep else ()
    parts = (f"{source.relative_to(LIBRARY).as_posix()} {_code(source)}" for source in sorted(found))
    return sha256("\n".join(parts).encode()).hexdigest()[:12]


def remembered(named: dict[str, tuple[list[Path], bool]]) -> dict[str, str]:
    """The fingerprint of each of these lists of files, deep or not; from the user's cache if no source has changed."""
    kept = cache_home() / "fingerprints.json"
    with suppress(OSError, ValueError, KeyError, TypeError):
        stored = json.loads(kept.read_text(encoding="utf-8"))
        if stored["sources"] == sources_key() and stored["found"].keys() == named.keys():
            return stored["found"]
    found = {name: fingerprint(*each) for name, each in named.items()}
    with suppress(OSError):
        keep_text(kept, json.dumps({"sources": sources_key(), "found": found}))
    return found


@cache
def _tree(source: Path) -> ast.Module:
    """Without docstrings."""
    tree = ast.parse(source.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, DEFINES) and ast.get_docstring(node, clean=False) is not None:
            del node.body[0]
    return tree


@cache
def _code(source: Path) -> str:
    """The same in every version of Python."""
    return sha256(EMPTY.sub("", ast.dump(_tree(source))).encode()).hexdigest()


@cache
def _imported(source: Path) -> frozenset[Path]:
    """Files of the library from which it imports, at its head or in a function."""
    found: set[Path] = set()
    for node in ast.walk(_tree(source)):
        if isinstance(node, ast.ImportFrom) and node.level:
            place = source.parents[node.level - 1].joinpath(*(node.module or "").split("."))
            for each in node.names:
                found |= _files(place, each.name)
    return frozenset(found)


def _files(place: Path, name: str) -> set[Path]:
    """Where a name comes from that is imported from a module, or from a package, which may have it from elsewhere."""
    if (module := place.with_suffix(".py")).is_file():
        return {module}
    if (module := place / f"{name}.py").is_file():
        return {module}
    package = place / "__init__.py"
    for node in ast.walk(_tree(package)) if package.is_file() else ():
        if isinstance(node, ast.ImportFrom) and node.level and name in {each.name for each in node.names}:
            found = _files(place.joinpath(*(node.module or "").split(".")), name)
            return found or {package}
    return {package} if package.is_file() else set()
