#include "stream/encode/quantiser_control.h"

#include <algorithm>
#include <cmath>

namespace grove::stream {
namespace {

constexpr double kStepsPerHalving = 6.0;
/// An independent picture may take the bytes of this many others: it is rare.
constexpr double kIndependentShare = 3.0;
/// Each picture saves this share of the debt, but no picture gets less than kMinShare of its share.
constexpr double kRepayment = 0.2;
constexpr double kMinShare = 0.4;
/// Debts decay, because the line has had time to send them.
constexpr double kDebtDecay = 0.9;
constexpr double kCalming = 0.06;

double bitsAtZero(double pixels, Quantiser quantiser, double bytes) {
  return bytes * 8.0 / pixels * std::exp2(quantiser / kStepsPerHalving);
}

}  // namespace

Quantiser QuantiserControl::choose(bool independent, double pixels, double bytes) const {
  const double share = independent ? kIndependentShare * bytes : bytes;
  const double wanted = std::max(share * kMinShare, share - kRepayment * std::max(0.0, debt_));
  const double needed = (independent ? independent_ : dependent_) * pixels / 8.0;
  return kStepsPerHalving * std::log2(std::max(1e-9, needed / std::max(1.0, wanted)));
}

void QuantiserControl::encoded(bool independent, double pixels, Quantiser quantiser, double bytes, double wantedBytes) {
  const double now = bitsAtZero(pixels, quantiser, bytes);
  debt_ = std::max(0.0, kDebtDecay * debt_ + bytes - wantedBytes);
  if (independent) {
    independent_ = now;
    return;
  }
  // Rises at once, falls over two or three pictures: one cheap picture must not make the next one too large.
  dependent_ = now > dependent_ ? now : 0.5 * (now + dependent_);
  complexity_ = std::max(dependent_, complexity_ + kCalming * (dependent_ - complexity_));
}

void QuantiserControl::rested() {
  debt_ *= kDebtDecay;
  dependent_ *= 0.5;
  complexity_ += kCalming * (dependent_ - complexity_);
}

}  // namespace grove::stream
