import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Notice } from '../../web/panels/notice.js';

/** An element that counts how often its words were set: a live region reads them out each time. */
class Part {
  hidden = false;
  value = 0;
  spoken = 0;
  #text = '';

  get textContent() {
    return this.#text;
  }

  set textContent(text) {
    this.#text = text;
    this.spoken += 1;
  }

  addEventListener() {}
}

function setUp() {
  const parts = {
    '[data-notice=title]': new Part(),
    '[data-notice=text]': new Part(),
    progress: new Part(),
    button: new Part(),
  };
  const element = { hidden: false, querySelector: (selector) => parts[selector] };
  return {
    notice: new Notice(element, () => {}),
    element,
    title: parts['[data-notice=title]'],
    text: parts['[data-notice=text]'],
    progress: parts.progress,
    button: parts.button,
  };
}

test('shows step and progress', () => {
  const { notice, element, title, text, progress } = setUp();
  notice.hide();
  notice.wait({ percent: 40, step: 'painting the sky' });
  assert.equal(element.hidden, false);
  assert.equal(title.textContent, 'The world is being prepared');
  assert.equal(text.textContent, 'Painting the sky\u2026');
  assert.equal(progress.hidden, false);
  assert.equal(progress.value, 40);
  notice.wait({ percent: 0, step: '' });
  assert.equal(text.textContent, 'One moment\u2026');
});

test('screen readers hear changed words only', () => {
  const { notice, title, text, progress } = setUp();
  for (const percent of [10, 20, 30]) notice.wait({ percent, step: 'painting the sky' });
  assert.equal(progress.value, 30);
  assert.equal(title.spoken, 1);
  assert.equal(text.spoken, 1);
});

test('explains a full server and that it retries', () => {
  const { notice, text } = setUp();
  notice.show('full', 'your address already has the maximum number of visitors');
  assert.match(text.textContent, /^Your address already has the maximum number of visitors\. Trying again every 15 seconds/);
});

test('hides buttons and bars of other states', () => {
  const { notice, progress, button } = setUp();
  notice.show('full', '');
  assert.equal(button.hidden, false);
  notice.wait({ percent: 40, step: '' });
  assert.equal(button.hidden, true);
  notice.show('lost', '');
  assert.equal(progress.hidden, true);
});

test('explains a lost place', () => {
  const { notice, title, text } = setUp();
  notice.show('away', 'your place went to a newcomer while this page was hidden');
  assert.equal(title.textContent, 'Your place went to another visitor');
  assert.match(text.textContent, /^Your place went to a newcomer while this page was hidden\. Trying to enter again/);
});
