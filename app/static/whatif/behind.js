// The table behind what is seen: a dialog that everybody may open, and the state of the view in words above it.
import { make, scrolled, write } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { rowsOfCurves, rowsOfMap, rowsOfTolerance } from './behind_rows.js';

/** @import { Cell, Rows } from './behind_rows.js' */
/** @import { WhatIf } from './whatif.js' */

export class Behind {
  said = make('p', { className: 'help' });
  status = make('p', { className: 'help', role: 'status' });
  table = make('table');
  notes = make('div', { className: 'help' });
  heads = ''; // of the table
  /** @type {HTMLElement[][]} */ cells = []; // by row: value and what stands below it, one after the other

  /**
   * @param {WhatIf} whatif
   * @param {() => void} closed
   */
  constructor(whatif, closed) {
    this.whatif = whatif;
    const title = make('h2', { textContent: text('whatif.as-table'), id: 'whatif-behind' });
    const close = make('button', { type: 'button', className: 'sign', textContent: '✕', title: text('layout.shut') });
    close.ariaLabel = close.title;
    close.onclick = () => this.dialog.close();
    const head = make('header', { className: 'panel-head' }, title, close);
    const area = scrolled(this.table, title.textContent);
    this.dialog = make('dialog', { className: 'whatif-behind' }, head, this.said, area, this.status, this.notes);
    this.dialog.setAttribute('aria-labelledby', title.id);
    this.dialog.onkeydown = (event) => event.stopPropagation(); // to what is behind
    this.dialog.onclick = (event) => {
      if (event.target === this.dialog) this.dialog.close(); // beside it
    };
    this.dialog.onclose = closed;
  }
  open() {
    this.dialog.showModal();
    this.follow();
  }
  /** What is seen as rows, if anything is. */
  get #shown() {
    const { modes, result, tiles, view } = this.whatif;
    const { curves, mode, tolerance } = modes;
    if (mode === 'map') return view && rowsOfMap(view, result);
    if (mode === 'models') return modes.models.rows;
    if (mode === 'curves') return curves.jobs.shown && rowsOfCurves(curves.jobs.shown, [...curves.rows.keys()]);
    return tolerance.jobs.shown && rowsOfTolerance(tolerance.jobs.shown, [...tiles.all.keys()]);
  }
  /** Be of what is seen by now. */
  follow() {
    if (!this.dialog.open) return;
    const { modes, spoken } = this.whatif;
    write(this.said, modes.shown ? (modes.shown.said.textContent ?? '') : spoken.full);
    const rows = this.#shown;
    write(this.status, rows?.whole ? '' : text('whatif.seeking'));
    if (!rows) return;
    this.#head(rows);
    rows.rows.forEach(({ cells }, k) => {
      for (const [n, words] of cells.flat().entries()) write(this.cells[k][n], words);
    });
    const notes = rows.notes.map((textContent) => make('p', { textContent }));
    if (
      notes.map((note) => note.textContent).join('\n') !== [...this.notes.children].map((p) => p.textContent).join('\n')
    )
      this.notes.replaceChildren(...notes);
  }
  /**
   * Heads of columns and rows: where they stay, a reader's place in the table stays, too.
   * @param {Rows} rows
   */
  #head({ caption, columns, corner, groups, rows }) {
    const heads = JSON.stringify([caption, groups, corner, columns, rows.map(({ head }) => head)]);
    if (heads === this.heads) return;
    this.heads = heads;
    const over = make('tr', {}, make('td'), ...groups.map(([name, count]) => headOf('colgroup', name, count)));
    const names = make('tr', {}, ...[corner, ...columns].map((name) => headOf('col', name)));
    const body = make('tbody');
    this.cells = rows.map(({ cells, head }) => {
      const made = cells.map(() => [make('span'), make('small')]);
      body.append(make('tr', {}, headOf('row', head), ...made.map((each) => make('td', {}, ...each))));
      return made.flat();
    });
    this.table.replaceChildren(
      make('caption', { textContent: caption }),
      make('thead', {}, ...(groups.length ? [over] : []), names),
      body,
    );
  }
}

/**
 * @param {'col' | 'row' | 'colgroup'} scope
 * @param {string} textContent
 * @param {number} [colSpan]
 */
const headOf = (scope, textContent, colSpan = 1) => make('th', { scope, textContent, colSpan });
