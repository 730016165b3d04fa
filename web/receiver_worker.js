// The receiver's worker: reports whether it can paint, and takes the canvas if the page accepts.
import { decodeNearness } from './picture/nearness_grid.js';
import { Receiver } from './stream/receiver.js';

function canPaint() {
  try {
    return typeof requestAnimationFrame === 'function' && new OffscreenCanvas(1, 1).getContext('2d') !== null;
  } catch {
    return false;
  }
}

let receiver = null;

function begin({ canvas, start }) {
  // All times use the page's clock.
  const ahead = performance.timeOrigin - start.timeOrigin;
  receiver = new Receiver({
    scope: self,
    clock: {
      now: () => performance.now() + ahead,
      setTimeout: (callback, delay) => setTimeout(callback, delay),
      clearTimeout: (timer) => clearTimeout(timer),
    },
    canvas,
    makeCanvas: () => new OffscreenCanvas(16, 9),
    emit: (event, transfer = []) => postMessage(event, transfer),
    decodeNearness,
    start,
  });
  receiver.start();
}

onmessage = ({ data }) => {
  if (data.kind === 'start') begin(data);
  else receiver.do(data);
};
postMessage({ kind: 'able', able: canPaint() });
