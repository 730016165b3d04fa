// The difference of two rows of pixels. For kernels: included once per target, after <hwy/highway.h>.

#if defined(GROVE_STREAM_ENCODE_H264_PREDICTION_DIFFERENCE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_STREAM_ENCODE_H264_PREDICTION_DIFFERENCE_INL_H
#undef GROVE_STREAM_ENCODE_H264_PREDICTION_DIFFERENCE_INL_H
#else
#define GROVE_STREAM_ENCODE_H264_PREDICTION_DIFFERENCE_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace grove::stream::h264::HWY_NAMESPACE {

/// Sums absolute differences of bytes, a vector at a time.
template <class Bytes>
class DifferenceSum {
  using Sums = hwy::HWY_NAMESPACE::Repartition<std::uint64_t, Bytes>;

 public:
  using Vec = hwy::HWY_NAMESPACE::Vec<Bytes>;

  HWY_INLINE DifferenceSum() : sum_(hwy::HWY_NAMESPACE::Zero(Sums())) {}

  HWY_INLINE void add(Vec a, Vec b) {
    namespace hn = hwy::HWY_NAMESPACE;
    sum_ = hn::Add(sum_, hn::SumsOf8(hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a))));
  }
  [[nodiscard]] HWY_INLINE int total() const {
    namespace hn = hwy::HWY_NAMESPACE;
    return static_cast<int>(hn::GetLane(hn::SumOfLanes(Sums(), sum_)));
  }

 private:
  hwy::HWY_NAMESPACE::Vec<Sums> sum_;
};

}  // namespace grove::stream::h264::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // once per target
