/** Phrases that make readers stop, with what to write instead. */
const kPhrases = [
  ['whoever', 'name the person'],
  ['once more', 'again'],
  ['by and by', 'gradually'],
  ['the while', 'the period'],
  ['so many', 'give the number a name'],
  ['to be had', 'available'],
  ['at hand', 'available'],
  ['in vain', 'without success'],
  ['of its own accord', 'automatically'],
  ['lets? go', 'release, disconnect'],
  ['is told', 'is reported'],
  ['tells? (?:of|whether|how|what|which|when)', 'returns, reports, shows'],
  ['as good as', 'almost'],
  ['for good', 'permanently'],
  ['comes? to an end', 'ends'],
];

export function oddPhrases(text) {
  return kPhrases.flatMap(([phrase, instead]) =>
    [...text.matchAll(new RegExp(`\\b${phrase}\\b`, 'gi'))].map((match) => ({
      index: match.index,
      offset: match[0].length,
      reason: `"${match[0]}": ${instead}`,
    })),
  );
}
