import { Key } from '../stream/protocol.js';

const kHolder = 'button';
const kPressKeys = [' ', 'Enter'];

/** Blows while the button is held, by finger, mouse or key. */
export function listenToBlowButton(button, controls) {
  const press = () => controls.hold(kHolder, Key.blow);
  const release = () => controls.release(kHolder);
  button.addEventListener('pointerdown', (event) => {
    button.setPointerCapture(event.pointerId);
    press();
  });
  button.addEventListener('lostpointercapture', release);
  button.addEventListener('keydown', (event) => {
    if (kPressKeys.includes(event.key)) press();
  });
  button.addEventListener('keyup', (event) => {
    if (kPressKeys.includes(event.key)) release();
  });
  button.addEventListener('blur', release);
  button.addEventListener('contextmenu', (event) => event.preventDefault());
}
