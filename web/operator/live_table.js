import { kBeneficiaries } from '../texts.js';

/** Sets text only where it changes, so that a selection and a reader's place stay. */
export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** The body of a table whose rows come and go; a row that stays keeps its elements. */
export class LiveTable {
  #body;
  #columns;
  #rows = new Map();

  /** `columns` write a cell each: `(cell, entry) => {}`. The first cell is the row's heading. */
  constructor(body, columns) {
    this.#body = body;
    this.#columns = columns;
  }

  /** `entries` have a `key` each; one with a `group` is the heading of those after it, across all columns. */
  show(entries) {
    const keys = new Set(entries.map(({ key }) => key));
    for (const [key, row] of this.#rows) {
      if (keys.has(key)) continue;
      row.remove();
      this.#rows.delete(key);
    }
    entries.forEach((entry, index) => {
      const row = this.#row(entry);
      if (this.#body.rows[index] !== row) this.#body.insertBefore(row, this.#body.rows[index] ?? null);
      if (entry.group) write(row.cells[0], entry.group);
      else this.#columns.forEach((writeCell, column) => writeCell(row.cells[column], entry));
    });
  }

  #row({ key, group }) {
    const row = this.#rows.get(key) ?? this.#body.ownerDocument.createElement('tr');
    if (this.#rows.has(key)) return row;
    this.#rows.set(key, row);
    if (group) {
      row.className = 'group';
      const cell = row.appendChild(row.ownerDocument.createElement('th'));
      cell.scope = 'rowgroup';
      cell.colSpan = this.#columns.length;
      return row;
    }
    this.#columns.forEach((_, column) => {
      const cell = row.appendChild(row.ownerDocument.createElement(column === 0 ? 'th' : 'td'));
      if (column === 0) cell.scope = 'row';
    });
    return row;
  }
}

/** Writes a cell's text. */
export const text = (tell) => (cell, entry) => write(cell, tell(entry));

/** Writes a number, with a bar behind it that is as long as `share(entry)` of the cell. */
export const bar = (share, tell) => (cell, entry) => {
  cell.classList.add('bar');
  cell.style.setProperty('--share', `${(share(entry) ?? 0) * 100}%`);
  write(cell, tell(entry));
};

/** The part of a frame's cost, as its colour names it. */
const kParts = { 'across-user': 'shared', 'per-user-backend': 'backend', 'per-user-frontend': 'frontend' };

/** Writes whom the work or the memory is for. */
export const work = (cell, entry) => {
  cell.dataset.part = kParts[entry.work] ?? 'other';
  cell.classList.add('work');
  write(cell, kBeneficiaries[entry.work] ?? String(entry.work));
};
