"""Arrays of a solve come from memory that the process has."""

import subprocess
import sys

import pytest

from ...patience import SECONDS

# Of the C library that fetches each anew unless told otherwise; what is counted is on Linux only
SOLVES = """
import resource
import solvers

scene = solvers.load("figure-5.1")
for _ in range(3):
    solvers.solve(scene).table()
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for _ in range(5):
    solvers.solve(scene).table()
print((resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before) / 5)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="a matter of its C library")
def test_solves_fetch_no_new_pages():
    """Some 6000 for each otherwise, which take as long as the solve."""
    found = subprocess.run([sys.executable, "-c", SOLVES], capture_output=True, text=True, check=True, timeout=SECONDS)
    assert float(found.stdout) < 500
