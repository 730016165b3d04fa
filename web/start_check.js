// Runs before the modules, in browsers of any age: explains why the page cannot start.
window.addEventListener('load', function () {
  var root = document.documentElement;
  var words;
  if (root.getAttribute('data-connection') === 'starting') {
    words = 'This browser is too old for this page, or a part of the page did not arrive. '
      + 'It needs Chrome or Edge 84, Firefox 90, Safari 14.1 or later.';
  } else if (!window.WebSocket) {
    words = 'This browser does not support WebSocket, which Grove needs to show its world.';
  }
  if (!words) return;
  document.querySelector('[data-notice=title]').textContent = 'Grove cannot start here';
  document.querySelector('[data-notice=text]').textContent = words;
});
