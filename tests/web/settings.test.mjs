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

test('defaults', () => {
  assert.deepEqual(new Settings(() => storage()).values, kDefaults);
});

test('stores choices and nothing else', () => {
  const kept = storage();
  new Settings(() => kept).change({ codec: 'jpeg', sensitivity: 1.5, name: 'Ada' });
  assert.deepEqual(JSON.parse(kept.text), { codec: 'jpeg', sensitivity: 1.5, name: 'Ada' });
  assert.deepEqual(new Settings(() => kept).values, { ...kDefaults, codec: 'jpeg', sensitivity: 1.5, name: 'Ada' });
});

test('a malformed value resets only its setting', () => {
  const bad = { codec: 'mpeg2', framesPerSecond: '30', lateLook: 1, keys: 7, old: 3 };
  assert.deepEqual(left({ ...bad, lines: 720, invertY: true }), { ...kDefaults, lines: 720, invertY: true });
});

test('malformed storage gives the defaults', () => {
  for (const text of ['', 'null', '7', '"x"', '[]', '{', '{"__proto__": {"codec": "jpeg"}}']) {
    assert.deepEqual(new Settings(() => storage(text)).values, kDefaults, text);
  }
});

test('sensitivity is a bounded number', () => {
  assert.equal(left({ sensitivity: 99 }).sensitivity, 4);
  assert.equal(left({ sensitivity: 0 }).sensitivity, 0.2);
  for (const bad of ['2', null, true]) assert.equal(left({ sensitivity: bad }).sensitivity, 1);
  const settings = new Settings(() => storage());
  settings.change({ sensitivity: NaN });
  assert.equal(settings.values.sensitivity, 1);
});

test('names are trimmed, printable and bounded', () => {
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

test('reports each change once', () => {
  const settings = new Settings(() => storage());
  const told = [];
  settings.onChange((values) => told.push(values.lines));
  settings.change({ lines: 720 });
  settings.change({ lines: 720 });
  settings.change({ lines: 721 });
  settings.reset();
  assert.deepEqual(told, [720, 0]);
});

test('adopts changes of other pages', () => {
  const shared = storage();
  const [here, there] = [new Settings(() => shared), new Settings(() => shared)];
  there.change({ codec: 'h264' });
  here.reload();
  here.change({ lines: 360 });
  assert.deepEqual([here.values.codec, here.values.lines], ['h264', 360]);
});

test('values are immutable', () => {
  const settings = new Settings(() => storage('{"lines": 720}'));
  assert.throws(() => (settings.values.lines = 1), TypeError);
  settings.change({ lines: 480 });
  assert.throws(() => (settings.values.lines = 1), TypeError);
});

test('sends only stream settings to the server', () => {
  const names = ['codec', 'framesPerSecond', 'kilobitsPerSecond', 'lines', 'lateLook'];
  assert.deepEqual(Object.keys(streamPreferences(kDefaults)), names);
});

test('the settings accept every choice of the panel', () => {
  for (const [setting, choices] of Object.entries(kChoices)) {
    for (const [value] of choices) {
      assert.equal(left({ [setting]: value, keys: kDefaultKeys })[setting], value, `${setting} ${value}`);
    }
    assert.equal(choices[0][0], kDefaults[setting], `${setting}: the default comes first`);
  }
});
