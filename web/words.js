/** The text in parts: each `{action}` becomes an element for the action's keys (key_hints.js). */
function parts(document, text) {
  return text.split(/\{(\w+)\}/).map((part, index) => {
    if (index % 2 === 0) return part;
    const keys = document.createElement('span');
    keys.dataset.keys = part;
    return keys;
  });
}

/**
 * Writes the texts of texts.js into elements with `data-words`. An entry is a text, or an object of `text`, `label`
 * (for screen readers) and `tip` (the tooltip).
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
