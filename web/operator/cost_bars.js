import { milliseconds } from '../figures.js';
import { kOperator } from '../texts.js';
import { total } from './frame_cost.js';
import { verdict } from './figures_panel.js';
import { write } from './live_table.js';

/** Stacked bars of a frame's cost now and in private mode, on one scale. */
export class CostBars {
  #section;

  constructor(section) {
    this.#section = section;
    for (const stack of section.querySelectorAll('.stack')) {
      for (const part of Object.keys(kOperator.parts)) {
        const piece = stack.appendChild(stack.ownerDocument.createElement('span'));
        piece.dataset.part = part;
      }
    }
  }

  /** `cost` as frameCost() returns it; `null` if unknown. */
  show(cost) {
    const sums = { now: cost ? total(cost.now) : null, alone: cost?.alone ? total(cost.alone) : null };
    const most = Math.max(sums.now ?? 0, sums.alone ?? 0);
    this.#bar('now', kOperator.barNow, cost?.now, sums.now, most);
    this.#bar('alone', kOperator.barAlone, cost?.alone, sums.alone, most);
    for (const [part, name] of Object.entries(kOperator.parts)) {
      const entry = this.#section.querySelector(`.legend [data-part=${part}]`);
      write(entry.querySelector('span'), name);
      write(entry.querySelector('b'), milliseconds(cost?.now[part]));
    }
    write(this.#section.querySelector('#frame-words'), kOperator.aboutFrame);
    write(this.#section.querySelector('#verdict'), verdict(cost, sums));
  }

  #bar(name, title, parts, sum, most) {
    const bar = this.#section.querySelector(`[data-cost=${name}]`);
    bar.hidden = !parts && name === 'alone';
    write(bar.querySelector('[data-cost-part=title]'), title);
    write(bar.querySelector('b'), milliseconds(sum));
    const stack = bar.querySelector('.stack');
    const words = Object.entries(kOperator.parts).map(([part, words]) => `${words} ${milliseconds(parts?.[part])}`);
    stack.setAttribute('aria-label', parts ? words.join(', ') : kOperator.barUnknown);
    for (const piece of stack.children) {
      piece.style.setProperty('width', `${most > 0 && parts ? (parts[piece.dataset.part] / most) * 100 : 0}%`);
    }
  }
}
