"""How hypothesis searches, for every test; and what is checked besides: here, and in servers that tests start."""

import os

from hypothesis import HealthCheck, settings

os.environ["IMPACT_CHECK_MESSAGES"] = "1"  # read by app.messages.encoding

# The first call of a kernel compiles it, which no deadline survives; derandomized, so that a run can be repeated.
settings.register_profile(
    "repeatable", deadline=None, derandomize=True, database=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("repeatable")


def pytest_collection_modifyitems(items):
    """Whatever opens a page needs a browser."""
    for item in items:
        if {"browser", "open_page"} & set(item.fixturenames):
            item.add_marker("browser")
