"""The notebook of the documentation prints and draws what is kept in it."""

import doctest

import pytest

from . import notebook
from .test_docs import HOW

PNG = b"\x89PNG"


@pytest.mark.slow
def test_each_cell_prints_and_draws_what_is_kept(tmp_path):
    kept = notebook.read()
    for cell, printed in notebook.run(kept, tmp_path):
        texts = ["".join(output["text"]) for output in cell["outputs"] if output["output_type"] == "stream"]
        assert doctest.OutputChecker().check_output("".join(texts), printed, HOW), (texts, printed)
        drawn = notebook.PICTURE.search("".join(cell["source"]))
        assert bool(drawn) == any(output["output_type"] == "display_data" for output in cell["outputs"])
        assert not drawn or (tmp_path / drawn[1]).read_bytes().startswith(PNG)
    assert (tmp_path / "pad.html").stat().st_size > 10_000


def test_it_has_the_form_that_notebooks_have():
    kept = notebook.read()
    assert (kept["nbformat"], kept["nbformat_minor"]) == (4, 4)
    assert {cell["cell_type"] for cell in kept["cells"]} == {"markdown", "code"}
    numbers = [cell["execution_count"] for cell in kept["cells"] if cell["cell_type"] == "code"]
    assert numbers == list(range(1, len(numbers) + 1))
    sources = ["".join(cell["source"]) for cell in kept["cells"] if cell["cell_type"] == "code"]
    assert not any("while " in source for source in sources)
