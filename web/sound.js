/** Seconds until the noise repeats: too long to notice a rhythm. */
const kLoopSeconds = 7;
/** Time constant (s) of a change of loudness. */
const kEase = 0.4;
const kWindLoudness = 0.05;
const kGustLoudness = 0.3;
const kFireLoudness = 0.5;

/** Low noise, like wind: white noise through a leaky integrator. */
function wind(samples) {
  let value = 0;
  for (let i = 0; i < samples.length; i += 1) {
    value = 0.985 * value + 0.1 * (2 * Math.random() - 1);
    samples[i] = value;
  }
}

/** A murmur with random crackles: bursts of noise that decay within milliseconds. */
function fire(samples, rate) {
  let murmur = 0;
  let crackle = 0;
  for (let i = 0; i < samples.length; i += 1) {
    murmur = 0.99 * murmur + 0.02 * (2 * Math.random() - 1);
    if (Math.random() < 9 / rate) crackle = Math.random() ** 2;
    crackle *= 1 - 260 / rate;
    samples[i] = murmur + crackle * (2 * Math.random() - 1);
  }
}

/** Plays the filtered noise in a loop. Returns its gain, which is 0 at first. */
function play(context, output, fill, type, frequency) {
  const buffer = context.createBuffer(1, kLoopSeconds * context.sampleRate, context.sampleRate);
  fill(buffer.getChannelData(0), context.sampleRate);
  const source = new AudioBufferSourceNode(context, { buffer, loop: true });
  const gain = new GainNode(context, { gain: 0 });
  source.connect(new BiquadFilterNode(context, { type, frequency })).connect(gain).connect(output);
  source.start();
  return gain;
}

/**
 * The world's sounds: wind, the visitor's gust, and the fire, louder when nearer. Synthesised from noise, so the page
 * loads no sound. Silent until the visitor's first click or key press, as browsers require, and while the page is
 * hidden.
 */
export class Sound {
  #document;
  #context = null;
  #wind;
  #fire;
  #isWanted = false;
  #isBegun = false;
  #gust = false;
  #nearness = 0;

  /** Without AudioContext in `window`, there is no sound. */
  constructor(window) {
    this.#document = window.document;
    const begin = () => {
      // Some keys, such as Escape, do not permit sound.
      this.#isBegun ||= 'AudioContext' in window && (window.navigator.userActivation?.hasBeenActive ?? true);
      this.#apply();
    };
    for (const gesture of ['click', 'keydown']) window.addEventListener(gesture, begin);
    this.#document.addEventListener('visibilitychange', () => this.#apply());
  }

  /** Whether the visitor wants sound. */
  want(isWanted) {
    this.#isWanted = isWanted;
    this.#apply();
  }

  /** Whether the visitor blows. */
  blow(gust) {
    if (gust === this.#gust) return;
    this.#gust = gust;
    this.#mix();
  }

  /** `nearness` of the fire: 0 inaudible, 1 beside it. */
  approachFire(nearness) {
    if (nearness === this.#nearness) return;
    this.#nearness = nearness;
    this.#mix();
  }

  #apply() {
    const plays = this.#isBegun && this.#isWanted && !this.#document.hidden;
    if (plays && !this.#context) this.#make();
    if (plays) this.#context.resume();
    else this.#context?.suspend();
  }

  #make() {
    this.#context = new AudioContext({ latencyHint: 'playback' });
    this.#wind = play(this.#context, this.#context.destination, wind, 'lowpass', 500);
    this.#fire = play(this.#context, this.#context.destination, fire, 'highpass', 120);
    this.#mix();
  }

  #mix() {
    if (!this.#context) return;
    const { currentTime } = this.#context;
    this.#wind.gain.setTargetAtTime(this.#gust ? kGustLoudness : kWindLoudness, currentTime, kEase);
    this.#fire.gain.setTargetAtTime(kFireLoudness * this.#nearness, currentTime, kEase);
  }
}
