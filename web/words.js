/** A text whose `{action}` becomes an element that names the action's keys (key_hints.js). */
function parts(document, text) {
  return text.split(/\{(\w+)\}/).map((part, index) => {
    if (index % 2 === 0) return part;
    const keys = document.createElement('span');
    keys.dataset.keys = part;
    return keys;
  });
}

/**
 * Writes the texts of texts.js into the elements that name one by `data-words`. An entry is a text, or an object of `text`,
 * `label` (for those who hear the page) and `tip` (under the mouse).
 */
export function writeWords(root, words) {
  for (const element of root.querySelectorAll('[data-words]')) {
    const entry = words[element.dataset.words];
    const { text, label, tip } = typeof entry === 'string' ? { text: entry } : entry;
    if (text) element.replaceChildren(...parts(element.ownerDocument, text));
    if (label) element.setAttribute('aria-label', label);
    if (tip) element.title = tip;
  }
}
