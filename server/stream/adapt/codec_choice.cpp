#include "stream/adapt/codec_choice.h"

#include <algorithm>

#include "stream/protocol/protocol.h"

namespace grove::stream {
namespace {

/// A trial begins only if the line has carried this share of the codec's bit rate; a larger share cannot be required,
/// because pictures that save bits prove no more.
constexpr double kPromising = 0.5;
/// Headroom of the line over the bit rate, below which the trial ends.
constexpr double kEase = 1.15;
constexpr double kReasonSeconds = 1.0;
constexpr double kMaxFailureRest = 600.0;
constexpr double kMaxWorkRest = 3600.0;
constexpr double kRest = 2.0;
/// A reason this soon after the change back means that the change back was a mistake.
constexpr double kMistakeSeconds = 20.0;

}  // namespace

bool CodecChoice::isWorkSaver(std::uint8_t codec) noexcept { return codec == kCodecJpeg || codec == kCodecJpegPatches; }

void CodecChoice::change(bool savesWork, double now) {
  savesWork_ = savesWork;
  changed_ = now;
  reasonSince_ = -1.0;
}

bool CodecChoice::update(double now, const Means& means) {
  const bool fails =
      means.isLineScarce || means.isBrowserShort || means.lineBitsPerSecond < kEase * means.workSaverBitsPerSecond;
  const bool mayTry = !failed_ || now - changed_ > failureRest_;
  const bool isPromising =
      std::max(means.lineBitsPerSecond, means.provenBitsPerSecond) > kPromising * means.workSaverBitsPerSecond;
  const bool wantsIt = means.isWorkScarce && !means.isStill;
  const bool reason =
      savesWork_ ? fails || !wantsIt : wantsIt && !means.isLineScarce && !means.isBrowserShort && isPromising && mayTry;
  if (!reason) {
    reasonSince_ = -1.0;
    return savesWork_;
  }
  if (reasonSince_ < 0.0) reasonSince_ = now;
  const double lasted = now - reasonSince_;
  if (!savesWork_) {
    if (lasted < kReasonSeconds) return false;
    if (!failed_ && changed_ > 0.0 && now - changed_ < kMistakeSeconds) {
      workRest_ = std::min(kMaxWorkRest, kRest * workRest_);
    }
    change(true, now);
  } else if (fails) {
    if (lasted < kReasonSeconds) return true;
    if (failed_) failureRest_ = std::min(kMaxFailureRest, kRest * failureRest_);
    failed_ = true;
    change(false, now);
  } else if (means.isStill || lasted > workRest_) {
    failed_ = false;
    change(false, now);
  }
  return savesWork_;
}

}  // namespace grove::stream
