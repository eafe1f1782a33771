"""The parser of the command: what it says, too, is in the catalogues."""

import argparse
import re

from .words import family, text

DIRECTIVE = re.compile(r"%(?:\((\w+)\))?[sr]")
WORD = re.compile(r"[a-z]+")


class Refused(Exception):
    """A line for the user; the command ends with 2."""


class _Once(argparse.Action):
    """A value that is given once: a second one would be kept in place of the first, without a word."""

    def __call__(self, parser, namespace, values, option_string=None):
        given = namespace.__dict__.setdefault("_given", {})
        if self.dest in given:
            values = {"option": self.option_strings[-1], "first": given[self.dest], "second": values}
            parser.error(text("parser.given-twice", **values))
        given[self.dest] = values
        setattr(namespace, self.dest, values)


class Parser(argparse.ArgumentParser):
    """Its refusals are raised as `Refused`."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.register("action", None, _Once)
        self.register("action", "store", _Once)
        self._negative_number_matcher = re.compile(r"-\.?\d")  # -3e-4 is a value too, not an option, before 3.14

    def error(self, message):
        raise Refused(text("run.see-help", message=message))


def _said(english: str) -> str:
    """Our sentence for one of argparse, with its directives as values: its code is the words of that one."""
    code = "-".join(WORD.findall(DIRECTIVE.sub("", english)))
    gaps = {found[1] or "given": found[0] for found in DIRECTIVE.finditer(english)}
    return text(f"parser.{code}", **gaps) if code in family("parser") else english


TRANSLATED = "_"  # the name by which argparse looks for a translation
setattr(argparse, TRANSLATED, _said)
