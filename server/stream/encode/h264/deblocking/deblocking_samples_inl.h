// The deblocking filter's arithmetic on sixteen pixels of an edge (ITU-T H.264, 8.7.2.2 to 8.7.2.4), all in bytes. The
// standard calls pixels p0 to p3, away from the edge to the left or upwards, and q0 to q3 on the other side. For
// kernels: included once per target, after <hwy/highway.h>.

#if defined(GROVE_STREAM_ENCODE_H264_DEBLOCKING_DEBLOCKING_SAMPLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_STREAM_ENCODE_H264_DEBLOCKING_DEBLOCKING_SAMPLES_INL_H
#undef GROVE_STREAM_ENCODE_H264_DEBLOCKING_DEBLOCKING_SAMPLES_INL_H
#else
#define GROVE_STREAM_ENCODE_H264_DEBLOCKING_DEBLOCKING_SAMPLES_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace grove::stream::h264::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::FixedTag<std::uint8_t, 16>;
using ByteVec = hn::Vec<Bytes>;
using ByteMask = hn::Mask<Bytes>;

HWY_INLINE ByteVec every(int value) { return hn::Set(Bytes(), static_cast<std::uint8_t>(value)); }

HWY_INLINE ByteVec difference(ByteVec a, ByteVec b) { return hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a)); }

/// a < b. Bytes have no unsigned comparison on x86.
HWY_INLINE ByteMask isLess(ByteVec a, ByteVec b) { return hn::Not(hn::Eq(hn::SaturatedSub(b, a), hn::Zero(Bytes()))); }

HWY_INLINE ByteVec clamped(ByteVec value, ByteVec around, ByteVec by) {
  return hn::Min(hn::Max(value, hn::SaturatedSub(around, by)), hn::SaturatedAdd(around, by));
}

/// (a + b) >> 1
HWY_INLINE ByteVec meanDown(ByteVec a, ByteVec b) {
  return hn::Sub(hn::AverageRound(a, b), hn::And(hn::Xor(a, b), every(1)));
}

/// Means of four: `rounded` is (a + b + c + d + 2) >> 2, and `down` is (a + b + c + d) >> 2.
struct MeansOf4 {
  ByteVec rounded;
  ByteVec down;
};

HWY_INLINE MeansOf4 meansOf4(ByteVec a, ByteVec b, ByteVec c, ByteVec d) {
  const auto ab = hn::AverageRound(a, b);
  const auto cd = hn::AverageRound(c, d);
  // The sum's half, rounded down, is ab + cd less 1 if any of both was rounded up.
  const auto roundedUp = hn::Or(hn::Xor(a, b), hn::Xor(c, d));
  const auto odd = hn::Xor(ab, cd);
  const auto rounded = hn::Sub(hn::AverageRound(ab, cd), hn::And(hn::And(odd, roundedUp), every(1)));
  // The sum's bit 1 shows whether rounding increased the mean.
  return {rounded, hn::Sub(rounded, hn::And(hn::Xor(odd, roundedUp), every(1)))};
}

/// One edge's alpha and beta.
struct Thresholds {
  ByteVec alpha;
  ByteVec beta;
};

/// 8-468, without the strength.
HWY_INLINE ByteMask isFiltered(ByteVec p1, ByteVec p0, ByteVec q0, ByteVec q1, const Thresholds& thresholds) {
  const auto across = hn::SaturatedSub(thresholds.alpha, difference(p0, q0));
  const auto beside = hn::Min(hn::SaturatedSub(thresholds.beta, difference(p1, p0)),
                              hn::SaturatedSub(thresholds.beta, difference(q1, q0)));
  return hn::Not(hn::Eq(hn::Min(across, beside), hn::Zero(Bytes())));
}

/// 8-475 to 8-478: moves p0 and q0 towards each other, by `clip` (tC) at most.
HWY_INLINE void approach(ByteVec p1, ByteVec& p0, ByteVec& q0, ByteVec q1, ByteVec clip) {
  // delta = (4 (q0 - p0) + p1 - q1 + 4) >> 3 = half + ((quarter + low + 1) >> 1), where half = (q0 - p0) >> 1, low is
  // the bit that this loses, and quarter = (p1 - q1) >> 2. Here, half is more by 128, and quarter by 66.
  const auto half = hn::AverageRound(q0, hn::Not(p0));
  const auto low = hn::And(hn::Xor(q0, p0), every(1));
  const auto quarter = hn::AverageRound(hn::AverageRound(p1, hn::Not(q1)), every(3));
  const auto rest = hn::AverageRound(quarter, low);
  // tC is 27 at most, so it does not matter that the sum ends at 255.
  const auto sum = hn::SaturatedAdd(half, rest);
  const auto zero = every(128 + 66 / 2);
  const auto up = hn::Min(hn::SaturatedSub(sum, zero), clip);
  const auto down = hn::Min(hn::SaturatedSub(zero, sum), clip);
  p0 = hn::SaturatedSub(hn::SaturatedAdd(p0, up), down);
  q0 = hn::SaturatedAdd(hn::SaturatedSub(q0, up), down);
}

/// Strengths 1 to 3 of luma (8.7.2.3). `clips` as in DeblockingLimits, for each pixel.
HWY_INLINE void filterLuma(ByteVec p2, ByteVec& p1, ByteVec& p0, ByteVec& q0, ByteVec& q1, ByteVec q2, ByteVec clips,
                           const Thresholds& thresholds) {
  clips = hn::IfThenElseZero(isFiltered(p1, p0, q0, q1, thresholds), clips);
  const auto tC0 = hn::SaturatedSub(clips, every(1));
  const auto some = hn::Min(clips, every(1));
  // Each 1 where that side is smooth and the edge is filtered.
  const auto smoothP = hn::Min(hn::SaturatedSub(thresholds.beta, difference(p2, p0)), some);
  const auto smoothQ = hn::Min(hn::SaturatedSub(thresholds.beta, difference(q2, q0)), some);
  const auto middle = hn::AverageRound(p0, q0);
  const auto onlyWhere = [](ByteVec flags, ByteVec value) {
    return hn::IfThenZeroElse(hn::Eq(flags, hn::Zero(Bytes())), value);
  };
  const auto newP1 = clamped(meanDown(p2, middle), p1, onlyWhere(smoothP, tC0));
  const auto newQ1 = clamped(meanDown(q2, middle), q1, onlyWhere(smoothQ, tC0));
  approach(p1, p0, q0, q1, hn::Add(tC0, hn::Add(smoothP, smoothQ)));
  p1 = newP1;
  q1 = newQ1;
}

/// Strengths 1 to 3 of chroma (8.7.2.3).
HWY_INLINE void filterChroma(ByteVec p1, ByteVec& p0, ByteVec& q0, ByteVec q1, ByteVec clips,
                             const Thresholds& thresholds) {
  approach(p1, p0, q0, q1, hn::IfThenElseZero(isFiltered(p1, p0, q0, q1, thresholds), clips));
}

/// 8-487: p0 of the weak variant of strength 4, of which q0 is the mirror image: (2 p1 + p0 + q1 + 2) >> 2.
HWY_INLINE ByteVec weaklySmoothed(ByteVec p1, ByteVec p0, ByteVec q1) { return hn::AverageRound(p1, meanDown(p0, q1)); }

/// Strength 4 of chroma (8.7.2.4).
HWY_INLINE void smoothChroma(ByteVec p1, ByteVec& p0, ByteVec& q0, ByteVec q1, const Thresholds& thresholds) {
  const auto filtered = isFiltered(p1, p0, q0, q1, thresholds);
  const auto newP0 = hn::IfThenElse(filtered, weaklySmoothed(p1, p0, q1), p0);
  q0 = hn::IfThenElse(filtered, weaklySmoothed(q1, q0, p1), q0);
  p0 = newP0;
}

/// One side of an edge of luma.
struct LumaSide {
  ByteVec pixels[4];  ///< away from the edge
};

/// Strength 4 of luma (8.7.2.4): one side, from q0 and q1 of the other. `small`: whether p0 and q0 differ by little.
HWY_INLINE LumaSide smoothed(const LumaSide& p, ByteVec q0, ByteVec q1, ByteMask filtered, ByteMask small,
                             const Thresholds& thresholds) {
  const auto [p0, p1, p2, p3] = p.pixels;
  const auto wide = hn::And(small, isLess(difference(p2, p0), thresholds.beta));
  const auto means = meansOf4(p2, p1, p0, q0);
  // (p2 + 2 p1 + 2 p0 + 2 q0 + q1 + 4) >> 3
  const auto newP0 = meansOf4(p1, p0, q0, meanDown(p2, q1)).rounded;
  // (2 p3 + 3 p2 + p1 + p0 + q0 + 4) >> 3: the mean of two means, of p3 and p2 and of p2 to q0. Where the first loses a
  // half, rounding the second to the nearest makes up for it.
  const auto odd = hn::Not(hn::Eq(hn::And(hn::Xor(p3, p2), every(1)), hn::Zero(Bytes())));
  const auto newP2 = hn::AverageRound(meanDown(p3, p2), hn::IfThenElse(odd, means.rounded, means.down));
  return {{hn::IfThenElse(wide, newP0, hn::IfThenElse(filtered, weaklySmoothed(p1, p0, q1), p0)),
           hn::IfThenElse(wide, means.rounded, p1), hn::IfThenElse(wide, newP2, p2), p3}};
}

/// `smallStep`: (alpha >> 2) + 2.
HWY_INLINE void smoothLuma(LumaSide& p, LumaSide& q, ByteVec smallStep, const Thresholds& thresholds) {
  const auto filtered = isFiltered(p.pixels[1], p.pixels[0], q.pixels[0], q.pixels[1], thresholds);
  const auto small = hn::And(filtered, isLess(difference(p.pixels[0], q.pixels[0]), smallStep));
  const LumaSide newP = smoothed(p, q.pixels[0], q.pixels[1], filtered, small, thresholds);
  q = smoothed(q, p.pixels[0], p.pixels[1], filtered, small, thresholds);
  p = newP;
}

}  // namespace grove::stream::h264::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
