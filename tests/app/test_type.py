"""Letters of the page have four sizes, and none is below 13 pixels where nobody wants them larger."""

import re
from pathlib import Path

STATIC = Path(__file__).parents[2] / "app" / "static"
SIZES = {"0.8125rem", "0.9375rem", "1.125rem", "1.75rem"}
SIGN = {"18px", "0"}  # of a button, and the words that it stands for
DECLARED = re.compile(r"font-size: ([^;]+);")
DRAWN = re.compile(r"letters\((\d+(?:\.\d+)?)")


def test_style_sheets_have_four_sizes_as_far_as_there_is_room():
    found = {(sheet.name, size) for sheet in STATIC.glob("*/*.css") for size in DECLARED.findall(sheet.read_text())}
    sizes = {size.removeprefix("min(").split(",")[0] for name, size in found if name != "page.css"}
    assert sizes - SIGN == SIZES


def test_pictures_have_no_letters_below_13_pixels():
    sizes = [float(size) for code in STATIC.glob("*/*.js") for size in DRAWN.findall(code.read_text())]
    assert len(sizes) > 10 and min(sizes) >= 13
