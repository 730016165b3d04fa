import { h264Hindrance } from './stream/browser_abilities.js';
import { Capture } from './picture/capture.js';
import { copyText } from './panels/copy_text.js';
import { Fullscreen } from './picture/fullscreen.js';
import { Hint } from './panels/hint.js';
import { listenToBlowButton } from './input/blow_button.js';
import { Controls } from './input/controls.js';
import { listenToGamepads } from './input/gamepad.js';
import { KeyLabels } from './input/key_labels.js';
import { listenToKeyboard } from './input/keyboard.js';
import { listenToMouse } from './input/mouse.js';
import { InputSender } from './input/sender.js';
import { listenToTouch } from './input/touch.js';
import { Turner } from './input/turner.js';
import { KeyEditor } from './panels/key_editor.js';
import { writeKeyHints } from './panels/key_hints.js';
import { LatencyButton } from './panels/latency_button.js';
import { LimitHint } from './panels/limit_hint.js';
import { NameTags } from './panels/name_tags.js';
import { Notice } from './panels/notice.js';
import { Overlay } from './panels/overlay.js';
import { People } from './panels/people.js';
import { Key } from './stream/protocol.js';
import { ReceiverHome } from './stream/receiver_home.js';
import { Refining } from './panels/refining.js';
import { ReloadOnce } from './stream/reload_once.js';
import { storedItems } from './stream/remote_storage.js';
import { Roster, sharedLink } from './panels/roster.js';
import { Screenshot, saveFile } from './picture/screenshot.js';
import { Settings, streamPreferences } from './panels/settings.js';
import { SettingsPanel } from './panels/settings_panel.js';
import { Sound } from './sound.js';
import { kNoReading } from './stream/telemetry.js';
import { kPage, kSettings } from './texts.js';
import { Toast } from './panels/toast.js';
import { Viewport } from './picture/viewport.js';
import { writeWords } from './words.js';
import { WorldStatistics } from './world_statistics.js';

const element = (id) => document.getElementById(id);
const root = document.documentElement;
const canvas = element('world');
const query = new URLSearchParams(window.location.search);
const clock = {
  now: () => performance.now(),
  setTimeout: (callback, delay) => window.setTimeout(callback, delay),
  clearTimeout: (timer) => window.clearTimeout(timer),
};

writeWords(document, kPage);
const settings = new Settings(() => window.localStorage);
const controls = new Controls();
const viewport = new Viewport(window, () => receiver.send({ kind: 'hello', hello: hello() }));
const reloadOnce = new ReloadOnce(window);
const refining = new Refining(element('refining'));
const hint = new Hint(element('hint'), controls);
const notice = new Notice(element('notice'), () => {
  if (root.dataset.connection === 'outdated') window.location.reload();
  else receiver.send({ kind: 'retry' });
});

const nameInAddress = query.get('name');

const stillness = window.matchMedia('(prefers-reduced-motion: reduce)');
const preferences = () => ({ ...streamPreferences(settings.values), reducedMotion: stillness.matches });
const hello = () => ({ name: nameInAddress || settings.values.name, ...viewport.size });

const receiver = new ReceiverHome({
  window,
  clock,
  canvas,
  start: {
    url: window.location.origin.replace(/^http/, 'ws') + '/',
    hello: hello(),
    hidden: document.hidden,
    preferences: preferences(),
    stored: storedItems(() => window.sessionStorage),
  },
  on: (event) => handlers[event.kind](event),
});
const people = new People();
const nameTags = new NameTags(element('names'), people, window);
const capture = new Capture({ send: (command) => receiver.send(command), clock });
const handlers = {
  state: enter,
  welcome,
  waiting: (message) => notice.wait(message),
  refining: (message) => refining.show(message),
  status: showStatus,
  presented,
  people: (message) => people.update(message),
  labels: (message) => nameTags.show(message),
  reading: (event) => (reading = event.reading),
  captured: (answer) => capture.answered(answer),
  picture: (answer) => capture.answered(answer),
  lateLook: ({ hindrance }) => panel.explain('lateLook', hindrance && kSettings.hindrances[hindrance]),
  codecs: ({ h264 }) => h264 || disableH264(),
  codecFailed: ({ words }) => {
    console.warn(words);
    panel.disable('codec', kSettings.codecFailed, 'h264');
  },
  store: ({ key, value }) => keep(key, value),
};

let visit = 0;
let reading = kNoReading;

const sender = new InputSender({
  controls,
  clock,
  send: (input, now) => receiver.send({ kind: 'input', visit, input, now }),
});

const limitHint = new LimitHint(element('line'), clock);
const latency = new LatencyButton(element('latency'), {
  clock,
  sendInput: () => sender.repeat(),
  save: (file) => saveFile(window, file),
});
const sound = new Sound(window);
controls.onChange(() => {
  receiver.send({ kind: 'look', yaw: controls.yaw, pitch: controls.pitch });
  sound.blow((controls.keys & Key.blow) !== 0);
});

function enter({ state, reason, visit: count }) {
  const was = root.dataset.connection;
  root.dataset.connection = state;
  if (state === 'silent') {
    notice.show(state, reason);
  } else if (state === 'open' && was === 'silent') {
    notice.hide();
  } else if (state === 'open') {
    visit = count;
    sender.start();
    reloadOnce.settled();
  } else {
    sender.stop();
    limitHint.reset();
    notice.show(state, reason);
    if (state !== 'lost' && document.pointerLockElement) document.exitPointerLock();
    if (state === 'outdated') reloadOnce.attempt();
  }
}

function welcome({ visitor, red, green, blue, yaw, pitch, world }) {
  refining.hide();
  people.self = visitor;
  controls.face(yaw, pitch);
  root.style.setProperty('--lantern', `rgb(${red} ${green} ${blue})`);
  element('title').textContent = world || 'Grove';
  document.title = world && world !== 'Grove' ? `${world} \u00b7 Grove` : 'Grove';
}

function showStatus({ status, lines, limitedBy }) {
  limitHint.update(status, lines);
  root.dataset.limitedBy = limitedBy;
  root.dataset.visitors = status.visitors;
}

function presented({ picture, inputs, now, reading: figures }) {
  latency.presented(inputs, picture, now);
  // Older servers do not send it.
  sound.approachFire(picture.fire ?? 0);
  if (root.dataset.connection === 'open') notice.hide();
  if (root.dataset.picture === 'none') {
    root.dataset.picture = 'shown';
    hint.show();
    if (query.has('latency')) latency.start(Number(query.get('latency')) || undefined);
  }
  publish(figures);
}

/** Without the browser's storage, the value is lost on a reload. */
function keep(key, value) {
  try {
    window.sessionStorage.setItem(key, value);
  } catch {
    // The browser or its user refuses storage.
  }
}

async function disableH264() {
  panel.disable('codec', (await h264Hindrance(window)) || kSettings.codecFailed, 'h264');
}

/** The page's state as attributes, for tests and measurements. */
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
  () => ({ ...reading, ...statistics.read() }),
  (shown) => statistics.watch(shown),
);
const fullscreen = new Fullscreen(document, element('fullscreen'));
new Turner(controls, (callback) => window.requestAnimationFrame(callback));
const toast = new Toast(element('toast'), clock);
const screenshot = new Screenshot({
  take: () => capture.take(),
  save: (file) => saveFile(window, file),
  say: (text) => toast.say(text),
});
const roster = new Roster({
  panel: element('people'),
  button: element('people-button'),
  people,
  copy: (text) => copyText(window, text),
  link: () => sharedLink(window.location),
  say: (text) => toast.say(text),
});
element('screenshot').addEventListener('click', () => screenshot.shoot());

const panel = new SettingsPanel({
  dialog: element('settings'),
  button: element('settings-button'),
  settings,
  read: () => reading,
  narrow: window.matchMedia('(max-width: 48rem), (max-height: 28rem)'),
});
const labels = new KeyLabels();
const keyEditor = new KeyEditor(document.querySelector('#settings tbody'), settings, labels, (text) => panel.say(text));
listenToKeyboard(window, controls, () => settings.values.keys, {
  figures: () => overlay.toggle(),
  fullscreen: () => fullscreen.toggle(),
  screenshot: () => screenshot.shoot(),
  settings: () => panel.toggle(),
  people: () => roster.toggle(),
  latency: () => latency.start(),
});

function apply(values) {
  controls.setSteering(values);
  sound.want(values.sound);
  receiver.send({ kind: 'preferences', preferences: preferences() });
  receiver.send({ kind: 'hello', hello: hello() });
  writeKeyHints(document, values.keys, labels);
}

function relabel() {
  keyEditor.write();
  writeKeyHints(document, settings.values.keys, labels);
}

settings.onChange(apply);
stillness.addEventListener('change', () => receiver.send({ kind: 'preferences', preferences: preferences() }));
apply(settings.values);
labels.ask(window.navigator).then(relabel);
window.addEventListener('keydown', (event) => {
  if (labels.learn(event)) relabel();
});
window.addEventListener('storage', () => settings.reload());
if (nameInAddress) panel.disable('name', kSettings.nameInAddress(nameInAddress));
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
  target.addEventListener(event, () => receiver.send({ kind: 'visibility', hidden: document.hidden }));
}
// Before the await: start_check.js takes `starting` for a failure.
root.dataset.connection = 'connecting';
root.dataset.receiver = await receiver.open();
