/**
 * All texts of the visitor's and the operator's page, to read and change them in one place. Only texts for browsers
 * before the modules run are elsewhere: in the heads of the pages, `start_check.js` and `not_found.html`.
 */

/** Texts of index.html by `data-words`: a text, or text, label and tip (see words.js). */
export const kPage = Object.freeze({
  world: { label: 'The world from where you stand' },
  hintStart: 'Click to look around.',
  hintMouse: '{walking} to walk, {run} to run, hold the mouse button to blow, Esc to free the mouse.',
  hintDrag: 'Drag to look around. {walking} to walk, {run} to run, hold {blow} to blow.',
  hintMore: '{settings}: settings, {people}: visitors, {figures}: statistics, {screenshot}: screenshot, {fullscreen}: full screen.',
  hintTouch: 'Left thumb walks, right thumb looks around. Hold it still to blow.',
  hintSpoken:
    '{turnLeft} and {turnRight} turn, {lookUp} and {lookDown} look up and down, {blow} blows, {figures} shows ' +
    'statistics, {people} lists the visitors, {settings} opens the settings, where you can change all keys, {screenshot} saves the picture, ' +
    '{latency} measures the latency, {fullscreen} fills the screen.',
  blow: { label: 'Blow' },
  tools: { label: 'View' },
  figures: { label: 'Statistics' },
  peopleButton: { label: 'Visitors' },
  screenshot: { label: 'Screenshot' },
  settingsButton: { label: 'Settings' },
  fullscreen: { label: 'Full screen' },
  overlay: { label: 'Statistics' },
  allFigures: 'All statistics',
  people: { label: 'Visitors' },
  othersLost: 'Visitors on other servers are out of reach.',
  copyLink: 'Copy link to this world',
  saveTable: 'Save as CSV',
  preparation: { label: 'Preparation of the world' },
  settings: 'Settings',
  close: { label: 'Close settings', tip: 'Close settings (Escape)' },
  you: 'You',
  name: 'Name',
  aboutName: 'Other visitors see it above you the next time you enter. Reload the page to enter again.',
  looking: 'Looking around',
  sensitivity: 'Sensitivity',
  invert: 'Invert up and down',
  aboutLooking: 'Applies to mouse, touch and gamepad.',
  stream: 'Stream',
  now: 'Now:',
  codec: 'Codec',
  rate: 'Maximum data rate',
  lines: 'Maximum resolution',
  fps: 'Maximum frame rate',
  lateLook: 'Instant turning and walking',
  aboutLateLook: 'Turns and moves the picture as soon as you look around or walk, before the next one arrives from the server.',
  sound: 'Sound',
  hear: 'Wind and fire',
  aboutSound: 'Starts with your first click or key. The fire is louder when you are near it.',
  keys: 'Keys',
  aboutKeys: 'Choose a key, then press the new one.',
  reset: 'Reset to defaults',
});

/** Choices of settings, in order: value and text. */
export const kChoices = Object.freeze({
  codec: [['auto', 'Automatic'], ['h264', 'H.264'], ['jpeg', 'JPEG']],
  kilobitsPerSecond: [
    [0, 'No limit'], [16000, '16 Mbit/s'], [8000, '8 Mbit/s'], [4000, '4 Mbit/s'], [2000, '2 Mbit/s'], [1000, '1 Mbit/s'],
    [500, '0.5 Mbit/s'],
  ],
  lines: [[0, 'Window size'], [1080, '1080 lines'], [720, '720 lines'], [480, '480 lines'], [360, '360 lines']],
  framesPerSecond: [[0, 'No limit'], [60, '60 frames/s'], [30, '30 frames/s'], [20, '20 frames/s'], [15, '15 frames/s']],
});

/** Rows of the statistics by list, in order: name, and an explanation where the name needs one. */
export const kRows = Object.freeze({
  simple: {
    label: 'Stream in brief',
    rows: {
      fps: ['Frame rate'],
      latency: ['Latency', 'Time from your input until you see its effect'],
      quality: ['Picture quality', 'Compared with the best that this codec can do'],
      limit: ['Limited by', 'What limits frame rate and quality of the stream'],
    },
  },
  stream: {
    label: 'Stream',
    rows: {
      percentiles: ['p50 / 95 / 99', 'Median, 95th and 99th percentile of the latency in the last ten seconds'],
      rate: ['Data rate'],
      codec: ['Codec'],
      size: ['Picture size'],
      visitors: ['Visitors'],
      shared: ['Shared views', 'Views of trees and grass used by others than the first visitor'],
      server: ['Server time', 'Time from reading your input to sending the picture'],
      version: ['Grove version'],
    },
  },
  line: {
    label: 'How the stream adapts to your connection',
    rows: {
      goal: ['Target frame rate', 'What the server aims at now'],
      carries: ['Bandwidth', 'What your connection can carry, as the server estimates it'],
      roundTrip: ['Round trip', 'Time to the server and back while the connection is idle'],
      lateLook: ['Instant movement', 'The picture turns and moves as you look around and walk, before the next one arrives'],
    },
  },
  places: {
    label: "Where a picture's time goes",
    rows: {
      queued: ['Waiting', 'Until the server has a free worker for the picture'],
      drawn: ['Rendering', 'From reading the camera to the finished picture'],
      encoded: ['Encoding', 'Until the codec has compressed it'],
      socket: ['Sending', "Until the server's socket has accepted it"],
      line: ['Network', 'From the server to this page, including what waits on the way'],
      decoded: ['Decoding', 'From its arrival until this browser has decoded it'],
      painted: ['Displaying', 'Time this browser takes to draw it'],
    },
  },
  savings: {
    label: 'What sharing one world saves',
    rows: {
      alpha: ['Shared work \u03b1', 'Share of the computing behind a picture that is done once for all visitors'],
      beta: ['Shared memory \u03b2', 'Share of the memory behind a picture that is held once for all visitors'],
      everybody: ['For everybody', 'Computing time per frame that serves all visitors: fire, smoke, views of trees that several used'],
      visitor: ['For you', 'Computing time per frame that serves only you'],
      cost: ['One more visitor', "What one more visitor would take of the server's processor at the full frame rate"],
      fit: ['Room for', 'Number of visitors this machine can serve at the full frame rate'],
      private: ['Without sharing', 'Number of visitors it could serve if each had a separate world'],
    },
  },
});

export const kStatistics = Object.freeze({
  limits: { nothing: 'nothing', line: 'your connection', machine: 'busy server', browser: 'busy browser', visitor: 'your settings' },
  noVisitors: 'none',
  atMost: (count) => `at most ${count}`,
  cores: (count) => `${count} cores`,
  framesPerSecond: (count) => `${count} frames/s`,
  lateLookOn: 'on',
  lateLookTurns: 'turning only',
  lateLookOff: 'off',
  lateLookHindered: (hindrance) => `off: ${hindrance}`,
  visitors: (count, text) => `${text} ${count === 1 ? 'visitor' : 'visitors'}`,
});

export const kLatency = Object.freeze({
  measure: (seconds) => `Measure latency for ${seconds} s`,
  measuring: 'Measuring\u2026',
  result: (p50, p95, p99, inputs) => `p50 ${p50}, p95 ${p95}, p99 ${p99} ms of ${inputs} inputs`,
});

/** At the edge of the picture: the stream's bottleneck, and the improving detail of the world. */
export const kHints = Object.freeze({
  line: 'Slow connection',
  browser: 'Your browser is busy',
  machine: 'The server is busy',
  limited: (who, lines, framesPerSecond) => `${who}: ${lines} lines, ${framesPerSecond} frames/s`,
  refining: (percent) => `Improving the detail: ${percent}\u00a0%`,
  minutesLeft: (minutes) => `, about ${minutes}\u00a0${minutes === 1 ? 'minute' : 'minutes'} left`,
  secondsLeft: (seconds) => `, about ${seconds}\u00a0s left`,
});

/** For each state of the connection but `open`. Without a `text`, the notice shows the server's reason. */
export const kStates = Object.freeze({
  connecting: { title: 'Grove', text: 'Entering the grove\u2026' },
  silent: { title: 'The server is not responding\u2026', text: 'The picture may be out of date.' },
  lost: { title: 'Connection lost', text: 'Trying to reconnect\u2026' },
  full: { title: 'No room for you yet', next: 'Trying again every 15 seconds.', action: 'Try again now' },
  away: { title: 'Your place went to another visitor', next: 'Trying to enter again\u2026', action: 'Try again now' },
  outdated: { title: 'Grove has been updated', text: 'Please reload the page.', action: 'Reload' },
  refused: { title: 'The server closed the connection', action: 'Try again' },
});

export const kWaiting = Object.freeze({
  noReason: 'No reason was given.',
  title: 'The world is being prepared',
  moment: 'One moment\u2026',
});

export const kPictures = Object.freeze({
  saved: (name) => `Picture saved: ${name}`,
  shared: 'Picture shared',
  opened: 'Picture opened',
  failed: 'The picture could not be saved.',
});

/** States of a link to a node. */
export const kLinkStates = Object.freeze({
  here: 'in this process',
  connecting: 'connecting',
  welcomed: 'connected',
  joined: 'connected',
  refused: 'refused',
  untrusted: 'not trusted',
  silent: 'silent, reconnecting',
  lost: 'lost, reconnecting',
});

/** The list of visitors. */
export const kPeople = Object.freeze({
  here: (count) => (count === 1 ? 'You are alone here' : `${count} visitors`),
  self: ' (you)',
  lost: 'Visitors on other servers are out of reach',
  found: 'Visitors on other servers are back',
  copied: 'Link copied',
  notCopied: (link) => `This browser refuses to copy. The link is ${link}`,
});

/** Messages of the settings: changes, and unavailable choices. */
export const kSettings = Object.freeze({
  notKept: 'This browser does not store settings for this page: they last until you leave it.',
  reset: 'All settings are back to their defaults.',
  times: (factor) => `${factor} times`,
  nameInAddress: (name) => `The address of this page sets your name: ${name}.`,
  unavailable: (choice, reason) => `${choice} \u2013 ${reason}`,
  codecFailed: 'it failed in this browser',
  insecure: 'needs https or localhost',
  noWebCodecs: 'this browser has no WebCodecs',
  notDecoded: 'this browser does not decode it',
  hindrances: {
    'no fast WebGL': 'Needs WebGL on a graphics card, which this browser does not give to the page.',
    'too slow': 'Off until you reload the page: this browser turns pictures too slowly.',
  },
});

/** The actions in the order of the settings. */
export const kActions = Object.freeze({
  forward: 'Walk forward',
  back: 'Walk back',
  left: 'Walk left',
  right: 'Walk right',
  run: 'Run',
  blow: 'Blow',
  turnLeft: 'Turn left',
  turnRight: 'Turn right',
  lookUp: 'Look up',
  lookDown: 'Look down',
  figures: 'Statistics',
  settings: 'Settings',
  people: 'Visitors',
  screenshot: 'Screenshot',
  latency: 'Measure latency',
  fullscreen: 'Full screen',
});

export const kKeys = Object.freeze({
  /** Keys with the same name on every layout. */
  names: {
    ArrowUp: 'up arrow',
    ArrowLeft: 'left arrow',
    ArrowDown: 'down arrow',
    ArrowRight: 'right arrow',
    ShiftLeft: 'left shift',
    ShiftRight: 'right shift',
    Space: 'space',
    PageUp: 'page up',
    PageDown: 'page down',
  },
  arrows: 'arrows',
  shift: 'shift',
  or: ' or ',
  none: 'no key',
  slots: ['key', 'second key'],
  ofSlot: (action, slot, key) => `${action}, ${slot}: ${key}`,
  emptySlot: 'none',
  wait: 'press a key',
  press: (action) => `Press a key for ${action}. Press Escape to keep the present one.`,
  kept: (action) => `${action} keeps its key.`,
  reserved: 'The browser needs this key. Press another one.',
  bound: (action, key) => `${action}: ${key}.`,
  also: (action, keys) => ` ${action} now has ${keys}.`,
  tip: (label, keys) => `${label} (${keys})`,
});

/** Texts of operator.html by `data-words`, as in kPage. */
export const kOperatorPage = Object.freeze({
  purpose: 'What one shared world costs, and what sharing saves',
  elsewhere: { label: 'Elsewhere' },
  trace: { text: 'Download the last seconds as a trace for Perfetto', tip: 'A file for ui.perfetto.dev or chrome://tracing' },
  now: { label: 'Now' },
  visitors: 'Visitors',
  fps: 'Frames per second',
  alpha: 'Shared work \u03b1',
  beta: 'Shared memory \u03b2',
  cores: 'CPU cores in use',
  fit: 'Visitors that fit',
  frame: 'One frame of one visitor',
  types: 'Types of object',
  aboutTypes:
    'CPU time per frame: what is shared by all visitors, and what each visitor takes on backends and on the frontend. ' +
    '\u03b1 and \u03b2 are the shared parts of this work and of the memory. MB each: for every visitor.',
  type: 'type',
  sharedMs: 'ms shared',
  backendMs: 'ms backend',
  frontendMs: 'ms frontend',
  alphaColumn: '\u03b1',
  betaColumn: '\u03b2',
  sharedMb: 'MB shared',
  eachMb: 'MB each',
  nodes: 'Other processes',
  aboutNodes:
    'Nodes that serve objects of this world, and its owner. The figures of a visitor or a frame exclude their work and ' +
    'memory. Rates are for both directions; the round trip is the minimum of the last five seconds.',
  node: 'process',
  link: 'link',
  objects: 'objects',
  sentRate: 'kB/s to it',
  receivedRate: 'kB/s from it',
  roundTrip: 'ms round trip',
  usedMb: 'MB used',
  memory: 'Memory',
  holder: 'used by',
  for: 'for',
  mb: 'MB',
  ofProcess: 'of the process',
  charts: 'The last two minutes',
  stages: 'Stages',
  aboutStages:
    'What ran in the last five seconds, with its CPU time and its share of the CPU time of its process. Failures count ' +
    'since the start.',
  stage: 'stage',
  runs: 'runs/s',
  perRun: 'ms per run',
  cpu: 'CPU',
  failures: 'failures',
  more: 'Light fields and quality',
  hits: 'Uses of views of trees and grass by others than the first visitor',
  quality: 'Quality of shared work',
  chartBegin: '2 min ago',
  chartEnd: 'now',
});

/** Beside the operator's figures. */
export const kOperator = Object.freeze({
  states: { asking: 'connecting', live: 'live', paused: 'paused', lost: 'no connection' },
  visitorsNote: 'connected now',
  fpsNote: 'per visitor, on average',
  fpsBusy: (limits) => `per visitor; the machine is busy, so ${limits}`,
  fpsSmaller: (share) => `pictures have ${share} of the wanted width`,
  fpsFewer: (rate) => `late walk gets ${rate} pictures a second`,
  coresNote: (cores, more) => `of ${cores}; one more visitor takes ${more}`,
  coresUnknown: 'of this machine',
  work: 'work behind a frame',
  memory: 'memory for one visitor',
  isShared: (what) => `part of the ${what} that is shared`,
  sharedPart: (part, what) => `${part} of the ${what} is shared`,
  fit: 'at the full frame rate',
  fitNone: 'not even one gets the full frame rate',
  fitNoneAlone: 'in private mode, not even one',
  fitAlone: (count) => `in private mode, at most ${count}`,
  fitTimes: (times, count) => `${times} times as many as in private mode (at most ${count})`,
  quality: (step, steps, isAutomatic) =>
    `step ${step} of ${steps}, ${isAutomatic ? 'raised while visitors share the cost' : 'fixed'}`,
  memoryUnknown: 'This server does not report its memory.',
  memoryUse: (used) => `The process uses ${used}.`,
  memoryUseOf: (used, known) => `The process uses ${used}; ${known} of it are listed here.`,
  verdict: (cost, times) => `With a separate world, each visitor would cost at least ${cost} per frame: ${times}.`,
  timesAsMuch: (times) => `${times} times as much`,
  aboutAsMuch: 'about as much',
  parts: { shared: 'part of the shared work', backend: 'own work, backends', frontend: 'own work, frontend', other: 'everything else' },
  aboutFrame: 'CPU time behind each picture. Work for all visitors is done once and split among them.',
  barNow: 'now, shared',
  barAlone: 'in private mode, at least',
  barUnknown: 'not known',
  charts: { visitors: 'Visitors', cores: 'CPU cores in use', alpha: 'Shared work \u03b1', fps: 'Frames per second' },
  chartEmpty: 'The last two minutes: nothing measured yet',
  chartRange: (least, most) => `The last two minutes: between ${least} and ${most}`,
  owner: 'the owner of this world',
  here: 'this server',
  typesSum: 'all together',
  noType: 'no single type',
  aboutNoType: 'Camera, encoder and transport, which serve no single type',
  rest: 'everything else',
  unlisted: 'not listed',
});

/** Beneficiaries of work or memory. */
export const kBeneficiaries = Object.freeze({
  'across-user': 'everybody',
  'on-demand': 'visitors who look',
  'per-user-backend': 'visitor, backend',
  'per-user-frontend': 'visitor, frontend',
});

/** Notices above the operator's figures. */
export const kSituations = Object.freeze({
  asking: { title: 'Connecting to the server\u2026', text: '' },
  lost: { title: 'The server cannot be reached', text: 'Trying again\u2026' },
  lastHeard: (time) => `These figures are from ${time}. `,
  paused: { title: 'Paused', text: 'This page requests nothing while it is hidden.' },
  older: {
    title: 'This server does not report what sharing saves',
    text: 'Page and server have different versions. Reload the page.',
  },
  first: { title: 'A visitor has arrived', text: 'The first figures follow in a few seconds.' },
  empty: { title: 'No visitors', text: 'What sharing saves is measured while visitors are connected.' },
  connecting: {
    title: 'The owner of this world does not answer',
    text: 'This server shows the world with its own visitors only, and joins as soon as the owner answers.',
  },
  ownerLost: {
    title: 'The owner of this world is lost',
    text: 'Visitors on other servers are out of reach. This server joins again as soon as the owner is back.',
  },
  refused: (reason) => ({
    title: 'The owner of this world refuses this server',
    text: `${reason}. This server shows the world with its own visitors only.`,
  }),
});
