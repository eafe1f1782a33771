"""The modules of the page as one: a class that opens it at once fetches one file each, not a hundred.

Each module becomes a function that is given what others export, in an order in which all that it needs is there. It
takes the forms that our modules have: `import { a, b as c } from './x.js'`, `import * as a from './x.js'`, `export`
before a declaration that does not change, and imports while running: of files in the same folder, or of an address,
which is left to the browser. Comments that have their lines to themselves, a quarter of what is sent, are left out, and
types within a line, indents, and comments at the ends of lines.
"""

import re
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path, PurePosixPath

IMPORT = re.compile(r"^import (?:\{([^}]*)\}|\* as (\w+)) from '([^']+)';\n", re.MULTILINE)
EXPORT = re.compile(r"^export (?=(?:async )?(?:function\*?|class|const) (\w+))", re.MULTILINE)
LATE = re.compile(r"\bimport\(`\./([^`]*)`\)")  # of a module in the same folder, known only when it runs
COMMENT = re.compile(r"^[ \t]*(?:/\*\*(?:(?!\*/)[\s\S])*\*/|//.*)\n", re.MULTILINE)  # that has its lines to itself
CAST = re.compile(r"/\*\* @\w+ [^*]*\*/ ?")  # of a type, within a line
TRAILING = re.compile(r"[ \t]+// [^'\"`\n]*$", re.MULTILINE)  # a comment, as nothing that is quoted ends behind it
ENDED = re.compile(r"^((?:(?!//).)*[;,{(])\n", re.MULTILINE)  # a line that another may follow, as no comment is in it
INDENT = re.compile(r"^\s+", re.MULTILINE)  # and empty lines
MODULES = 1000  # kept, as several bundles begin with the same ones
APART = re.compile(r"\bimport\(new URL\(")  # of what is fetched when it is asked for, with a bundle of its own
ADDRESS = "ADDRESS_OF_ALL"  # stands for that of the folder of all modules
OTHER = re.compile(r"^(?:import|export)\b(?! \{\};).*|\bimport\([^)]", re.MULTILINE)


def bundle(root: Path, entry: str, texts: str = "", beside: Iterable[str] = ()) -> str:
    """The module `entry` of this folder with all that it imports; it exports what that does.

    `texts`: the script of the texts beside it, which it fetches where the document, as somebody else's, has none.
    `beside`: other entries, which have been loaded: what those import is not there once more.

    Raises ValueError for a circle, and for an import or export of another form.
    """
    parts: list[str] = []
    there: dict[str, bool] = {}
    for each in beside:
        _add(root, each, there, [])
    _add(root, entry, there, parts)
    text = "".join(parts).replace(ADDRESS, f"new URL('{'../' * entry.count('/')}', import.meta.url)")
    names = ", ".join(EXPORT.findall((root / entry).read_text("utf-8")))
    fetched = (
        f"globalThis.strikewaveTexts ?? (await import(new URL('{texts}', import.meta.url).href));\n" if texts else ""
    )
    return (
        f"{fetched}const modules = (globalThis.strikewaveModules ??= {{}});\n"
        + text
        + f"export const {{ {names} }} = modules['{entry}'];\n"
    )


def function(root: Path, entries: Iterable[str], name: str, without: Iterable[str] = ()) -> str:
    """The same as a function of this name, of a script that is no module, which pages from the disk may load: it runs
    the entries in turn. Addresses are from the document's own; what is imported while running is not there. What others
    import from the folders `without` is undefined.
    """
    parts: list[str] = []
    there = {f"{folder}/{each.name}": True for folder in without for each in (root / folder).glob("*.js")}
    absent = "".join(f"modules['{each}'] = {{}};\n" for each in there)
    for entry in entries:
        _add(root, entry, there, parts, late=False)
    joined = (part if _spans(part) else ENDED.sub(r"\1", part) for part in parts)  # nobody packs what is on a disk
    text = absent + "".join(joined).replace(ADDRESS, "globalThis.document.baseURI")
    return f"globalThis.{name} = async () => {{\nconst modules = (globalThis.strikewaveModules = {{}});\n{text}}};\n"


def _add(root: Path, name: str, state: dict[str, bool], parts: list[str], late: bool = True) -> None:
    """Add a module after all that it needs, `late`: while running, too. `state`: False while that is under way, True
    when it has been added."""
    if name in state:
        if not state[name]:
            raise ValueError(f"{name} imports itself by way of others")
        return
    state[name] = False
    text, folder = shorter((root / name).read_text("utf-8")), PurePosixPath(name).parent
    needed = [_inside(folder / path) for *_, path in IMPORT.findall(text)]
    if late and LATE.search(text):  # whichever it will be: all there that stand alone or are needed by others too
        needed += sorted(
            str(folder / each.name) for each in (root / folder).glob("*.js") if str(folder / each.name) != name
        )
    for each in needed:
        _add(root, each, state, parts, late)
    parts.append(_function_of(name, folder, text))
    state[name] = True


@lru_cache(MODULES)
def _function_of(name: str, folder: PurePosixPath, text: str) -> str:
    def given(found: re.Match) -> str:
        names, whole, path = found.groups()
        what = whole or f"{{{names.replace(' as ', ': ')}}}"
        return f"const {what} = modules['{_inside(folder / path)}'];\n"

    exported = EXPORT.findall(text)
    body = EXPORT.sub("", IMPORT.sub(given, text))
    body = LATE.sub(lambda found: f"modules[`{folder}/{found[1]}`]", body)
    if other := OTHER.search(APART.sub("", _without_comments(body))):
        raise ValueError(f"{name}: cannot be bundled: {other[0]}")
    body = body.replace("import.meta.url", f"new URL('{name}', {ADDRESS}).href").replace("export {};\n", "")
    return f"modules['{name}'] = await (async () => {{\n{body}return {{ {', '.join(exported)} }};\n}})();\n"


@lru_cache(MODULES)
def shorter(text: str) -> str:
    """Without comments and types; without what is at the ends of lines, but for a template literal that spans some."""
    text = CAST.sub("", COMMENT.sub("", text))
    return text if _spans(text) else INDENT.sub("", TRAILING.sub("", text))


def _spans(text: str) -> bool:
    """Whether a template literal does, of lines."""
    return any(line.count("`") % 2 for line in text.splitlines())


def _without_comments(text: str) -> str:
    return re.sub(r"/\*[\s\S]*?\*/|^\s*//.*$", "", text, flags=re.MULTILINE)


def _inside(path: PurePosixPath) -> str:
    """Without steps upward."""
    parts: list[str] = []
    for part in path.parts:
        if part == "..":
            parts.pop()
        else:
            parts.append(part)
    return "/".join(parts)
