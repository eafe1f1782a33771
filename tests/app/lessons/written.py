"""Lesson files as tests write them, and what is wrong with them."""

from typing import Any

import pytest

from app.lessons.lesson import Lesson
from app.lessons.problems import LessonError
from app.lessons.reading import read_text

HEAD = """\
---
lesson: tried
version: 1
language: en
title: Tried
scene: fixed-rod
---
"""  # 7 lines
SUMMARY = """\
## End
:::{summary}
say = "So it is."
:::
"""
CHOICE = """\
:::{choice} first
[[option]]
text = "This"
say = "Yes."
right = true
[[option]]
text = "That"
say = "No."
:::
"""
NODES = {
    *("paragraph", "list", "steps", "item", "emphasis", "strong", "link"),
    *("text", "code", "formula", "break", "value"),
}


def lesson(text: str, head: str = HEAD) -> Lesson:
    return read_text(head + text).lesson


def refused(text: str, head: str = HEAD) -> list[tuple[int, str]]:
    """Lines and sentences."""
    with pytest.raises(LessonError) as caught:
        read_text(head + text)
    return [(each.line, each.said()) for each in caught.value.problems]


def fence(kind: str, table: str) -> str:
    """In a step: the fence is in line 9, its table from line 10 on."""
    return f"## Step\n:::{{{kind}}}{'' if kind in ('scene', 'after', 'summary') else ' first'}\n{table}\n:::\n"


def nodes_in(record: Any) -> list[dict[str, Any]]:
    """All nodes of a record."""
    inner = record if isinstance(record, list) else list(record.values()) if isinstance(record, dict) else []
    own = [record] if isinstance(record, dict) and record.get("kind") in NODES and "parts" not in record else []
    own = [each for each in own if each["kind"] != "text" or isinstance(each.get("text"), str)]
    return own + [node for each in inner for node in nodes_in(each)]
