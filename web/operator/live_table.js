import { kBeneficiaries } from '../texts.js';

/** Sets only changed text, so that a selection and a screen reader's place stay. */
export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** A table body with changing rows; a row that stays keeps its elements. */
export class LiveTable {
  #body;
  #columns;
  #rows = new Map();

  /** `columns` write a cell each: `(cell, entry) => {}`. The first cell is the row's heading. */
  constructor(body, columns) {
    this.#body = body;
    this.#columns = columns;
  }

  /** Each entry has a `key`; one with a `group` is a heading across all columns. */
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

/** Writes a number over a bar that fills `share(entry)` of the cell. */
export const bar = (share, tell) => (cell, entry) => {
  cell.classList.add('bar');
  cell.style.setProperty('--share', `${(share(entry) ?? 0) * 100}%`);
  write(cell, tell(entry));
};

/** The parts of a frame's cost, for their colours in the style sheet. */
const kParts = {
  'across-user': 'shared',
  'on-demand': 'shared',
  'per-user-backend': 'backend',
  'per-user-frontend': 'frontend',
};

/** Writes the beneficiary of work or memory. */
export const work = (cell, entry) => {
  cell.dataset.part = kParts[entry.work] ?? 'other';
  cell.classList.add('work');
  write(cell, kBeneficiaries[entry.work] ?? String(entry.work));
};
