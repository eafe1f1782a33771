"""Letters stand out from their ground, in light and dark, also while an answer is awaited (WCAG 2, 1.4.3)."""

import re
from pathlib import Path

import pytest

import app

SHEETS = sorted((Path(app.__file__).parent / "static").rglob("*.css"))
RULES = [
    (path.name, " ".join(selector.split()), body)
    for path in SHEETS
    for selector, body in re.findall(
        r"([^{}]+)\{([^{}]*)\}", re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    )
]
NAMED = {name: colour for *_, body in RULES for name, colour in re.findall(r"(--[\w-]+):\s*(#[0-9a-f]+)", body)}
LEAST = 4.5
WHITE = (1.0, 1.0, 1.0)
TURNED = ((-0.574, 1.43, 0.144), (0.426, 0.43, 0.144), (0.426, 1.43, -0.856))  # hue-rotate(180deg)
BUSY = ".analysis[aria-busy='true'] "


def colour_of(written: str) -> tuple[float, ...]:
    digits = written.lstrip("#")
    digits = "".join(2 * each for each in digits) if len(digits) == 3 else digits
    return tuple(int(digits[k : k + 2], 16) / 255 for k in (0, 2, 4))


def dark(colour: tuple[float, ...]) -> tuple[float, ...]:
    """As the dark scheme turns it over, `invert(0.93) hue-rotate(180deg)`."""
    turned = [0.93 - 0.86 * part for part in colour]
    return tuple(min(max(sum(m * part for m, part in zip(row, turned, strict=True)), 0.0), 1.0) for row in TURNED)


def contrast(one: tuple[float, ...], other: tuple[float, ...]) -> float:
    def luminance(colour):
        red, green, blue = (v / 12.92 if v <= 0.03928 else ((v + 0.055) / 1.055) ** 2.4 for v in colour)
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


LETTERS = sorted(
    {
        (sheet, selector, NAMED.get(colour.removeprefix("var(").removesuffix(")"), colour))
        for sheet, selector, body in RULES
        for colour in re.findall(r"(?<![-\w])color:\s*(#[0-9a-f]+|var\(--[\w-]+\))", body)
        if "background" not in body and ":disabled" not in selector and "::before" not in selector
    }
)


@pytest.mark.parametrize("sheet, selector, written", LETTERS)
def test_letters_on_a_panel_can_be_read(sheet, selector, written):
    if written in ("#fff", NAMED["--panel"]):
        pytest.skip("on a ground of its own")
    colour = colour_of(written)
    assert contrast(colour, WHITE) >= LEAST
    assert contrast(dark(colour), dark(WHITE)) >= LEAST


def test_no_words_are_made_faint():
    faint = [(sheet, selector) for sheet, selector, body in RULES if re.search(r"(?<!-)opacity:\s*0?\.\d", body)]
    assert faint == []


def test_what_is_awaited_is_only_without_colours():
    """That makes letters darker: the grey of a colour has no more luminance than the colour."""
    busy = [body for _, selector, body in RULES if selector.startswith(BUSY)]
    assert busy and all(re.findall(r"filter: ([^;]+);", body) == ["grayscale(1)"] for body in busy)
    for _, _, written in LETTERS:
        colour = colour_of(written)
        grey = (sum(w * part for w, part in zip((0.2126, 0.7152, 0.0722), colour, strict=True)),) * 3
        assert contrast(grey, WHITE) >= contrast(colour, WHITE) * (1.0 - 1e-9)
