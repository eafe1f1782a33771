"""Whatever is in a file, it is read or refused, and no markup comes out."""

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.lessons.problems import LessonError, Problems
from app.lessons.prose import markdown, paragraphs
from app.lessons.reading import read_text
from app.lessons.record import lesson_record
from app.lessons.shipped import FOLDER

from .written import HEAD, NODES, nodes_in

LINES = (FOLDER / "bounce-twice.md").read_text("utf-8").splitlines()
PIECES = [
    *("---", "...", "title: &a [*a]", "? [x]", "!!timestamp now: !!int ''", "version: 1e9", "<<: *a", "\t: {", "% no"),
    *("## ", "##", "### x", "Title\n---", "> q", "- ", "1. ", "    code", "```", "$$", "$x$", "+++", "(a)="),
    *(":::", "::::", ":::{scene}", ":::{scene} x", ":::{choice} a", ":::{number} n", ":::{sketch} s", ":::{after}"),
    *(":::{set} t", ":::{order} o", ":::{summary}", ":::{", "- :::{scene}"),
    *("[[option]]", "[option]", "[[judge]]", "[[found]]", "changes = { law = [] }", "changes = { modes = 1e400 }"),
    *(
        "right = true",
        'goal = "contacts = nan"',
        "range = [nan, inf]",
        'within = "nan %"',
        "answer = 1e400",
        "play = [[]]",
    ),
    *(
        'at = "touch-9"',
        "given = [true, 1]",
        "a.b.c = 1",
        "a = '''",
        'say = "{x} ![](y) <i>"',
        "units = [1]",
        "show = {}",
    ),
    *(
        "<script>alert(1)</script>",
        "<!-- -->",
        "&#60;b&#62;",
        "![a](b)",
        "[a](javascript:b)",
        "<https://a.b>",
        "**" * 40,
    ),
    *("[" * 60, "- " * 40, "*_" * 60, "`", "\\", "\x00", "\ufeff", "\u2028", "\x0b"),
]
pieces = st.lists(st.sampled_from(PIECES) | st.sampled_from(LINES) | st.text(max_size=30), max_size=40).map("\n".join)


def assert_read_or_refused(text):
    try:
        record = lesson_record(read_text(text).lesson)
    except LessonError as error:
        assert error.problems
        count = len(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"))
        for problem in error.problems:
            assert 1 <= problem.line <= count + 1
            assert problem.said().isprintable()
        return
    json.dumps(record, allow_nan=False)
    for node in nodes_in(record):
        assert node["kind"] in NODES
        assert node.get("target", "https://").lower().startswith(("http://", "https://"))


@settings(max_examples=300, deadline=None)
@given(pieces, st.booleans())
def test_random_text_is_read_or_refused(text, headed):
    assert_read_or_refused(HEAD + "## Step\n" + text if headed else text)


@settings(max_examples=200, deadline=None)
@given(st.data())
def test_a_lesson_with_some_lines_changed_is_read_or_refused(data):
    lines = list(LINES)
    for _ in range(data.draw(st.integers(1, 4))):
        place = data.draw(st.integers(0, len(lines) - 1))
        lines[place : place + data.draw(st.integers(0, 2))] = [data.draw(st.sampled_from([*PIECES, *LINES]))]
    assert_read_or_refused("\n".join(lines))


@settings(max_examples=200, deadline=None)
@given(st.text(st.sampled_from("<>&;abi/=\"' \n!-"), max_size=80))
def test_markup_is_text(text):
    """What a browser would take for tags is in text alone, where the page puts it as words."""

    def kinds(nodes):
        return {node.kind for node in nodes} | {kind for node in nodes for kind in kinds(node.nodes)}

    assert kinds(paragraphs(markdown().parse(text), Problems())) <= NODES


@pytest.mark.slow
def test_deep_and_long_texts_take_no_long():
    for text in (
        "*" * 100_000,
        "[" * 100_000,
        "> " * 50_000,
        "- " * 50_000,
        "$" * 100_000,
        "a: " * 60_000,
        ":" * 100_000,
    ):
        assert_read_or_refused(HEAD + "## Step\n" + text)
        assert_read_or_refused("---\n" + text[:9_000] + "\n---\n")
