/** Seconds of noise that repeat; long enough not to be heard as a rhythm. */
const kLoopSeconds = 7;
/** Seconds in which a loudness becomes another. */
const kEase = 0.4;
const kWindLoudness = 0.05;
const kGustLoudness = 0.3;
const kFireLoudness = 0.5;

/** Noise whose neighbours are alike, as that of wind: white noise, summed up with a leak. */
function wind(samples) {
  let value = 0;
  for (let i = 0; i < samples.length; i += 1) {
    value = 0.985 * value + 0.1 * (2 * Math.random() - 1);
    samples[i] = value;
  }
}

/** A murmur with crackles at random: each a burst of noise that dies away within milliseconds. */
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

/** Plays the noise for ever, filtered, and gives the gain that makes it loud. */
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
 * What the world sounds like: wind, the gust that one blows, and the fire, the louder the nearer. Made of noise, so that
 * no sound has to be loaded. Silent until the visitor's first click or key, as browsers ask for, and while nobody looks.
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

  /** `window` gives AudioContext; without it all is silent. */
  constructor(window) {
    this.#document = window.document;
    const begin = () => {
      // Escape, for one, is no leave to make a sound.
      this.#isBegun ||= 'AudioContext' in window && (window.navigator.userActivation?.hasBeenActive ?? true);
      this.#apply();
    };
    for (const gesture of ['click', 'keydown']) window.addEventListener(gesture, begin);
    this.#document.addEventListener('visibilitychange', () => this.#apply());
  }

  /** Whether the visitor wants to hear anything. */
  want(isWanted) {
    this.#isWanted = isWanted;
    this.#apply();
  }

  /** Whether he blows. */
  blow(gust) {
    if (gust === this.#gust) return;
    this.#gust = gust;
    this.#mix();
  }

  /** How near the fire is: 0 out of hearing, 1 beside it. */
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
