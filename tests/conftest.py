"""How hypothesis searches, in which order files are begun, and what tests check besides, in servers they start too."""

import gc
import os
import sys

import pytest
from hypothesis import HealthCheck, settings

from solvers.jit.shortcuts import shorten

# What is loaded and collected stays till the end: to look through it again and again, meanwhile and later, takes each
# worker a third of its time until the first test.
gc.disable()

shorten()
os.environ["IMPACT_CHECK_MESSAGES"] = "1"  # read by app.messages.encoding

# Where no bytecode may be written (as in images of Python), each worker would compile all tests anew, 12 s, and each of
# the many processes that tests start the library and Panel.
sys.dont_write_bytecode = False
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

# The first call of a kernel compiles it, which no deadline survives; derandomized, so that a run can be repeated.
settings.register_profile(
    "repeatable", deadline=None, derandomize=True, database=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("repeatable")


# Files of few tests that take longest, begun first: else one core would wait at the end for what the other has begun.
LONGEST = (
    "test_module", "test_form", "test_language_page", "test_patterns", "test_estimates", "test_machines",
    "test_connection_page", "test_limits", "test_panels_page", "test_analyses", "test_figures_page",
    "test_workspace_page", "test_provenance", "test_js", "test_docs", "test_workers", "test_main",
)  # fmt: skip


def pytest_collection_modifyitems(items):
    """Whatever opens a page needs a browser, and what starts a server takes seconds."""
    order = {name: place for place, name in enumerate(LONGEST)}
    items.sort(key=lambda item: order.get(item.path.stem, len(LONGEST)))
    for item in items:
        if {"browser", "open_page"} & set(item.fixturenames):
            item.add_marker("browser")
        if {"server", "own_server"} & set(item.fixturenames):
            item.add_marker("slow")


@pytest.hookimpl(tryfirst=True)
def pytest_runtestloop():
    gc.freeze()
    gc.enable()
