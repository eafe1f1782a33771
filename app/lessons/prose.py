"""Text of a lesson: CommonMark without markup of its own, as a tree of nodes."""

import re
from collections.abc import Collection, Iterator
from functools import cache

from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.colon_fence import colon_fence_plugin
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.front_matter import front_matter_plugin
from mdit_py_plugins.myst_blocks import myst_block_plugin

from .lesson import Node, Sentence
from .problems import Problems

DEEPEST = 12  # levels of lists and emphasis
GAP = re.compile(r"\{([a-z]{1,20})\}")  # that the page fills
KINDS = {
    "paragraph_open": "paragraph",
    "bullet_list_open": "list",
    "ordered_list_open": "steps",
    "list_item_open": "item",
    "em_open": "emphasis",
    "strong_open": "strong",
    "link_open": "link",
}
BLOCKS = {
    "image": "image",
    "fence": "code",
    "code_block": "code",
    "heading_open": "heading",
    "blockquote_open": "quote",
    "hr": "rule",
    "math_block": "formula",
}
COMMENT = "myst_line_comment"


class _Markdown(MarkdownIt):
    def validateLink(self, url: str) -> bool:
        """All are read as links: what cannot be is refused with its line, and does not become text in silence."""
        return True


@cache
def markdown() -> MarkdownIt:
    """The reader of lesson files: markup is text, a line that begins with % is a comment."""
    found = _Markdown("commonmark", {"html": False})
    found.use(front_matter_plugin).use(colon_fence_plugin).use(myst_block_plugin)
    found.use(dollarmath_plugin, allow_labels=False, allow_space=False, allow_digits=False)
    found.disable(["myst_block_break", "myst_target", "html_block", "html_inline"])
    return found


def sentence(written: str, line: int, problems: Problems, gaps: Collection[str] = (), key: str = "") -> Sentence:
    """Nodes of one sentence; `gaps`: names that may stand in braces."""
    tokens = markdown().parseInline(written)
    for token in tokens:
        token.map = None  # which begins at the sentence, not at the file
    return _Tree(problems, line, gaps, key).of(tokens)


def paragraphs(tokens: list[Token], problems: Problems) -> Sentence:
    """Nodes of the tokens of whole blocks; what is no text is a problem of its line."""
    return _Tree(problems, 1, None, "").of(tokens)


class _Tree:
    """The nodes of a list of tokens, which open and close."""

    def __init__(self, problems: Problems, line: int, gaps: Collection[str] | None, key: str):
        self.problems, self.line, self.gaps, self.key = problems, line, gaps, key

    def of(self, tokens: list[Token]) -> Sentence:
        """Raises nothing: what cannot be is noted and left out."""
        stack: list[tuple[str, str, list[Node]]] = [("", "", [])]
        depth = 0  # levels that are open beyond the deepest
        for token in self._flat(tokens):
            if token.nesting == 1 and (depth or len(stack) > DEEPEST):
                if not depth:
                    self.problems.add(self.line, "too-deep", most=DEEPEST)
                depth += 1
            elif token.nesting == -1 and depth:
                depth -= 1
            elif token.nesting == 1:
                stack.append((KINDS.get(token.type, ""), self._target(token), []))
            elif token.nesting == -1:
                kind, target, nodes = stack.pop()
                whole = tuple(_joined(nodes))
                stack[-1][2].extend([Node(kind, nodes=whole, target=target)] if kind else whole)
            else:
                stack[-1][2].extend(self._leaf(token))
        return tuple(_joined(stack[0][2]))

    def _flat(self, tokens: list[Token]) -> Iterator[Token]:
        """Blocks and what is in their lines, one after the other."""
        for token in tokens:
            if token.map:
                self.line = token.map[0] + 1
            if token.type in BLOCKS:
                self.problems.add(self.line, "block", what=BLOCKS[token.type])
            if token.type == "inline":
                yield from self._flat(token.children or [])
            elif token.type not in (COMMENT, "image") and (token.nesting or token.type not in BLOCKS):
                yield token

    def _target(self, token: Token) -> str:
        if token.type != "link_open":
            return ""
        target = str(token.attrGet("href") or "")
        if not target.lower().startswith(("http://", "https://")):
            self.problems.add(self.line, "link", value=repr(target[:60]))
            return ""
        return target

    def _leaf(self, token: Token) -> Iterator[Node]:
        if token.type == "code_inline":
            yield Node("code", token.content)
        elif token.type == "math_inline":
            yield Node("formula", token.content)
        elif token.type == "hardbreak":
            yield Node("break")
        elif token.type == "softbreak":
            self.line += 1
            yield Node("text", " ")
        elif token.type == "colon_fence":
            self.problems.add(self.line, "fence-inside", fence=fence_of(token))
        elif token.content:
            yield from self._with_gaps(token.content)

    def _with_gaps(self, words: str) -> Iterator[Node]:
        if self.gaps is None:
            yield Node("text", words)
            return
        for number, piece in enumerate(GAP.split(words)):
            if number % 2 and piece in self.gaps:
                yield Node("value", piece)
            elif number % 2:
                names = ", ".join(self.gaps) or "none"
                self.problems.add(self.line, "placeholder", key=self.key, value=piece, names=names)
            elif piece:
                yield Node("text", piece)


def fence_of(token: Token) -> str:
    """How a fence begins, as it is repeated in a refusal."""
    return (token.markup + token.info).strip()[:60]


def _joined(nodes: list[Node]) -> Iterator[Node]:
    """Texts that follow each other as one."""
    kept = None
    for node in nodes:
        if kept and kept.kind == node.kind == "text":
            kept = Node("text", kept.text + node.text)
            continue
        if kept:
            yield kept
        kept = node
    if kept:
        yield kept


def plain(nodes: Sentence) -> str:
    """The words alone."""
    return "".join(node.text + plain(node.nodes) for node in nodes)
