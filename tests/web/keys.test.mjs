import assert from 'node:assert/strict';
import { test } from 'node:test';

import { actionOf, isBindable, kDefaultKeys, rebind, repairKeys } from '../../web/input/bindings.js';
import { KeyLabels } from '../../web/input/key_labels.js';
import { consequence } from '../../web/panels/key_editor.js';
import { kActions } from '../../web/texts.js';
import { writeKeyHints } from '../../web/panels/key_hints.js';
import { Key } from '../../web/stream/protocol.js';

const codesOf = (keys) => Object.values(keys).flat().filter(Boolean);

test('the default keys are unique, bindable, complete and named', () => {
  const codes = codesOf(kDefaultKeys);
  assert.equal(new Set(codes).size, codes.length);
  assert.ok(codes.every(isBindable));
  for (const action of Object.keys(Key)) assert.ok(kDefaultKeys[action][0], action);
  assert.deepEqual(Object.keys(kActions), Object.keys(kDefaultKeys));
  assert.deepEqual(repairKeys(kDefaultKeys), kDefaultKeys);
});

test('finds the action of a key', () => {
  assert.equal(actionOf(kDefaultKeys, 'ArrowUp'), 'forward');
  assert.equal(actionOf(kDefaultKeys, 'KeyM'), undefined);
  assert.equal(actionOf(kDefaultKeys, ''), undefined, 'a key without a code is not the missing second key');
});

test('refuses keys of the browser', () => {
  for (const code of ['Escape', 'Tab', 'Enter', 'MetaLeft', 'ControlRight', 'F5', '', 'Unidentified', undefined]) {
    assert.equal(isBindable(code), false, code);
  }
  for (const code of ['KeyZ', 'Comma', 'Numpad8', 'F9', 'IntlBackslash']) assert.ok(isBindable(code), code);
});

test('a key in use swaps with its former action', () => {
  const keys = rebind(kDefaultKeys, 'forward', 0, 'KeyS');
  assert.deepEqual([keys.forward, keys.back], [['KeyS', 'ArrowUp'], ['KeyW', 'ArrowDown']]);
  assert.equal(consequence(kDefaultKeys, keys, 'forward', new KeyLabels()), ' Walk back now has W or down arrow.');
  const own = rebind(kDefaultKeys, 'forward', 0, 'ArrowUp');
  assert.deepEqual(own.forward, ['ArrowUp', 'KeyW']);
  assert.deepEqual(rebind(kDefaultKeys, 'forward', 0, 'KeyW'), kDefaultKeys);
});

test('a moved key leaves its former action', () => {
  const keys = rebind(kDefaultKeys, 'blow', 1, 'KeyF');
  assert.deepEqual([keys.blow, keys.fullscreen], [['Space', 'KeyF'], ['', '']]);
  assert.equal(consequence(kDefaultKeys, keys, 'blow', new KeyLabels()), ' Full screen now has no key.');
  assert.deepEqual(kDefaultKeys.blow, ['Space', ''], 'the defaults stay');
});

test('repairs malformed keys per action', () => {
  const broken = { back: 'KeyS', left: ['Escape', ''], right: [7], run: null };
  const keys = repairKeys({ forward: ['KeyZ'], other: ['KeyX'], ...broken });
  assert.deepEqual(keys.forward, ['KeyZ', '']);
  for (const action of Object.keys(broken)) assert.deepEqual(keys[action], kDefaultKeys[action], action);
  assert.equal(keys.other, undefined);
  assert.deepEqual(repairKeys([]), kDefaultKeys);
});

test("of a key that is there twice, the visitor's own choice stays", () => {
  const keys = repairKeys({ screenshot: ['KeyW', 'KeyO'] });
  assert.deepEqual([keys.screenshot, keys.forward, keys.figures], [['KeyW', 'KeyO'], ['', 'ArrowUp'], ['', 'F3']]);
  const codes = codesOf(repairKeys({ left: ['KeyX', 'KeyX'], right: ['KeyX', ''] }));
  assert.equal(new Set(codes).size, codes.length);
});

test('names keys by their caps', async () => {
  const labels = new KeyLabels();
  const codes = ['KeyW', 'Digit1', 'Space', 'ArrowLeft', 'F3', 'Numpad7', 'NumpadAdd', 'Comma', 'ShiftLeft', 'IntlRo'];
  const names = ['W', '1', 'space', 'left arrow', 'F3', 'numpad 7', 'numpad add', ',', 'left shift', 'intl ro'];
  assert.deepEqual(codes.map((code) => labels.name(code)), names);
  assert.equal(labels.label('ArrowLeft'), '\u2190');
  await labels.ask({ keyboard: { getLayoutMap: async () => new Map([['KeyW', 'z'], ['Minus', '\u00df']]) } });
  assert.deepEqual([labels.label('KeyW'), labels.label('Minus')], ['Z', '\u00df']);
  await labels.ask({});
  assert.equal(labels.label('KeyW'), 'Z', 'a browser that does not tell leaves them as they are');
});

test('learns an unknown layout from pressed keys', () => {
  const labels = new KeyLabels();
  assert.equal(labels.learn({ code: 'KeyW', key: 'w' }), false, 'no news');
  assert.equal(labels.learn({ code: 'KeyW', key: 'z' }), true);
  assert.equal(labels.learn({ code: 'KeyW', key: 'z' }), false);
  assert.equal(labels.learn({ code: 'Digit2', key: '@', getModifierState: () => true }), false);
  assert.equal(labels.learn({ code: 'Digit2', key: '"', shiftKey: true }), false);
  for (const key of ['Dead', 'Shift', ' ', undefined]) assert.equal(labels.learn({ code: 'KeyA', key }), false);
  assert.equal(labels.walking(kDefaultKeys), 'ZASD or arrows');
});

test('names well-known groups of walking keys', () => {
  const labels = new KeyLabels();
  assert.equal(labels.walking(kDefaultKeys), 'WASD or arrows');
  const pad = { forward: ['Numpad8', ''], left: ['KeyA', ''], back: ['KeyS', ''], right: ['KeyD', ''] };
  assert.equal(labels.walking(pad), 'numpad 8 A S D');
  const none = Object.fromEntries(Object.keys(pad).map((action) => [action, ['', '']]));
  assert.equal(labels.walking(none), 'no key');
  assert.equal(labels.names(['ShiftLeft', 'ShiftRight']), 'shift');
});

test('hints and buttons name the present keys', () => {
  const hint = { dataset: { keys: 'walking' } };
  const blow = { dataset: { keys: 'blow' } };
  const set = {};
  const button = {
    dataset: { shortcut: 'lookUp' },
    setAttribute: (name, value) => (set[name] = value),
  };
  const document = { querySelectorAll: (selector) => (selector === '[data-keys]' ? [hint, blow] : [button]) };
  const keys = { ...rebind(kDefaultKeys, 'blow', 1, 'KeyB'), lookUp: ['PageUp', 'KeyU'] };
  writeKeyHints(document, keys, new KeyLabels());
  assert.deepEqual([hint.textContent, blow.textContent], ['WASD or arrows', 'space or B']);
  assert.deepEqual([button.title, set['aria-keyshortcuts']], ['Look up (page up or U)', 'PageUp U']);
});
