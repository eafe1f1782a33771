"""Maps of impacts in the browser: what a point costs one worker, by kind of impact, a whole map, a slider dragged."""

from playwright.sync_api import sync_playwright

from tests.app.conftest import QUIET, Page, chromium

from . import map_drag
from .serving import served_page
from .size import of, some
from .timing import row

SIDES = (0.2, 5.0), (0.3, 3.0)  # of a map, times what the scene has: mass ratio and speed
COARSE = 1e-5  # of a step through a law: as much as colours show
CASES = {  # query, points on a side
    "a rigid mass on a rod": ("?scene=fixed-rod", 40),
    "Hertz on a rod": ("?scene=fixed-rod&law=hertz", 20),
    "Hunt and Crossley on a rod": ("?scene=fixed-rod&law=hunt-crossley&restitution=0.7", 20),
    "a ball on a bronze rod, Hertz": ("?scene=bronze-rod-steel-ball", 20),
    "two balls": ("?scene=two-balls", 10),
    "rods one behind the other": ("?scene=stepped-rod", 10),
    "a mass on a spring": ("?scene=mass-on-spring", 10),
    "a beam of 20 modes": ("?scene=hammer-on-cantilever", 10),
}
TARGETS = {"a rigid mass on a rod": 100, "Hertz on a rod, long steps": 200}  # ms, a whole map
TIMES = 5

# Medians of ms, of a worker alone and until its answers are there, and how many of the points have one.
MEASURED = """async ([[low, high], [slow, fast], side, tolerance, times]) => {
  const scripts = performance.getEntriesByType('resource').map((each) => each.name);
  const page = scripts.find((each) => /page[.]js$/.test(each));
  const place = (file) => page.replace('page.js', file);
  const { COLUMNS, coverable } = await import(place('wasm/answers.js'));
  const { frame } = strikewave.page, names = ['mass_ratio', 'speed'];
  if (!coverable(frame, names)) return null;
  const module = await WebAssembly.compile(await (await fetch(place('wasm/kernels.wasm'))).arrayBuffer());
  const worker = new Worker(place('wasm/worker.js'), { type: 'module' });
  const said = () => new Promise((done, fail) => {
    worker.onmessage = ({ data }) => done(data);
    worker.onerror = fail;
  });
  worker.postMessage({ kind: 'module', module });
  await said();
  worker.postMessage({ kind: 'scene', frame });
  const rows = new Float64Array(2 * side * side), { chosen } = frame;
  const between = (a, b, k) => a * (b / a) ** (k / (side - 1));
  for (let k = 0; k < side * side; k++) {
    rows[2 * k] = chosen.mass_ratio * between(low, high, k % side);
    rows[2 * k + 1] = chosen.speed * between(slow, fast, Math.floor(k / side));
  }
  const spent = [], waited = [];
  let found;
  for (let job = 0; job <= times; job++) {
    const begun = performance.now();
    worker.postMessage({ kind: 'points', job, chosen: {}, names, rows, tolerance });
    const answer = await said();
    if (job) [spent.push(answer.spent), waited.push(performance.now() - begun)];
    ({ found } = answer);
  }
  worker.terminate();
  const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];
  const answered = found.filter((value, k) => k % COLUMNS.length === 0 && value === 0).length;
  return [median(spent), median(waited), answered];
}"""


def measure() -> dict[str, object]:
    rows = []
    with served_page() as (address, _), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        for name, (query, points) in some(CASES).items():
            page, side = Page(browser, address, query), of(points, 3)
            for tolerance in (0.0, COARSE) if "law=" in query else (0.0,):
                measured = page.evaluate(MEASURED, [*SIDES, side, tolerance, of(TIMES, 1)])
                if measured is None:
                    raise ValueError(f"{query}: no kernel answers it")
                rows += _rows(name + (", long steps" if tolerance else ""), side, *measured)
            page.context.close()
        rows += map_drag.measure(browser, address)
        browser.close()
    return dict(rows)


def _rows(name: str, side: int, spent: float, waited: float, answered: int) -> list:
    target = f"<= {TARGETS[name]}" if name in TARGETS else ""
    return [
        row(f"a point of a map, {name}", 1e3 * spent / side**2, "us"),
        row(f"{side} x {side} points, one worker, {name}", waited, "ms", target),
        row(f"of these have an answer, {name}", answered / side**2, ""),
    ]
