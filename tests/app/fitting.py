"""What does not fit on the page, found in the browser: words cut or lying on others, and what is out of reach."""

INSTANTS = [0, 0.1, 0.35, 0.6, 1]  # as shares of the impact

# Words drawn on canvases that leave them, or lie on other words; at instants of the impact.
DRAWN = """(instants) => {
  const { page } = strikewave;
  const context = CanvasRenderingContext2D.prototype;
  const { fillText } = context;
  const found = new Set();
  const seen = (canvas) => canvas.isConnected && canvas.checkVisibility();
  for (const share of instants) {
    const written = new Map();
    context.fillText = function (text, x, y) {
      const box = this.measureText(text), place = this.getTransform();
      const { x: left, y: top } = place.transformPoint({
        x: x - box.actualBoundingBoxLeft, y: y - box.actualBoundingBoxAscent });
      const { x: right, y: bottom } = place.transformPoint({
        x: x + box.actualBoundingBoxRight, y: y + box.actualBoundingBoxDescent });
      const words = written.get(this.canvas) ?? [];
      if (text.trim()) written.set(this.canvas, [...words, { text, left, top, right, bottom }]);
      return fillText.call(this, text, x, y);
    };
    page.player.go(share * page.player.duration);
    for (const [canvas, words] of written)
      for (const [k, { text, left, top, right, bottom }] of seen(canvas) ? words.entries() : []) {
        if (left < -1 || top < -1 || right > canvas.width + 1 || bottom > canvas.height + 1) found.add(`cut: ${text}`);
        for (const other of words.slice(k + 1))
          if (Math.min(right, other.right) - Math.max(left, other.left) > 1 &&
              Math.min(bottom, other.bottom) - Math.max(top, other.top) > 1)
            found.add(`overlap: ${text}, ${other.text}`);
      }
  }
  context.fillText = fillText;
  return [...found];
}"""

# For those below.
ELEMENTS = """
  const all = (root) => [...root.querySelectorAll('*')].flatMap((e) => [e, ...(e.shadowRoot ? all(e.shadowRoot) : [])]);
  const above = (e) => e.parentElement ?? e.getRootNode().host;
  const layer = (e) => { // what lies above all else, and hides what is below it
    for (let each = e; each; each = above(each)) {
      const { backgroundColor, position } = getComputedStyle(each);
      if (!['static', 'relative'].includes(position) && !/transparent|, 0\\)$/.test(backgroundColor)) return each;
    }
  };
"""

# Words of the page that their boxes cut off, that are beyond the window with nothing to scroll, or that lie on others.
WRITTEN = (
    f"() => {{{ELEMENTS}"
    + """
  const own = (e) => [...e.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
  const clipped = (e) => getComputedStyle(e).clipPath !== 'none';
  const words = all(document).filter((e) => own(e) && e.checkVisibility({ visibilityProperty: true })
    && !['OPTION', 'SCRIPT', 'STYLE'].includes(e.tagName) && !clipped(e) && !e.closest('.unseen, svg'));
  const found = new Set();
  const boxes = words.map((e) => {
    const text = e.textContent.trim().slice(0, 40);
    const { overflowX } = getComputedStyle(e);
    if (['hidden', 'clip'].includes(overflowX) && e.scrollWidth > e.clientWidth + 1) found.add(`cut: ${text}`);
    const range = document.createRange();
    range.selectNodeContents(e);
    let [left, top, right, bottom, scrolls] = [-Infinity, -Infinity, Infinity, Infinity, false];
    for (let box = above(e); box; box = above(box)) {
      const { overflowX: across, overflowY: down } = getComputedStyle(box);
      if (across === 'visible' && down === 'visible') continue;
      const edge = box.getBoundingClientRect();
      [left, top] = [Math.max(left, edge.left), Math.max(top, edge.top)];
      [right, bottom] = [Math.min(right, edge.right), Math.min(bottom, edge.bottom)];
      scrolls ||= [across, down].some((how) => ['auto', 'scroll'].includes(how));
    }
    return [...range.getClientRects()].filter((box) => box.width > 1).flatMap((box) => {
      if (!scrolls && (box.right > innerWidth + 1 || box.left < -1)) found.add(`beyond: ${text}`);
      const part = { text, e, left: Math.max(box.left, left), top: Math.max(box.top, top),
        right: Math.min(box.right, right), bottom: Math.min(box.bottom, bottom) };
      return part.right - part.left > 2 && part.bottom - part.top > 2 ? [part] : [];
    });
  }).flat();
  const apart = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) <= 3 ||
    Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) <= 4 || a.e.contains(b.e) || b.e.contains(a.e);
  boxes.forEach((a, k) => {
    for (const b of boxes.slice(k + 1))
      if (!apart(a, b) && layer(a.e) === layer(b.e)) found.add(`overlap: ${a.text}, ${b.text}`);
  });
  return [...found];
}"""
)

# What can be pressed or typed into, and is out of the window or below something else wherever it is scrolled to.
UNREACHED = (
    f"() => {{{ELEMENTS}"
    + """
  const within = (e, outer) => { for (let each = e; each; each = above(each)) if (each === outer) return true; };
  const at = (x, y) => { let e = document.elementFromPoint(x, y);
    while (e?.shadowRoot?.elementFromPoint(x, y) && e.shadowRoot.elementFromPoint(x, y) !== e)
      e = e.shadowRoot.elementFromPoint(x, y);
    return e; };
  const away = (e) => { // folded to nothing
    for (let each = above(e); each; each = above(each))
      if (each.clientHeight < 3 && getComputedStyle(each).overflowY !== 'visible') return true;
  };
  const found = new Set();
  for (const e of all(document)) {
    if (!['BUTTON', 'INPUT', 'SELECT', 'SUMMARY', 'TEXTAREA'].includes(e.tagName) || e.disabled || e.closest('[inert]')
      || !e.checkVisibility({ visibilityProperty: true, opacityProperty: true }) || e.matches('.skip')) continue;
    e.scrollIntoView({ block: 'center', inline: 'nearest', behavior: 'instant' });
    const { bottom, height, left, right, top, width } = e.getBoundingClientRect();
    if (away(e)) continue;
    if (width < 3 || height < 3) continue;
    const name = (e.ariaLabel || e.textContent || e.labels?.[0]?.textContent || e.className).trim().slice(0, 40);
    if (left < -1 || top < -1 || right > innerWidth + 1 || bottom > innerHeight + 1) found.add(`out of reach: ${name}`);
    const over = at((left + right) / 2, (top + bottom) / 2);
    const own = !over || within(over, e) || within(e, over) || [...(e.labels ?? [])].some((each) => within(over, each))
      || layer(over) !== layer(e); // such as an open menu
    if (!own) found.add(`covered: ${name}, by ${(over.className || over.tagName).toString().slice(0, 30)}`);
  }
  return [...found];
}"""
)


def lettered(pixels: int) -> str:
    """A script that has letters so large from the first on: for a window of one's own."""
    return f"""new MutationObserver((_, seen) => {{
      if (!document.documentElement) return;
      document.documentElement.style.fontSize = '{pixels}px';
      seen.disconnect();
    }}).observe(document, {{ childList: true }})"""


LARGE = lettered(24)  # as for a projector

# Bars of scrolling that the document has: the page is as large as the window.
SCROLLED = """() => {
  const { scrollHeight, scrollWidth } = document.documentElement;
  return [...(scrollWidth > innerWidth ? [`${scrollWidth} wide`] : []),
    ...(scrollHeight > innerHeight ? [`${scrollHeight} high`] : [])];
}"""
