import { Backoff } from './backoff.js';
import { h264Hindrance } from './browser_abilities.js';
import { Codecs } from './codecs.js';
import { Connection } from './connection.js';
import { decoders } from './decoders.js';
import { Decoding } from './decoding.js';
import { Display, paintScheduler } from './display.js';
import { Fullscreen } from './fullscreen.js';
import { Hint } from './hint.js';
import { listenToBlowButton } from './input/blow_button.js';
import { Controls } from './input/controls.js';
import { listenToGamepads } from './input/gamepad.js';
import { KeyLabels } from './input/key_labels.js';
import { listenToKeyboard } from './input/keyboard.js';
import { listenToMouse } from './input/mouse.js';
import { InputSender } from './input/sender.js';
import { listenToTouch } from './input/touch.js';
import { Turner } from './input/turner.js';
import { KeyEditor } from './key_editor.js';
import { writeKeyHints } from './key_hints.js';
import { LatencyButton } from './latency_button.js';
import { LateLook } from './late_look.js';
import { LineHint } from './line_hint.js';
import { Notice } from './notice.js';
import { Overlay } from './overlay.js';
import { Codec, LimitedBy, kSubProtocols } from './protocol.js';
import { Refining } from './refining.js';
import { ReloadOnce } from './reload_once.js';
import { Screen } from './screen.js';
import { Screenshot, saveFile, takePicture } from './screenshot.js';
import { Settings, streamPreferences } from './settings.js';
import { SettingsPanel } from './settings_panel.js';
import { Stream } from './stream.js';
import { Telemetry } from './telemetry.js';
import { Toast } from './toast.js';
import { Viewport } from './viewport.js';
import { WorldStatistics } from './world_statistics.js';

const kFailed = 'it failed in this browser';
const kLimitNames = Object.fromEntries(Object.entries(LimitedBy).map(([name, number]) => [number, name]));
const element = (id) => document.getElementById(id);
const root = document.documentElement;
const canvas = element('world');
const query = new URLSearchParams(window.location.search);
const clock = {
  now: () => performance.now(),
  setTimeout: (callback, delay) => window.setTimeout(callback, delay),
  clearTimeout: (timer) => window.clearTimeout(timer),
};

const settings = new Settings(() => window.localStorage);
const telemetry = new Telemetry();
const controls = new Controls();
const viewport = new Viewport(window, (size) => connection.sendResize(size));
const reloadOnce = new ReloadOnce(window);
const refining = new Refining(element('refining'));
const hint = new Hint(element('hint'), controls);
const notice = new Notice(element('notice'), () => {
  if (connection.state === 'outdated') window.location.reload();
  else connection.retry();
});

const nameInAddress = query.get('name');

const connection = new Connection({
  openSocket: () => new WebSocket(window.location.origin.replace(/^http/, 'ws') + '/', kSubProtocols),
  offer: () => stream.offer,
  hello: () => ({ name: nameInAddress || settings.values.name, ...viewport.size }),
  on: {
    state: enter,
    welcome,
    waiting: (message) => notice.wait(message),
    picture: receive,
    status: hear,
    refining: (message) => refining.show(message),
  },
  backoff: new Backoff(),
  mayRetry: () => !document.hidden,
  clock,
});

const sender = new InputSender({
  controls,
  clock,
  send: (input, now) => {
    connection.sendInput(input);
    telemetry.inputSent(input.number, now);
  },
});

const lateLook = new LateLook(document.createElement('canvas'), () => stream.tellLimits());
const screen = new Screen({ canvas, lateLook, look: () => (stream.turns ? controls : null) });
const display = new Display({ screen, schedule: paintScheduler(document), onPresented: presented });
const codecs = new Codecs(window);
const stream = new Stream({
  connection,
  codecs,
  makeDecoding: (on) => new Decoding({ make: decoders(window, clock), clock, on }),
  display,
  lateLook,
  onCodecFailed: (words) => {
    console.warn(words);
    panel.disable('codec', kFailed, 'h264');
  },
});
const lineHint = new LineHint(element('line'), clock);
const latency = new LatencyButton(element('latency'), {
  clock,
  sendInput: () => sender.repeat(),
  save: (file) => saveFile(window, file),
});
controls.onChange(() => display.turn());

function enter(state, reason) {
  const was = root.dataset.connection;
  root.dataset.connection = state;
  if (state === 'silent') {
    notice.show(state, reason);
  } else if (state === 'open' && was === 'silent') {
    notice.hide();
  } else if (state === 'open') {
    sender.start();
    connection.sendResize(viewport.size);
    reloadOnce.settled();
  } else {
    sender.stop();
    lineHint.reset();
    notice.show(state, reason);
    if (state !== 'lost' && document.pointerLockElement) document.exitPointerLock();
    if (state === 'outdated') reloadOnce.attempt();
  }
}

function welcome({ red, green, blue, yaw, pitch, world }) {
  stream.begin();
  display.reset();
  telemetry.reset();
  refining.hide();
  controls.face(yaw, pitch);
  root.style.setProperty('--lantern', `rgb(${red} ${green} ${blue})`);
  element('title').textContent = world || 'Grove';
  document.title = world && world !== 'Grove' ? `${world} \u00b7 Grove` : 'Grove';
}

function receive(picture) {
  telemetry.frameReceived(picture, clock.now());
  stream.receive(picture);
}

function hear(status) {
  telemetry.statusReceived(status);
  lineHint.update(status, telemetry.read(clock.now()).height ?? status.height);
  root.dataset.limitedBy = kLimitNames[status.limitedBy];
  root.dataset.visitors = status.visitors;
}

function presented(picture) {
  connection.acknowledge(picture);
  const now = clock.now();
  latency.presented(telemetry.framePresented(picture, now), picture, now);
  if (connection.state === 'open') notice.hide();
  if (root.dataset.picture === 'none') {
    root.dataset.picture = 'shown';
    hint.show();
    if (query.has('latency')) latency.start(Number(query.get('latency')) || undefined);
  }
  publish(telemetry.read(now));
}

/** What the page is doing, for whoever looks at it from outside. */
function publish({ frames, latencyMs, width, height, visitors, codec }) {
  root.dataset.frames = frames;
  root.dataset.streamSize = `${width}x${height}`;
  root.dataset.lines = height;
  root.dataset.codec = codec;
  root.dataset.visitors = visitors;
  root.dataset.yaw = controls.yaw.toFixed(4);
  root.dataset.pitch = controls.pitch.toFixed(4);
  if (latencyMs !== null) root.dataset.latencyMs = latencyMs.toFixed(1);
}

function pointer(state) {
  const was = root.dataset.pointer;
  root.dataset.pointer = state;
  if (state !== 'locked' && was !== state) hint.show();
}

const statistics = new WorldStatistics(() => fetch('/sharing.json').then((answer) => answer.json()), clock);
const overlay = new Overlay(
  element('overlay'),
  element('figures'),
  () => ({
    ...telemetry.read(clock.now()),
    ...statistics.read(),
    latencyPercentiles: telemetry.latencyPercentiles(clock.now()),
    lateLook: stream.lateLookWord,
  }),
  (shown) => statistics.watch(shown),
);
const fullscreen = new Fullscreen(document, element('fullscreen'));
new Turner(controls, (callback) => window.requestAnimationFrame(callback));
const toast = new Toast(element('toast'), clock);
const screenshot = new Screenshot({
  take: () => takePicture(canvas),
  save: (file) => saveFile(window, file),
  say: (text) => toast.say(text),
});
element('screenshot').addEventListener('click', () => screenshot.shoot());

const panel = new SettingsPanel({
  dialog: element('settings'),
  button: element('settings-button'),
  settings,
  read: () => telemetry.read(clock.now()),
  narrow: window.matchMedia('(max-width: 48rem), (max-height: 28rem)'),
});
const labels = new KeyLabels();
const keyEditor = new KeyEditor(document.querySelector('#settings tbody'), settings, labels, (text) => panel.say(text));
listenToKeyboard(window, controls, () => settings.values.keys, {
  figures: () => overlay.toggle(),
  fullscreen: () => fullscreen.toggle(),
  screenshot: () => screenshot.shoot(),
  settings: () => panel.toggle(),
  latency: () => latency.start(),
});

function apply(values) {
  controls.setSteering(values);
  stream.setPreferences(streamPreferences(values));
  writeKeyHints(document, values.keys, labels);
}

function relabel() {
  keyEditor.write();
  writeKeyHints(document, settings.values.keys, labels);
}

settings.onChange(apply);
apply(settings.values);
labels.ask(window.navigator).then(relabel);
window.addEventListener('keydown', (event) => {
  if (labels.learn(event)) relabel();
});
window.addEventListener('storage', () => settings.reload());
if (nameInAddress) panel.disable('name', `The page's address names you ${nameInAddress}.`);
if (!lateLook.isReady) panel.disable('lateLook', 'Needs WebGL, which this browser does not give to the page.');
listenToMouse(canvas, controls, pointer);
listenToTouch(canvas, controls, element('stick'));
listenToBlowButton(element('blow'), controls);
listenToGamepads(window, controls);

for (const [target, event] of [
  [window, 'online'],
  [window, 'pageshow'],
  [document, 'resume'],
  [document, 'visibilitychange'],
]) {
  target.addEventListener(event, () => {
    stream.setHidden(document.hidden);
    if (document.hidden) return;
    connection.listen();
    if (['lost', 'full', 'away'].includes(connection.state)) connection.retry();
  });
}
stream.setHidden(document.hidden);
// Before the wait: it tells that the page has started.
root.dataset.connection = connection.state;
await codecs.ask();
connection.start();
if (!codecs.offer('h264').includes(Codec.h264)) {
  panel.disable('codec', (await h264Hindrance(window)) || kFailed, 'h264');
}
