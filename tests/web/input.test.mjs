import assert from 'node:assert/strict';
import { test } from 'node:test';

import { kDefaultKeys } from '../../web/input/bindings.js';
import { Controls, kMaxPitch } from '../../web/input/controls.js';
import { listenToKeyboard } from '../../web/input/keyboard.js';
import { InputSender } from '../../web/input/sender.js';
import { stickAxis, stickKeys } from '../../web/input/stick.js';
import { Turner } from '../../web/input/turner.js';
import { Key } from '../../web/stream/protocol.js';
import { FakeClock } from './fake_clock.mjs';

/** `focus` is what closest() tells of the focused element: the selectors that match it or what is around it. */
function keyboard({ shortcuts = {}, keys = kDefaultKeys, focus = [] } = {}) {
  const window = new EventTarget();
  window.document = new EventTarget();
  window.closest = (selectors) => focus.some((one) => selectors.split(', ').includes(one)) || null;
  const controls = new Controls();
  listenToKeyboard(window, controls, () => keys, shortcuts);
  const fire = (type, code, fields = {}) => {
    const event = Object.assign(new Event(type, { cancelable: true }), { code, key: code, ...fields });
    window.dispatchEvent(event);
    return event;
  };
  return { window, controls, press: fire.bind(null, 'keydown'), lift: fire.bind(null, 'keyup') };
}

test('keys combine and are released one by one', () => {
  const { controls, press, lift } = keyboard();
  press('KeyW');
  press('KeyA');
  press('ShiftLeft');
  assert.equal(controls.keys, Key.forward | Key.left | Key.run);
  lift('KeyA');
  assert.equal(controls.keys, Key.forward | Key.run);
  press('Space');
  assert.equal(controls.keys, Key.forward | Key.run | Key.blow);
});

test('two keys of one action are independent', () => {
  const { controls, press, lift } = keyboard();
  press('KeyW');
  press('ArrowUp');
  lift('KeyW');
  assert.equal(controls.keys, Key.forward);
  lift('ArrowUp');
  assert.equal(controls.keys, 0);
});

test('blur releases everything', () => {
  const { window, controls, press } = keyboard();
  press('KeyD');
  press('KeyQ');
  controls.hold('mouse', Key.blow);
  window.dispatchEvent(new Event('blur'));
  assert.equal(controls.keys, 0);
  assert.equal(controls.turning, null);
});

test('hiding the page releases everything', () => {
  const { window, controls, press } = keyboard();
  press('KeyS');
  window.document.hidden = true;
  window.document.dispatchEvent(new Event('visibilitychange'));
  assert.equal(controls.keys, 0);
});

test("the browser's own shortcuts stay the browser's", () => {
  const { controls, press } = keyboard();
  assert.equal(press('KeyW', { ctrlKey: true }).defaultPrevented, false);
  assert.equal(press('KeyD', { metaKey: true }).defaultPrevented, false);
  assert.equal(controls.keys, 0);
  assert.equal(press('ArrowUp').defaultPrevented, true);
  assert.equal(press('Tab').defaultPrevented, false);
});

test('shortcuts run once per press, with each of their keys', () => {
  let toggled = 0;
  const { press } = keyboard({ shortcuts: { figures: () => (toggled += 1) } });
  press('KeyO');
  press('KeyO', { repeat: true });
  press('F3');
  assert.equal(toggled, 2);
});

test('chosen keys replace the former ones', () => {
  const keys = { ...kDefaultKeys, forward: ['KeyZ', ''], turnLeft: ['KeyJ', ''] };
  const { controls, press } = keyboard({ keys });
  assert.equal(press('KeyW').defaultPrevented, false);
  press('KeyQ');
  assert.deepEqual([controls.keys, controls.turning], [0, null]);
  press('KeyZ');
  press('KeyJ');
  assert.equal(controls.keys, Key.forward);
  assert.ok(controls.turning.yaw > 0);
});

test('typing, buttons and panels do not move the visitor', () => {
  let opened = 0;
  const within = (...focus) => keyboard({ focus, shortcuts: { settings: () => (opened += 1) } });
  const typing = within('select', 'dialog[open]');
  for (const code of ['KeyW', 'KeyP', 'ArrowUp']) assert.equal(typing.press(code).defaultPrevented, false);
  assert.deepEqual([typing.controls.keys, opened], [0, 0]);
  const panel = within('dialog[open]');
  assert.equal(panel.press('ArrowUp').defaultPrevented, false, 'it scrolls');
  assert.equal(panel.controls.keys, 0);
  panel.press('KeyP');
  assert.equal(opened, 1, 'the key that opened it closes it');
  const button = within('button');
  assert.equal(button.press('Space').defaultPrevented, false);
  button.press('KeyW');
  assert.equal(button.controls.keys, Key.forward);
});

test('sensitivity and inversion affect the mouse and not the keys', () => {
  const controls = new Controls();
  controls.setSteering({ sensitivity: 2, invertY: true });
  controls.steer(0.1, 0.2);
  assert.deepEqual([controls.yaw, controls.pitch], [0.2, -0.4]);
  controls.look(0.1, 0.2);
  assert.ok(Math.abs(controls.yaw - 0.3) < 1e-12 && Math.abs(controls.pitch + 0.2) < 1e-12);
  controls.steerAt('stick', 1, 1);
  assert.deepEqual(controls.turning, { yaw: 2, pitch: -2 });
  controls.steerAt('stick', 0, 0);
  assert.equal(controls.turning, null);
});

test('pitch is clamped and yaw stays within half a turn', () => {
  const controls = new Controls();
  controls.look(0, 7);
  assert.equal(controls.pitch, kMaxPitch);
  controls.look(0, -0.5);
  assert.equal(controls.pitch, kMaxPitch - 0.5);
  controls.look(0, -100);
  assert.equal(controls.pitch, -1.5);
  controls.look(3 * Math.PI, 0);
  assert.ok(Math.abs(Math.abs(controls.yaw) - Math.PI) < 1e-9);
  controls.face(0.25, 0);
  assert.equal(controls.yaw, 0.25);
  controls.look(NaN, 0);
  controls.look(0, Infinity);
  assert.deepEqual([controls.yaw, controls.pitch], [0.25, 0]);
});

function sending() {
  const clock = new FakeClock();
  const controls = new Controls();
  const sent = [];
  const sender = new InputSender({ controls, clock, send: (input, now) => sent.push({ ...input, now }) });
  return { clock, controls, sender, sent };
}

test('inputs contain the whole state, count up from 1 and are sent at least once per second', () => {
  const { clock, controls, sender, sent } = sending();
  controls.face(0.5, -0.25);
  assert.equal(sent.length, 0, 'nothing is sent before the start');
  sender.start();
  clock.advance(3000);
  assert.deepEqual(sent.map((input) => [input.number, input.now]), [[1, 0], [2, 1000], [3, 2000], [4, 3000]]);
  controls.hold('key', Key.forward);
  clock.advance(8);
  assert.deepEqual(sent.at(-1), { number: 5, keys: 1, yaw: 0.5, pitch: -0.25, now: 3008 });
});

test('merges changes within 8 ms and always sends the last one', () => {
  const { clock, controls, sender, sent } = sending();
  sender.start();
  for (let i = 0; i < 100; i += 1) {
    controls.look(0.01, 0);
    clock.advance(1);
  }
  clock.advance(8);
  assert.ok(sent.length <= 1 + 108 / 8, `${sent.length} inputs`);
  assert.ok(sent.length >= 12, `${sent.length} inputs`);
  assert.ok(Math.abs(sent.at(-1).yaw - 1) < 1e-9);
  for (let i = 1; i < sent.length; i += 1) assert.ok(sent[i].now - sent[i - 1].now >= 8);
});

test('a stopped sender is silent, and restarts at 1', () => {
  const { clock, controls, sender, sent } = sending();
  sender.start();
  controls.look(1, 0);
  sender.stop();
  clock.advance(5000);
  controls.look(1, 0);
  assert.equal(sent.length, 1);
  sender.start();
  assert.deepEqual([sent.at(-1).number, sent.at(-1).yaw], [1, 2]);
  clock.advance(1000);
  assert.equal(sent.at(-1).number, 2);
});

test('the stick has eight directions, rests in the centre and runs at its edge', () => {
  assert.equal(stickKeys(0.1, -0.1), 0);
  assert.equal(stickKeys(0, -0.6), Key.forward);
  assert.equal(stickKeys(0.5, 0.5), Key.right | Key.back);
  assert.equal(stickKeys(-1, 0), Key.left | Key.run);
  assert.equal(stickKeys(0.6, -0.1), Key.right);
  assert.equal(stickAxis(0.2), 0);
  assert.equal(stickAxis(-1), -1);
});

test('turning depends on time, not on the number of frames', () => {
  const controls = new Controls();
  const frames = [];
  new Turner(controls, (callback) => frames.push(callback));
  const frame = (time) => frames.shift()?.(time);
  controls.turn('key', 2, 0);
  controls.turn('pad', 0, 1);
  for (const time of [1000, 1050, 1060, 1100]) frame(time);
  assert.ok(Math.abs(controls.yaw - 0.2) < 1e-9);
  assert.ok(Math.abs(controls.pitch - 0.1) < 1e-9);
  frame(9000);
  assert.ok(Math.abs(controls.yaw - 0.4) < 1e-9, 'a long pause counts as a tenth of a second');
  controls.turn('key', 0, 0);
  controls.turn('pad', 0, 0);
  frame(9016);
  assert.equal(frames.length, 0);
  assert.ok(Math.abs(controls.yaw - 0.4) < 1e-9);
});
