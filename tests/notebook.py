"""The notebook of the documentation, run cell by cell: what it prints and draws is kept in it.

`python -m tests.notebook` keeps what it prints and draws now, where a change is meant.
"""

import ast
import base64
import contextlib
import io
import json
import os
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

NOTEBOOK = Path(__file__).parents[1] / "docs" / "pad.ipynb"
PICTURE = re.compile(r'out="([\w-]+\.png)"')


def read() -> dict[str, Any]:
    return json.loads(NOTEBOOK.read_text(encoding="utf-8"))


def run(notebook: dict[str, Any], folder: Path) -> Iterator[tuple[dict[str, Any], str]]:
    """Each cell of code, and what it prints, its last expression with it where that is none of a picture."""
    names: dict[str, Any] = {}
    before = Path.cwd()
    os.chdir(folder)
    try:
        for cell in notebook["cells"]:
            if cell["cell_type"] == "code":
                printed = io.StringIO()
                with contextlib.redirect_stdout(printed):
                    exec(compile(ast.parse("".join(cell["source"])), NOTEBOOK.name, "exec"), names)
                yield cell, printed.getvalue()
    finally:
        os.chdir(before)


def keep() -> None:
    """What is printed and drawn now."""
    notebook = read()
    with tempfile.TemporaryDirectory() as folder:
        for number, (cell, printed) in enumerate(run(notebook, Path(folder)), 1):
            drawn = PICTURE.search("".join(cell["source"]))
            stream = {"name": "stdout", "output_type": "stream", "text": printed.splitlines(True)}
            cell["execution_count"], cell["outputs"] = number, [stream] if printed else []
            if drawn:
                data = {"image/png": base64.b64encode(Path(folder, drawn[1]).read_bytes()).decode("ascii")}
                cell["outputs"].append({"data": data, "metadata": {}, "output_type": "display_data"})
    NOTEBOOK.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    keep()
