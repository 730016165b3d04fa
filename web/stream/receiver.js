import { Backoff } from './backoff.js';
import { Codecs } from './codecs.js';
import { Connection } from './connection.js';
import { decoders } from '../picture/decoders.js';
import { Decoding } from '../picture/decoding.js';
import { Display, paintScheduler } from '../picture/display.js';
import { LateLook } from '../picture/late_look.js';
import { isMoved, isTurned, windowOf } from '../picture/look_geometry.js';
import { MemoryImages } from '../picture/memory_images.js';
import { namePlace } from '../picture/name_place.js';
import { PaintBudget } from '../picture/paint_budget.js';
import { Codec, LimitedBy, kSubProtocols } from './protocol.js';
import { RemoteStorage } from './remote_storage.js';
import { Screen } from '../picture/screen.js';
import { takePicture } from '../picture/screenshot.js';
import { Stream } from './stream.js';
import { Telemetry } from './telemetry.js';
import { Visibility } from './visibility.js';
import { kNoMovement, Prediction } from '../walk/prediction.js';
import { withDepths } from '../walk/space.js';

/** Some figures change even without new pictures. Milliseconds. */
const kReadingInterval = 250;
const kLimitNames = Object.fromEntries(Object.entries(LimitedBy).map(([name, number]) => [number, name]));

/**
 * Owns socket and canvas: receives, decodes and paints the stream, in a worker or on the main thread. The page sends
 * commands (`do()`), the receiver emits events; both are plain objects with a `kind`, so that they can be posted. All
 * times are milliseconds by the page's clock.
 */
export class Receiver {
  #emit;
  #clock;
  #canvas;
  #visibility;
  #codecs;
  #connection;
  #telemetry = new Telemetry();
  #lateLook;
  #screen;
  #display;
  #stream;
  #look = { yaw: 0, pitch: 0 };
  #prediction = new Prediction();
  #decodeNearness;
  #hello;
  #visit = 0;
  #labelled = 0;
  #commands;

  /**
   * @param {object} parts
   * @param {object} parts.scope the globals of worker or page: WebSocket, timers, VideoDecoder, EncodedVideoChunk
   * @param {object} parts.clock as in connection.js
   * @param {HTMLCanvasElement | OffscreenCanvas} parts.canvas
   * @param {() => HTMLCanvasElement | OffscreenCanvas} parts.makeCanvas makes a hidden one
   * @param {(event: object, transfer?: object[]) => void} parts.emit
   * @param {Function} parts.decodeNearness as withDepths() takes it
   * @param {object} parts.start
   * @param {string} parts.start.url of the server's socket
   * @param {{name: string, width: number, height: number}} parts.start.hello
   * @param {boolean} parts.start.hidden
   * @param {object} parts.start.preferences as Stream takes them
   * @param {object} parts.start.stored the entries of the page's sessionStorage
   */
  constructor({ scope, clock, canvas, makeCanvas, emit, decodeNearness, start }) {
    this.#emit = emit;
    this.#clock = clock;
    this.#canvas = canvas;
    this.#decodeNearness = decodeNearness;
    this.#hello = start.hello;
    this.#visibility = new Visibility(start.hidden);
    this.#codecs = new Codecs({
      VideoDecoder: scope.VideoDecoder,
      setTimeout: clock.setTimeout,
      sessionStorage: new RemoteStorage(start.stored, (key, value) => emit({ kind: 'store', key, value })),
    });
    this.#connection = this.#makeConnection(() => new scope.WebSocket(start.url, kSubProtocols));
    const budget = new PaintBudget();
    this.#lateLook = new LateLook(makeCanvas(), () => this.#lateLookChanged());
    this.#screen = new Screen({
      canvas,
      lateLook: this.#lateLook,
      look: () => (this.#stream.turns ? this.#look : null),
      move: (picture) => this.#movement(picture),
      onPaint: (picture, view) => this.#painted(picture, view),
    });
    this.#display = new Display({
      screen: this.#screen,
      schedule: paintScheduler(this.#visibility),
      clock,
      onTurned: (paint) => {
        if (budget.isExceededBy(paint)) this.#lateLook.giveUp();
      },
      onPresented: (picture, paint) => this.#presented(picture, paint),
    });
    this.#stream = new Stream({
      connection: this.#connection,
      codecs: this.#codecs,
      clock,
      makeDecoding: (on) => this.#makeDecoding({ window: scope, clock, makeCanvas }, on),
      display: this.#display,
      lateLook: this.#lateLook,
      onCodecFailed: (words) => emit({ kind: 'codecFailed', words }),
    });
    this.#stream.setPreferences(start.preferences);
    this.#stream.setHidden(start.hidden);
    this.#commands = this.#makeCommands();
  }

  #makeConnection(openSocket) {
    const emit = this.#emit;
    return new Connection({
      openSocket,
      offer: () => this.#stream.offer,
      hello: () => this.#hello,
      on: {
        state: (state, reason) => emit({ kind: 'state', state, reason, visit: this.#visit }),
        welcome: (message) => this.#welcome(message),
        waiting: ({ percent, step }) => emit({ kind: 'waiting', percent, step }),
        picture: (picture) => this.#receive(picture),
        status: (status) => this.#statusReceived(status),
        refining: ({ percent, secondsLeft }) => emit({ kind: 'refining', percent, secondsLeft }),
        captured: ({ number, picture }) => emit({ kind: 'captured', number, picture }, [picture.buffer]),
        times: (times) => this.#telemetry.timesReceived(times),
        ground: (ground) => this.#prediction.setGround(ground),
        people: ({ othersAreLost, people }) => emit({ kind: 'people', othersAreLost, people }),
      },
      backoff: new Backoff(),
      mayRetry: () => !this.#visibility.hidden,
      clock: this.#clock,
    });
  }

  #makeCommands() {
    return {
      input: (command) => this.#input(command),
      look: ({ yaw, pitch }) => this.#turn(yaw, pitch),
      hello: ({ hello }) => this.#setHello(hello),
      preferences: ({ preferences }) => this.#stream.setPreferences(preferences),
      visibility: ({ hidden }) => this.#setHidden(hidden),
      retry: () => this.#connection.retry(),
      capture: ({ number }) => this.#capture(number),
      picture: ({ number }) => this.#takePicture(number),
    };
  }

  #makeDecoding(parts, on) {
    const paintsInSoftware = !this.#lateLook.isReady;
    const make = decoders({ ...parts, paintsInSoftware });
    if (!paintsInSoftware) return new Decoding({ make, clock: this.#clock, on });
    const copies = new MemoryImages();
    const image = (decoded, picture) => copies.pass(decoded, (copied) => on.image(copied, picture));
    return new Decoding({ make, clock: this.#clock, on: { ...on, image } });
  }

  /** Queries the browser's codecs, then connects. */
  async start() {
    this.#lateLookChanged();
    await this.#codecs.ask();
    this.#emit({ kind: 'codecs', h264: this.#codecs.offer('h264').includes(Codec.h264) });
    this.#connection.start();
    this.#tellReading();
  }

  do(command) {
    this.#commands[command.kind](command);
  }

  #movement(picture) {
    return this.#stream.walks ? this.#prediction.moved(picture, this.#clock.now()) : kNoMovement;
  }

  #painted(picture, view) {
    this.#label(picture, view);
    if (isTurned(view.turn) || isMoved(view.displacement)) this.#telemetry.frameMoved(view.until, this.#clock.now());
  }

  /** Emits the places of names in the window; for pictures without names, one empty list. */
  #label(picture, view) {
    const { labels = [] } = picture;
    if (labels.length === 0 && this.#labelled === 0) return;
    this.#labelled = labels.length;
    const placed = labels.map((label) => ({ ...label, place: namePlace(picture, view, label) }));
    this.#emit({ kind: 'labels', labels: placed.filter(({ place }) => place), ...windowOf(picture) });
  }

  #welcome({ visitor, red, green, blue, yaw, pitch, world }) {
    this.#visit += 1;
    this.#stream.begin();
    this.#display.reset();
    this.#telemetry.reset();
    this.#prediction.reset();
    this.#look = { yaw, pitch };
    this.#connection.sendResize(this.#hello);
    this.#emit({ kind: 'welcome', visitor, red, green, blue, yaw, pitch, world });
  }

  #receive(picture) {
    this.#telemetry.frameReceived(picture, this.#clock.now());
    this.#stream.receive(withDepths(picture, this.#decodeNearness));
  }

  #statusReceived(status) {
    this.#telemetry.statusReceived(status);
    const lines = this.#telemetry.read(this.#clock.now()).height ?? status.height;
    this.#emit({ kind: 'status', status, lines, limitedBy: kLimitNames[status.limitedBy] });
  }

  #presented(picture, paint) {
    const { frame, width, height, codec, fire, decode } = picture;
    this.#connection.acknowledge(picture, { decode, paint });
    const now = this.#clock.now();
    const inputs = this.#telemetry.framePresented(picture, now, paint);
    const reading = this.#telemetry.read(now);
    this.#emit({ kind: 'presented', picture: { frame, width, height, codec, fire }, inputs, now, reading });
  }

  #tellReading() {
    const now = this.#clock.now();
    const latencyPercentiles = this.#telemetry.latencyPercentiles(now);
    const { lateLookWord: lateLook } = this.#stream;
    this.#emit({ kind: 'reading', reading: { ...this.#telemetry.read(now), latencyPercentiles, lateLook } });
    this.#clock.setTimeout(() => this.#tellReading(), kReadingInterval);
  }

  #lateLookChanged() {
    this.#stream.tellLimits();
    this.#emit({ kind: 'lateLook', hindrance: this.#lateLook.hindrance });
  }

  /** Skips inputs of a former connection: their numbers mean nothing to this one. */
  #input({ visit, input, now }) {
    if (visit !== this.#visit) return;
    this.#connection.sendInput(input);
    this.#telemetry.inputSent(input.number, now);
    this.#prediction.inputSent(input, now);
    this.#display.turn();
  }

  #turn(yaw, pitch) {
    this.#look = { yaw, pitch };
    this.#display.turn();
  }

  #setHello(hello) {
    this.#hello = hello;
    this.#connection.sendResize(hello);
  }

  #setHidden(hidden) {
    this.#visibility.hidden = hidden;
    this.#stream.setHidden(hidden);
    if (hidden) return;
    this.#connection.listen();
    if (['lost', 'full', 'away'].includes(this.#connection.state)) this.#connection.retry();
  }

  #capture(number) {
    if (this.#connection.measures) this.#connection.sendCapture(number);
    else this.#emit({ kind: 'captured', number, picture: null });
  }

  async #takePicture(number) {
    const picture = await takePicture(this.#canvas).catch(() => null);
    this.#emit({ kind: 'picture', number, picture });
  }
}
