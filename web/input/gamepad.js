import { Key } from '../stream/protocol.js';
import { stickAxis, stickKeys } from './stick.js';

/** Radians a second at the right stick's full deflection. */
const kTurnRate = 2.4;
/** Of the standard layout: the lower face button and the right trigger. */
const kBlowButtons = [0, 7];
const kHolder = 'gamepad';

/**
 * Left stick walks, right stick looks, A or the right trigger blows. Polled once a frame while a gamepad is connected.
 */
export function listenToGamepads(window, controls) {
  let polling = false;
  const poll = () => {
    const pad = window.navigator.getGamepads().find((candidate) => candidate?.mapping === 'standard');
    if (!pad) {
      polling = false;
      controls.release(kHolder);
      controls.turn(kHolder, 0, 0);
      return;
    }
    const blows = kBlowButtons.some((button) => pad.buttons[button]?.pressed);
    const [walkX, walkY, lookX, lookY] = pad.axes;
    controls.hold(kHolder, stickKeys(walkX, walkY) | (blows ? Key.blow : 0));
    controls.steerAt(kHolder, -kTurnRate * stickAxis(lookX), -kTurnRate * stickAxis(lookY));
    window.requestAnimationFrame(poll);
  };
  window.addEventListener('gamepadconnected', () => {
    if (polling) return;
    polling = true;
    poll();
  });
}
