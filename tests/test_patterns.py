"""No regular expression takes long over what anybody may send: each is fed the worst that can be made for it."""

import json
import re
import subprocess
import time

import pytest

from app.text.catalogues import script
from solvers.text.catalogue import SOURCE

from .patience import SECONDS
from .patterns import ROOT, hostile, of_javascript, of_python, with_patterns

LENGTHS = (30, 100, 300, 1_000, 3_000, 10_000)  # a cubic pattern is seen before, and never gets to 10 000
MOST = 5.0  # [s] of computing; a search that begins anew at each letter takes 0.1 to 2 s
SLOWEST = 2  # texts that are tried at the next length
FEED = """
const given = JSON.parse((await import('node:fs')).readFileSync(0, 'utf-8'));
for (const [file, pattern, flags, texts] of given.patterns) {
  let left = texts;
  for (const length of given.lengths) {
    const taken = left.map(([before, piece, end]) => {
      const text = before + piece.repeat(length / piece.length) + end;
      const begun = process.cpuUsage();
      text.search(new RegExp(pattern, flags));
      const { user, system } = process.cpuUsage(begun);
      return [(user + system) / 1e6, [before, piece, end]];
    });
    taken.sort(([a], [b]) => b - a);
    if (taken[0][0] > given.most) {
      console.log(file, pattern, JSON.stringify(taken[0]), length);
      process.exit(1);
    }
    left = taken.slice(0, given.slowest).map(([, text]) => text);
  }
}
"""


def slowest(match, texts, length, most):
    """Those texts that take longest; none may take more seconds of computing than `most`."""
    taken = []
    for before, piece, end in texts:
        text = before + piece * (length // len(piece)) + end
        begun = time.thread_time()
        match(text)
        taken.append((time.thread_time() - begun, (before, piece, end)))
        assert taken[-1][0] < most, (taken[-1], length)
    return [text for _, text in sorted(taken, reverse=True)[:SLOWEST]]


SLOW = "solvers/jit/cache.py"


@pytest.mark.parametrize(
    "file", [pytest.param(file, marks=[pytest.mark.slow] * (file == SLOW)) for file in with_patterns()]
)
def test_no_pattern_of_the_library_or_the_server_takes_long(file):
    for where, pattern, searched in of_python(file):
        print(where)
        feed(pattern, searched, MOST)


def feed(pattern, searched, most):
    for match in (pattern.fullmatch, pattern.search if searched else pattern.match):
        texts = hostile(pattern.pattern)
        for length in LENGTHS:
            texts = slowest(match, texts, length, most)


@pytest.mark.slow
def test_a_cubic_pattern_would_be_found():
    cubic = re.compile(r"t(?:\s*\[\s*([^\]]*?)\s*\])?")
    with pytest.raises(AssertionError):
        feed(cubic, False, MOST / 27)  # at 1 000 letters: at 3 000 it takes 27 times as long


@pytest.mark.browser
def test_no_pattern_of_the_page_takes_long():
    texts = ROOT / "build/texts.mjs"
    texts.parent.mkdir(exist_ok=True)
    texts.write_text(script(SOURCE), encoding="utf-8")
    patterns = [(*each, hostile(each[1])) for each in of_javascript()]
    assert len(patterns) > 20
    given = json.dumps({"patterns": patterns, "lengths": LENGTHS, "most": MOST, "slowest": SLOWEST})
    call = ["node", "--input-type=module", "--eval", FEED]
    found = subprocess.run(call, cwd=ROOT, input=given, capture_output=True, text=True, timeout=SECONDS)
    assert found.returncode == 0, found.stdout + found.stderr
