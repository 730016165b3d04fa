/**
 * What has to be said before the figures can be read, `null` if they speak for themselves. `state` is `asking`, `live`,
 * `paused` or `lost`; `heard` is the time of day of the newest answer, or `null`.
 */
export function situation(state, statistics, heard) {
  if (state === 'asking') return heard ? null : { title: 'Asking the server\u2026', text: '' };
  if (state === 'lost') {
    const last = heard ? `What you see is what it said last, at ${heard}. ` : '';
    return { title: 'The server is out of reach', text: `${last}Trying again\u2026` };
  }
  if (state === 'paused') return { title: 'Paused', text: 'Nothing is asked while nobody looks.' };
  const { amortization } = statistics;
  if (amortization === undefined) {
    return {
      title: 'This server does not tell what sharing saves',
      text: 'It is not of the version that this page was made for. Reload the page for the one that it has.',
    };
  }
  if (amortization === null && statistics.visitors > 0) {
    return { title: 'Somebody has come', text: 'The first figures follow in a few seconds.' };
  }
  if (amortization === null) {
    return { title: 'Nobody is here', text: 'What sharing saves is measured while somebody is being served.' };
  }
  if (amortization.mode === 'private') {
    return {
      title: 'Private mode',
      text: 'Every visitor has a world of their own and nothing is shared: this is what serving costs without sharing.',
    };
  }
  return null;
}
