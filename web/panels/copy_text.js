/** Browsers give the clipboard's interface to https and localhost only; the older way works everywhere else. */
function copyBySelection(document, text) {
  const field = Object.assign(document.createElement('textarea'), { value: text });
  document.body.append(field);
  field.select();
  const isCopied = document.execCommand('copy');
  field.remove();
  if (!isCopied) throw new Error('the browser does not copy');
}

/** Copies text for the visitor; rejects where the browser refuses. Only from within a click or a key. */
export async function copyText({ document, navigator }, text) {
  if (navigator.clipboard) await navigator.clipboard.writeText(text);
  else copyBySelection(document, text);
}
