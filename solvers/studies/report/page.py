"""What all reports have in common: where they are written, and the page that their links lead to."""

import re
from pathlib import Path

from ...jit.cache import write_whole
from ...validation import SceneError, allowed

ADDRESS = re.compile(r"https?://[^\s/?#\"<>]+(/[^\s?#\"<>]*)?")  # of a page
FILE = "scene.toml"  # what the scene file is called, where nothing else names it


def checked(path: str | Path) -> Path:
    """Where a report can be written. Raises SceneError for another ending, or a folder that is not there."""
    found = Path(path)
    if found.suffix != ".html":
        raise SceneError("out", str(path), allowed("report-file"))
    if not found.parent.is_dir():
        raise SceneError("out", str(path), allowed("study-folder"))
    return found


def address(page: str) -> str:
    """Of a page, or "". Raises SceneError for what is no address."""
    if page and not ADDRESS.fullmatch(page):
        raise SceneError("page", page, allowed("page-address"))
    return page


def save(html: str, path: str | Path) -> Path:
    """Write a page, in place of one that is there, wholly or not at all. Raises as `checked`; OSError where it cannot
    be written."""
    path = checked(path)
    write_whole(path, html)
    return path
