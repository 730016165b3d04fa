// Encoders that Grove does not use: a name, the file's ending, the quantisers to try, from fine to coarse, and FFmpeg's
// options for one of them.

const kScaleOfH264 = [16, 19, 22, 25, 28, 31, 34, 37, 40];

const x264Options = (preset, tune, quantiser) => [
  ...['-c:v', 'libx264', '-preset', preset, '-tune', tune, '-bf', '0'],
  ...['-x264-params', 'keyint=infinite', '-qp', quantiser],
];

/** The rate is one that no walk reaches, so that the bounds alone set the quantiser. */
const vpxOptions = (library, speed, quantiser) => [
  ...['-c:v', library, '-deadline', 'realtime', '-cpu-used', speed, '-lag-in-frames', '0', '-g', '99999'],
  ...['-qmin', quantiser, '-qmax', quantiser, '-b:v', '50M'],
];

export const kOthers = [
  {
    name: 'x264 superfast',
    ending: 'h264',
    quantisers: kScaleOfH264,
    options: (quantiser) => x264Options('superfast', 'zerolatency', quantiser),
  },
  {
    name: 'x264 veryslow',
    ending: 'h264',
    quantisers: kScaleOfH264,
    options: (quantiser) => x264Options('veryslow', 'psnr', quantiser),
  },
  {
    name: 'VP8',
    ending: 'ivf',
    quantisers: [8, 16, 24, 32, 40, 48, 56],
    // Negative: with 8, libvpx chooses the speed itself, from the time that it takes.
    options: (quantiser) => vpxOptions('libvpx', '-8', quantiser),
  },
  {
    name: 'VP9',
    ending: 'ivf',
    quantisers: [12, 20, 28, 36, 44, 52],
    options: (quantiser) => vpxOptions('libvpx-vp9', '8', quantiser),
  },
];
