"""Scripts of Bokeh and Panel: Bokeh as it is, and of what extends it the models that the page has.

All of Panel, with the widgets and tables that it builds on, took a quarter of the time in which a browser opens a page.
"""

import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import bokeh.server
import panel

CORE = Path(bokeh.server.__file__).parent / "static/js/bokeh.min.js"
PANEL = Path(panel.__file__).parent / "dist/panel.min.js"
EXTENSIONS = (CORE.with_name("bokeh-widgets.min.js"), PANEL)
MODELS = {"ReactiveESM": "models/reactive_esm", "BrowserInfo": "models/browser"}  # of the page, and where they are
MODULE = re.compile(r'^"?(\w+)"?: (?=function _\((\w+))', re.MULTILINE)  # its name, and that of its `require`
CALL = re.compile(r'(?<![\w.$])(\w+)\("?([^"()\s]+)"?\)')  # with a path or a number, as `require` is
END = re.compile(r'^\}, "?\w+"?, (\{.*\}), \{\}\);\}\);$', re.MULTILINE)  # of all modules: paths and their names


@cache
def extension() -> str:
    """These models and all modules that they need beyond Bokeh, as one script.

    Raises ValueError for files of another form.
    """
    modules: dict[str, tuple[str, str]] = {}
    names: dict[str, str] = {}
    for file in EXTENSIONS:
        whole, paths, _ = END.split(file.read_text("utf-8"))
        terms, *parts = MODULE.split(whole)
        modules |= zip(parts[::3], zip(parts[1::3], parts[2::3], strict=True), strict=True)
        names |= {path: str(name) for path, name in json.loads(paths).items()}
    needed = set(_needed([names[path] for path in MODELS.values()], modules, names))
    bodies = "".join(f'"{name}": {modules[name][1]}' for name in modules if name in needed)
    known = json.dumps({path: name for path, name in names.items() if name in needed})
    found = ", ".join(f'{model}: need("{path}").{model}' for model, path in MODELS.items())
    terms, _ = terms.split("*/", 1)  # of both: they are by the same
    return (
        f"{terms}*/\nBokeh.register_plugin({{\n{bodies}"
        f'"page": (need) => need("@bokehjs/base").register_models({{ {found} }})}}, "page", {known});\n'
    )


def _needed(left: list[str], modules: dict[str, tuple[str, str]], names: dict[str, str]) -> Iterator[str]:
    """These modules and all that they need, but for those of Bokeh itself."""
    seen: set[str] = set()
    while left:
        name = left.pop()
        if name in seen or name not in modules:
            continue
        seen.add(name)
        yield name
        require, body = modules[name]
        for path in (asked.removeprefix("@bokehjs/") for called, asked in CALL.findall(body) if called == require):
            left.append(names.get(path) or names.get(f"{path}/index") or path)
