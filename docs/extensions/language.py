"""The language of a page, which its folder names: what screen readers and browsers go by."""

from typing import Any


def on_post_page(output: str, page: Any, **_: object) -> str:
    """Called by MkDocs with the HTML of each page."""
    folder, _, name = page.file.src_uri.partition("/")
    return output.replace('<html lang="en"', f'<html lang="{folder}"', 1) if name else output
