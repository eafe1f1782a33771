"""Types for the browser code, from `schema` and `records`: `python -m app.messages.declarations` writes them."""

import re
from pathlib import Path

from .field import Field, Fields
from .records import FIGURES, RECORDS, TYPES
from .schema import BENDING, COMMON, FRAMES, MESSAGES

OF_THE_BROWSER = {  # by kind: what it keeps with a message
    "axial": {"record": Field("{ time: number[]; force: number[] }", "a measured force laid over the others", True)}
}
SHARED = {  # by several kinds of message; each says which it is
    name: {key: field for key, field in fields.items() if key != "kind"}
    for name, fields in (("Common", COMMON), ("Bending", BENDING), ("Figures", FIGURES))
}
PLACE = Path(__file__).parents[1] / "static" / "messages.d.ts"
HEAD = """// Messages of the server as types, from app/messages/schema.py: `python -m app.messages.declarations`.
import type { Note } from './text/catalogue.js';
"""


def declarations() -> str:
    """Types by name, records, and the frame of each kind of message."""
    parts = [HEAD]
    parts += [f"{_comment(about)}export type {name} = {form};\n" for name, (form, about) in TYPES.items()]
    parts += [_interface(name, fields) for name, fields in RECORDS.items()]
    parts += [_interface(name, fields) for name, fields in SHARED.items()]
    for kind, fields in MESSAGES.items():
        own = {"kind": Field(f"'{kind}'"), "shapes": Field("Record<string, number[]>", "of the arrays, by name")}
        parts.append(_interface(FRAMES[kind], fields | own | OF_THE_BROWSER.get(kind, {})))
    parts.append(f"export type Frame = {' | '.join(FRAMES.values())};\n")
    return "\n".join(parts)


def _interface(name: str, fields: Fields) -> str:
    """What it shares with others, the largest part that is one, stands there."""
    parts = [part for part, common in SHARED.items() if part != name and common.items() < fields.items()]
    parts = sorted(parts, key=lambda part: len(SHARED[part]))[-1:]
    known = SHARED[parts[0]] if parts else {}
    lines = [f"  {_line(key, field)}\n" for key, field in fields.items() if "#" not in key and key not in known]
    extends = f" extends {parts[0]}" if parts else ""
    return f"export interface {name}{extends} {{\n{''.join(lines)}}}\n"


def _line(key: str, field: Field) -> str:
    form = "Numbers" if field.is_array else field.form
    if key == "contacts" and field.is_array:  # which are made rows when they are read
        form = "Contact[]"
    about = f"{field.form} {field.about}".strip() if field.is_array else field.about
    shown = re.sub(r"\bNone\b", "null", about)
    return f"{_comment(shown, '')}{key}{'?' if field.optional else ''}: {form};"


def _comment(about: str, end: str = "\n") -> str:
    return f"/** {about} */{end or ' '}" if about else ""


if __name__ == "__main__":
    PLACE.write_text(declarations(), encoding="utf-8")
