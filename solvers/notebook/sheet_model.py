"""What a report says of methods and contact laws: what they take the bodies for, and what they leave out."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

from ..text.catalogue import library, spoken
from .words import family, text


def model_body(method: str, laws: Iterable[str], paragraphs: Iterable[str]) -> str:
    """`method`: what is said of it, escaped already; the contact laws, and what `limits_of` says."""
    rows = [(text("sheet.method"), method), *((text("sheet.law"), _law(name)) for name in laws)]
    listed = "".join(f"<dt>{escape(name)}</dt><dd>{value}</dd>" for name, value in rows)
    return f"<dl>{listed}</dl>{''.join(f'<p>{escape(each)}</p>' for each in paragraphs)}"


def _law(name: str) -> str:
    said = family("sheet.law-of").get(name, "")
    return f"<b>{escape(name)}</b>{f': {escape(said)}' if said else ''}."


def limits_of(methods: Sequence[Mapping[str, Any]]) -> list[str]:
    """Of methods with their options: what each assumes and leaves out, and what none of them has. Of several each
    stands in a paragraph of its own, behind its name."""
    limits, assumes, said = family("sheet.limits"), family("sheet.assumes"), []
    for method in methods:
        name = str(method["name"])
        left = library(spoken()).texts.get(f"left-out.{method.get('model')}")
        leaves = f"{left[0].upper()}{left[1:]}" if left else limits.get(name, "")
        own = [each for each in (assumes.get(name, ""), leaves) if each]
        said += own if len(methods) == 1 else [f"{name}: {' '.join(own)}"] if own else []
    return [*dict.fromkeys(said), limits["all"]]
