"""Pages that tests of one file share, where loading one each would take longest."""

import pytest

from .moved import Shown


@pytest.fixture(scope="module")
def pages(browser, server, windows):
    """By layout."""
    shown = Shown(browser, server, windows)
    yield shown
    shown.close()


@pytest.fixture
def show(pages):
    """Show what a link leads to, in a page that has shown others; at the end as `open_page`."""
    yield pages.show
    assert [error for page in pages.by_layout.values() for error in page.errors if "GL Driver" not in error] == []
    assert [address for page in pages.by_layout.values() for address in page.foreign] == []
