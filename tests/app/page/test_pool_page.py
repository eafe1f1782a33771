"""Workers that find figures of many impacts, in a browser: of the page as it is served."""

import numpy as np
import pytest

from app.messages.encoding import read_header
from app.messages.solve import solve_frame

from ..wasm.test_mapped import chosen, known

# What a pool makes of rows about the scene that is shown, in so many jobs; and what each column is called.
SOLVED = """async ([names, chosen, jobs]) => {
  const page = performance.getEntriesByType('resource').map(({ name }) => name).find((name) => /page[.]js$/.test(name));
  const { door } = strikewave.page.opening;
  await door.open();
  const Pool = door.whatif.points.own.constructor;
  door.close();
  const { COLUMNS } = await import(page.replace('page.js', 'wasm/answers.js'));
  const waiting = [...jobs], found = [], all = Promise.withResolvers();
  const done = (k) => (rows, spent) => {
    found[k] = rows && { rows: [...rows].map((value) => (Number.isNaN(value) ? null : value)), spent };
    if (Object.keys(found).length === jobs.length) all.resolve();
  };
  const pool = new Pool(() => {
    const rows = waiting.shift();
    return rows ? { chosen, names, rows: new Float64Array(rows), done: done(jobs.length - waiting.length - 1) } : null;
  });
  if (!(await pool.prepare())) return null;
  const { frame } = strikewave.page;
  if (!pool.covers(frame, names)) return 'not covered';
  pool.scene(frame);
  pool.feed();
  await all.promise;
  const { idle, workers: { length } } = pool;
  pool.leave();
  return { columns: COLUMNS, found, idle, length, left: pool.workers.length };
}"""


def solved(page, names: list[str], fixed: dict, jobs: list[np.ndarray]) -> list[np.ndarray]:
    """Figures of the rows of each job, (rows,) with a field for each column."""
    told = page.evaluate(SOLVED, [names, fixed, [rows.ravel().tolist() for rows in jobs]])
    assert told["idle"] and 1 <= told["length"] <= 4 and told["left"] == 0
    columns = [(name, float) for name in told["columns"]]
    return [np.array(each["rows"], float).reshape(-1, len(columns)).view(columns).ravel() for each in told["found"]]


@pytest.mark.browser
@pytest.mark.parametrize(
    "scene, fixed, close",
    [
        ("free-rod", {}, 1e-11),
        ("free-rod", {"law": "hertz"}, 1e-9),
        ("two-balls", {}, 1e-9),
        ("hammer-on-cantilever", {}, 1e-6),  # rounding, which many contacts make larger
    ],
)
def test_points_are_answered_as_the_server_does(show, scene, fixed, close):
    page = show(f"?scene={scene}")
    rows = np.array([[ratio, speed] for ratio in (0.5, 2.0) for speed in (0.5, 3.0)])
    jobs = [rows, rows[1:2], rows[2:]]
    found = solved(page, ["mass_ratio", "speed"], fixed, jobs)
    for given, answers in zip(jobs, found, strict=True):
        assert (answers["status"] == 0).all() and len(given) == len(answers)
        for (ratio, speed), here in zip(given, answers, strict=True):
            there = known(read_header(solve_frame(chosen(scene, mass_ratio=ratio, speed=speed, **fixed))))
            for name in ("contacts", "peak_force", "impactor_velocity", "contact_time"):
                assert here[name] == pytest.approx(there[name], rel=close), (name, ratio, speed)


@pytest.mark.browser
def test_rows_that_are_refused_leave_the_others(show):
    (found,) = solved(show("?scene=fixed-rod"), ["mass_ratio"], {}, [np.array([1.0, -1.0, 2.0, np.nan, 4.0])])
    assert found["status"].tolist() == [0, 1, 0, 1, 0]
    assert np.isnan(found["peak_force"]).tolist() == [False, True, False, True, False]
    (found,) = solved(show("?scene=fixed-rod"), ["mass_ratio"], {"law": "no law"}, [np.array([1.0])])
    assert found["status"].tolist() == [1]


@pytest.mark.browser
def test_what_kernels_do_not_follow_is_not_covered(show):
    assert show("?scene=fixed-rod").evaluate(SOLVED, [["elements"], {}, [[1.0]]]) == "not covered"


@pytest.mark.browser
@pytest.mark.parametrize("absent", ["Worker", "WebAssembly"])
def test_an_old_browser_has_none(open_page, absent):
    page = open_page("?scene=fixed-rod", own=True)
    page.evaluate(f"() => {{ delete globalThis.{absent}; }}")
    assert page.evaluate(SOLVED, [["speed"], {}, [[1.0]]]) is None
