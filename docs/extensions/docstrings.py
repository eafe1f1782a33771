"""What mkdocstrings does not know of our docstrings: the fixed words that begin a line, and comments beside fields."""

import re

import griffe

FIXED_WORD = re.compile(r"^(Assumes|Error|Cost|Source|Differs):", re.MULTILINE)


class Docstrings(griffe.Extension):
    """Fixed words begin a paragraph; the comment beside a field, which has its unit, becomes its docstring.

    What a class only fills in of its base, and constants of a class, are left out.
    """

    def on_instance(self, *, obj: griffe.Object, **_: object) -> None:
        """Called by Griffe for each object that it has read."""
        if obj.docstring:
            obj.docstring.value = FIXED_WORD.sub(r"\n**\1:**", obj.docstring.value)

    def on_attribute_instance(self, *, attr: griffe.Attribute, **_: object) -> None:
        """Called by Griffe for each attribute that it has read."""
        if str(attr.value).startswith("_"):
            attr.value = None  # a descriptor: how it is kept is of no interest
        if attr.docstring is None and attr.parent and attr.parent.is_class:
            _, found, comment = attr.source.partition("  # ")
            if found and not comment.startswith("fmt:"):
                attr.docstring = griffe.Docstring(comment.strip(), lineno=attr.lineno, parent=attr)

    def on_class_members(self, *, cls: griffe.Class, **_: object) -> None:
        """Called by Griffe for each class when all its members are read."""
        for name, member in list(cls.members.items()):
            field = member.is_attribute and member.annotation
            if not (field or member.has_docstring or member.is_class):
                del cls.members[name]
