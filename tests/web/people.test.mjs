import assert from 'node:assert/strict';
import { test } from 'node:test';

import { People } from '../../web/panels/people.js';
import { sharedLink } from '../../web/panels/roster.js';

const person = (visitor, name) => ({ visitor, name, red: 255, green: 180, blue: 79 });

test('keeps the last list of visitors, oneself first', () => {
  const people = new People();
  let changes = 0;
  people.onChange(() => (changes += 1));
  people.self = 3;
  people.update({ othersAreLost: true, people: [person(1, 'Ada'), person(3, 'Zo\u00eb'), person(4, 'Ada')] });
  assert.equal(people.othersAreLost, true);
  assert.deepEqual(people.all.map(({ visitor }) => visitor), [3, 1, 4]);
  assert.deepEqual(people.find(1), { visitor: 1, name: 'Ada', colour: 'rgb(255 180 79)' });
  people.update({ othersAreLost: false, people: [person(3, 'Zo\u00eb')] });
  assert.equal(people.othersAreLost, false);
  assert.equal(people.find(1), undefined);
  assert.equal(changes, 2);
});

// Fault: a friend who follows the link has the sender's name, or starts a latency test.
test("the link for others keeps the page's address without the visitor's own name and test", () => {
  const link = (href) => sharedLink({ href });
  assert.equal(link('https://grove.example/?name=Ada#x'), 'https://grove.example/');
  assert.equal(link('http://127.0.0.1:8080/?latency=5&name=A%20b&x=1'), 'http://127.0.0.1:8080/?x=1');
});
