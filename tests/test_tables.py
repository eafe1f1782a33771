"""What has been measured and is stored with the library: no release whose tables are of other code than its own."""

import pytest

from bench.tables import is_a_release, releases, stale

HEAD = "# Changelog\n\nThe form is that of *Keep a Changelog*.\n\n"
OLDER = "## 0.1.0 – 2026-11-21\n\n### Added\n\n- All.\n"


@pytest.mark.parametrize(
    "changelog, version, is_one",
    [
        ("## Unreleased\n\n### Fixed\n\n- A thing.\n\n" + OLDER, "0.1.0", False),
        ("## Unreleased\n\n" + OLDER, "0.1.0", True),
        (OLDER, "0.1.0", True),
        (OLDER, "0.2.0", False),  # its entry is still to be written
        ("## 0.2.0 – 2026-11-22\n\n- More.\n\n" + OLDER, "0.2.0", True),
        ("", "0.1.0", False),
    ],
)
def test_sources_are_a_release_once_nothing_is_unreleased(changelog, version, is_one):
    assert releases(HEAD + changelog, version) == is_one


def test_no_release_has_tables_of_other_code():
    """Between releases a table may be out of date, and says so; `make tables` measures it anew."""
    assert not is_a_release() or not (found := stale()), f"make tables: {found}"
