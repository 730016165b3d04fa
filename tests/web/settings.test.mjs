import assert from 'node:assert/strict';
import { test } from 'node:test';

import { kDefaultKeys } from '../../web/input/bindings.js';
import { Settings, kDefaults, streamPreferences } from '../../web/panels/settings.js';
import { kChoices } from '../../web/texts.js';

/** A browser's storage, in which `text` was left. */
function storage(text = null) {
  return {
    text,
    getItem() {
      return this.text;
    },
    setItem(_, value) {
      this.text = value;
    },
  };
}

const left = (values) => new Settings(() => storage(JSON.stringify(values))).values;

test('who never chose has the defaults', () => {
  assert.deepEqual(new Settings(() => storage()).values, kDefaults);
});

test('what was chosen is there the next time, and nothing else is kept', () => {
  const kept = storage();
  new Settings(() => kept).change({ codec: 'jpeg', sensitivity: 1.5, name: 'Ada' });
  assert.deepEqual(JSON.parse(kept.text), { codec: 'jpeg', sensitivity: 1.5, name: 'Ada' });
  assert.deepEqual(new Settings(() => kept).values, { ...kDefaults, codec: 'jpeg', sensitivity: 1.5, name: 'Ada' });
});

test('a value that cannot be costs its own setting only', () => {
  const bad = { codec: 'mpeg2', framesPerSecond: '30', lateLook: 1, keys: 7, old: 3 };
  assert.deepEqual(left({ ...bad, lines: 720, invertY: true }), { ...kDefaults, lines: 720, invertY: true });
});

test('what was left is no settings at all', () => {
  for (const text of ['', 'null', '7', '"x"', '[]', '{', '{"__proto__": {"codec": "jpeg"}}']) {
    assert.deepEqual(new Settings(() => storage(text)).values, kDefaults, text);
  }
});

test('sensitivity is bounded and a number', () => {
  assert.equal(left({ sensitivity: 99 }).sensitivity, 4);
  assert.equal(left({ sensitivity: 0 }).sensitivity, 0.2);
  for (const bad of ['2', null, true]) assert.equal(left({ sensitivity: bad }).sensitivity, 1);
  const settings = new Settings(() => storage());
  settings.change({ sensitivity: NaN });
  assert.equal(settings.values.sensitivity, 1);
});

test('a name has no controls, no edges of nothing and an end', () => {
  assert.equal(left({ name: '  A\u0000d\na\u202e ' }).name, 'Ada');
  assert.equal([...left({ name: '\u{1f332}'.repeat(99) }).name].length, 32);
  assert.equal(left({ name: 7 }).name, '');
});

test('without storage settings last as long as the page, which says so', () => {
  const forbidden = () => {
    throw new Error('SecurityError');
  };
  const full = { ...storage(), setItem: forbidden };
  for (const give of [forbidden, () => full]) {
    const settings = new Settings(give);
    assert.equal(settings.isKept, true);
    settings.change({ lines: 480 });
    assert.equal(settings.values.lines, 480);
    assert.equal(settings.isKept, false);
  }
});

test('changes are told once, and no change is not told', () => {
  const settings = new Settings(() => storage());
  const told = [];
  settings.onChange((values) => told.push(values.lines));
  settings.change({ lines: 720 });
  settings.change({ lines: 720 });
  settings.change({ lines: 721 });
  settings.reset();
  assert.deepEqual(told, [720, 0]);
});

test('a change on another page of the browser is taken over', () => {
  const shared = storage();
  const [here, there] = [new Settings(() => shared), new Settings(() => shared)];
  there.change({ codec: 'h264' });
  here.reload();
  here.change({ lines: 360 });
  assert.deepEqual([here.values.codec, here.values.lines], ['h264', 360]);
});

test('values cannot be changed behind the back', () => {
  const settings = new Settings(() => storage('{"lines": 720}'));
  assert.throws(() => (settings.values.lines = 1), TypeError);
  settings.change({ lines: 480 });
  assert.throws(() => (settings.values.lines = 1), TypeError);
});

test('the server hears of the stream and of nothing else', () => {
  const names = ['codec', 'framesPerSecond', 'kilobitsPerSecond', 'lines', 'lateLook'];
  assert.deepEqual(Object.keys(streamPreferences(kDefaults)), names);
});

test('every choice that the panel offers is one that the settings take', () => {
  for (const [setting, choices] of Object.entries(kChoices)) {
    for (const [value] of choices) {
      assert.equal(left({ [setting]: value, keys: kDefaultKeys })[setting], value, `${setting} ${value}`);
    }
    assert.equal(choices[0][0], kDefaults[setting], `${setting}: the default comes first`);
  }
});
