/** Browsers have the Clipboard API on https and localhost only; this older way works everywhere else. */
function copyBySelection(document, text) {
  const field = Object.assign(document.createElement('textarea'), { value: text });
  document.body.append(field);
  field.select();
  const isCopied = document.execCommand('copy');
  field.remove();
  if (!isCopied) throw new Error('the browser refuses to copy');
}

/** Copies text; rejects if the browser refuses. Works only within a click or key press. */
export async function copyText({ document, navigator }, text) {
  if (navigator.clipboard) await navigator.clipboard.writeText(text);
  else copyBySelection(document, text);
}
