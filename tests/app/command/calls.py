"""The command `impact` in process: what it answers, and the one line by which it refuses."""

import json

from app.command.main import main

KEYS = {
    "scene", "method", "contacts", "contact_time", "impulse", "peak_force", "peak_indentation", "residual_indentation",
    "peaks", "impactor", "target", "restitution", "energy", "diagnostics", "duration", "notes", "note_codes",
}  # fmt: skip
SOUGHT = {  # with --find
    "method", "key", "unit", "low", "high", "figure", "figure_unit", "wanted", "roots", "stretches", "jumps", "nearest",
    "samples", "refused", "notes", "note_codes",
}  # fmt: skip
COMPROMISES = {
    "goals", "points", "units", "limits", "solves", "refused", "warnings", "notes", "note_codes",
}  # fmt: skip
CONTOUR = {  # with --find twice
    "method", "keys", "figure", "figure_unit", "wanted", "lines", "jumps", "nearest", "refused", "solves", "warnings",
    "notes", "note_codes",
}  # fmt: skip


def answer(capsys, *arguments: str) -> str:
    code = main(list(arguments))
    out, err = capsys.readouterr()
    assert (code, err) == (0, "")
    return out


def result(capsys, *arguments: str) -> dict:
    return json.loads(answer(capsys, "solve", *arguments, "--json"))


def refusal(capsys, *arguments: str) -> str:
    """The one line on standard error, with nothing on standard output."""
    code = main(list(arguments))
    out, err = capsys.readouterr()
    assert code == 2
    assert out == ""
    assert err.startswith("impact: ") and err.endswith("\n")
    assert err.count("\n") == 1
    assert "Traceback" not in err
    assert len(err) < 600  # some name all figures
    return err
