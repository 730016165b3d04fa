/** Rates at which encoders are compared, kbit/s. */
export const kRates = [3000, 5000];

/**
 * Measures an encoder from the middle of its quantisers outwards, until the measured rates include those to compare.
 * Returns the points, from fine to coarse.
 */
export async function pointsAround(quantisers, measure) {
  let finest = Math.floor(quantisers.length / 2);
  let coarsest = finest;
  const points = [await measure(quantisers[finest])];
  while (points[0].rate < Math.max(...kRates) && finest > 0) points.unshift(await measure(quantisers[--finest]));
  while (points.at(-1).rate > Math.min(...kRates) && coarsest < quantisers.length - 1) {
    points.push(await measure(quantisers[++coarsest]));
  }
  return points;
}

/** Figures at a rate, between the measured ones, over the logarithm of the rate; null outside of them. */
export function at(rate, points) {
  const rising = [...points].sort((a, b) => a.rate - b.rate);
  const above = rising.findIndex((point) => point.rate >= rate);
  if (above === -1 || (above === 0 && rising[0].rate > rate)) return null;
  const [low, high] = [rising[Math.max(0, above - 1)], rising[above]];
  const share = low === high ? 0 : Math.log(rate / low.rate) / Math.log(high.rate / low.rate);
  const between = (key) => low[key] + share * (high[key] - low[key]);
  return { cpu: between('cpu'), ssim: between('ssim'), psnr: between('psnr') };
}
