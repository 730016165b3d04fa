import assert from 'node:assert/strict';
import { test } from 'node:test';

import { h264Hindrance } from '../../web/stream/browser_abilities.js';
import { streamInWords } from '../../web/panels/settings_panel.js';
import { Telemetry } from '../../web/stream/telemetry.js';
import { Toast } from '../../web/panels/toast.js';
import { FakeClock } from './fake_clock.mjs';

test('describes the stream in one line, also before the first frame', () => {
  const telemetry = new Telemetry();
  assert.equal(streamInWords(telemetry.read(0)), '\u2013');
  const frame = { codec: 1, width: 1280, height: 720, picture: new Uint8Array(125_000), serverMicroseconds: 1000 };
  telemetry.frameReceived(frame, 10);
  telemetry.framePresented(frame, 12);
  assert.equal(streamInWords(telemetry.read(20)), 'JPEG, 1280 \u00d7 720, 1 frames/s, 1.0 Mbit/s');
});

test('explains a browser without H.264', async () => {
  const answering = (answer) => ({ isSecureContext: true, VideoDecoder: { isConfigSupported: answer } });
  assert.equal(await h264Hindrance({ isSecureContext: false }), 'needs https or localhost');
  assert.match(await h264Hindrance({ isSecureContext: true }), /no WebCodecs/);
  assert.match(await h264Hindrance(answering(async () => ({ supported: false }))), /does not decode/);
  assert.match(await h264Hindrance(answering(() => Promise.reject(new TypeError('config')))), /does not decode/);
  assert.equal(await h264Hindrance(answering(async () => ({ supported: true }))), '');
});

test('a toast disappears, and a new one has its full time', () => {
  const clock = new FakeClock();
  const element = {};
  const toast = new Toast(element, clock);
  toast.say('one');
  clock.advance(3000);
  toast.say('two');
  clock.advance(3000);
  assert.equal(element.textContent, 'two');
  clock.advance(1000);
  assert.equal(element.textContent, '');
});
