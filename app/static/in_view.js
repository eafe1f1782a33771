// Draws charts that can be seen at once, and the others when they come into view or once the page has come to rest.

const REST = 250, NEAR = '120px'; // ms without a change; how near to the view counts as in it

export class InView {
  // `parts` have a `chart`; `draw(part)` draws one.
  constructor(parts, draw) {
    Object.assign(this, { parts, paint: draw });
    this.seen = new Set();
    this.owed = new Set();
    const partOf = new Map(parts.map((part) => [part.chart.root, part]));
    const observer = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) {
        this.seen[isIntersecting ? 'add' : 'delete'](partOf.get(target));
        if (isIntersecting) this.pay(partOf.get(target));
      }
    }, { rootMargin: NEAR });
    for (const root of partOf.keys()) observer.observe(root);
  }
  // All charts have changed. `all`: draw them now, wherever they are.
  draw(all = false) {
    clearTimeout(this.resting);
    for (const part of this.parts) {
      this.owed.add(part);
      if (all || this.seen.has(part)) this.pay(part);
    }
    if (this.owed.size) this.resting = setTimeout(() => this.parts.forEach((part) => this.pay(part)), REST);
  }
  pay(part) {
    if (this.owed.delete(part)) this.paint(part);
  }
}
