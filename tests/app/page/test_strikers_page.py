"""Rods that strike what has no waves are drawn with theirs, beside the body that they meet."""

import pytest

from ..strangers import named

SECTIONS = """
[impactor]
kind = "rods"
velocity = 5.0
rods = [
  {length = 0.3, section = {radius = 0.02}, material = "steel"},
  {length = 0.2, section = {radius = 0.03}, material = "steel"},
]
[contact]
law = "linear"
stiffness = 1e9
[target]
"""
MET = {
    "stop": 'kind = "stop"',
    "mass": 'kind = "mass"\nmass = 2.0',
    "half-space": 'kind = "half-space"\nmaterial = "steel"',
    "spring-mass": 'kind = "spring-mass"\nmass = 0.5\nstiffness = 3e8',
}
# At instants of the contact: the stress at the end of the rods times their section there, and the contact force, both
# in the unit of force; and where rods and the body are drawn, from left to right.
SEEN = """() => {
  const { frame, view } = strikewave.page, { field, stage } = view, [, end] = frame.exact.contacts[0];
  const { strokeRect } = CanvasRenderingContext2D.prototype, edges = [];
  const at = (t, x, y) => { const k = x.findLastIndex((each) => each <= t);
    return y[k] + (t - x[k]) / (x[k + 1] - x[k]) * (y[k + 1] - y[k]); };
  const pairs = [0.2, 0.4, 0.6, 0.8].map((share) => {
    const profile = field.profile(share * end, 'stress', new Float64Array(2001));
    return [-profile[2000], at(share * end, Array.from(frame.exactTime), Array.from(frame.exactForce))];
  });
  CanvasRenderingContext2D.prototype.strokeRect = function (x, y, width, height) {
    if (this.canvas === stage.canvas) edges.push([x, x + width]);
    return strokeRect.call(this, x, y, width, height);
  };
  strikewave.page.player.go(0.5 * end);
  Object.assign(CanvasRenderingContext2D.prototype, { strokeRect });
  return { pairs, edges, width: stage.canvas.clientWidth, face: stage.drawn.rest };
}"""


@pytest.mark.parametrize("kind", MET)
def test_rods_that_strike_are_drawn_with_their_waves(open_page, kind):
    page = open_page(f"?scene={named(SECTIONS + MET[kind])}", drawn=False)
    page.wait("(kind) => window.strikewave?.page.frame?.target.kind === kind", kind)
    page.laid_out()
    found = page.evaluate(SEEN)
    for inside, force in found["pairs"]:
        assert abs(inside) == pytest.approx(force, rel=5e-3)
    (far, joint), (begin, end) = sorted(found["edges"])[:2]
    assert 0 < far < joint and joint == pytest.approx(begin, abs=4)
    assert end == pytest.approx(found["face"], abs=0.05 * found["width"]) and end < 0.8 * found["width"]
