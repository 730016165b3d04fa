#include "stream/adapt/stream_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <vector>

namespace grove::stream {
namespace {

constexpr double kWhole = 1280.0 * 720.0;
constexpr QuantiserRange kRange{.finest = 20.0, .usual = 25.0, .coarsest = 40.0};

/// A visitor whose page decodes all there is, on a line that is always good.
class Led {
 public:
  explicit Led(PageLevel page = PageLevel::kTimed)
      : encoders_(builtinEncoders(75)),
        control_(encoders_, std::make_shared<Governor>([] { return 1.0; }), page, 30.0, 1280, 720) {
    control_.offer({kCodecH264, kCodecJpeg});
  }

  StreamControl& control() { return control_; }
  const EncoderRegistry& encoders() { return encoders_; }

  /// What delays the next frames, seconds.
  struct Delays {
    double server = 0.0;  ///< a due frame waits for a worker
    double line = 0.010;  ///< each way
    double page = 0.010;  ///< that it works on each frame, one after the other
  };
  void delay(const Delays& delays) { delays_ = delays; }

  /// One frame of so many bytes; returns what was ordered.
  StreamControl::Choice frame(std::size_t bytes, bool still = false, bool same = false) {
    now_ += 1.0 / 30.0;
    const double ready = now_ + delays_.server;
    while (now_ < ready) {
      control_.waitsForServer(now_);
      now_ += kStep;
    }
    while (!control_.mayBegin(now_, 0)) {
      now_ += kStep;
      acknowledge();
    }
    control_.begins(now_);
    const StreamControl::Choice choice = control_.choose(control_.kind(), kRange, kWhole, still, same, now_);
    control_.encoded(choice, choice.order.independent, kWhole, bytes);
    ++number_;
    control_.sent(number_, number_, bytes, choice.bytes, now_);
    control_.written(number_, now_, now_);
    const double arrived = now_ + delays_.line;
    painted_ = std::max(arrived, painted_) + delays_.page;
    reports_.push_back({painted_ + delays_.line, number_, arrived, painted_ - arrived});
    acknowledge();
    return choice;
  }
  [[nodiscard]] double now() const { return now_; }

 private:
  static constexpr double kStep = 0.001;
  struct Report {
    double due;
    std::uint32_t frame;
    double arrived;
    double held;
  };

  void acknowledge() {
    while (!reports_.empty() && reports_.front().due <= now_) {
      const Report& each = reports_.front();
      (void)control_.acknowledged(
          each.frame,
          {.acknowledged = each.due, .held = each.held, .pageSeconds = each.arrived, .browserBusy = each.held > 0.050});
      reports_.pop_front();
    }
  }

  const EncoderRegistry encoders_;
  StreamControl control_;
  Delays delays_;
  std::deque<Report> reports_;
  double painted_ = 0.0;  ///< when the page had painted the newest frame
  std::uint32_t number_ = 0;
  double now_ = 100.0;
};

// Fault: somebody who says again and again that he cannot decode, and gets as many pictures of several times the size.
TEST(StreamControl, LimitsIndependentPictures) {
  Led led;
  (void)led.frame(10'000);
  int independent = 0;
  for (int i = 0; i < 30; ++i) {
    for (int k = 0; k < 7; ++k) led.control().broken();
    independent += led.frame(10'000).order.independent ? 1 : 0;
  }
  EXPECT_GE(independent, 2);
  EXPECT_LE(independent, 5);
  for (int i = 0; i < 15; ++i) independent += led.frame(10'000).order.independent ? 1 : 0;
  EXPECT_LE(independent, 6) << "after the last request one is made and no more";
}

// Fault: the first picture of a stream, or of one that was hidden, that depends on others.
TEST(StreamControl, BeginsWithAnIndependentPicture) {
  Led led;
  EXPECT_TRUE(led.frame(10'000).order.independent);
  EXPECT_FALSE(led.frame(10'000).order.independent);
  for (int i = 0; i < 15; ++i) (void)led.frame(10'000);
  Limits hidden;
  hidden.hidden = true;
  led.control().limit(hidden);
  EXPECT_FALSE(led.control().mayBegin(led.now(), 0));
  led.control().limit({});
  EXPECT_TRUE(led.frame(10'000).order.independent);
}

// Faults: an encoder that failed and is asked again, or no other one; an offer that is not obeyed.
TEST(StreamControl, AvoidsFailedEncoders) {
  Led led;
  EXPECT_EQ(led.control().kind().codec, kCodecH264);
  led.control().failed(led.control().kind());
  EXPECT_EQ(led.control().kind().codec, kCodecJpeg);
  led.control().offer({kCodecH264});
  EXPECT_EQ(led.control().kind().codec, kCodecJpeg);
}

// Faults: a picture that stands still and stays as coarse as one that moves; one that gets finest all at once.
TEST(StreamControl, RefinesStillViews) {
  Led led;
  Quantiser quantiser = 0.0;
  for (int i = 0; i < 60; ++i) quantiser = led.frame(12'000).order.quantiser;
  EXPECT_GE(quantiser, kRange.usual);
  for (int i = 0; i < 60; ++i) {
    const Quantiser next = led.frame(300, true, true).order.quantiser;
    EXPECT_LE(next, quantiser);
    EXPECT_GE(next, quantiser - 3.0);
    quantiser = next;
  }
  EXPECT_EQ(quantiser, kRange.finest);
  EXPECT_GE(led.frame(12'000).order.quantiser, kRange.usual);
}

// Fault: what the page shows already is told neither by a picture nor by a status.
TEST(StreamControl, AcknowledgesInputsWithoutEffect) {
  Led led;
  (void)led.frame(10'000);
  (void)led.control().takeStatus(led.now(), 1);
  EXPECT_FALSE(led.control().takeStatus(led.now() + 0.01, 1));
  led.control().unchanged(77);
  const auto status = led.control().takeStatus(led.now() + 0.02, 1);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->lastInput, 77U);
  EXPECT_FALSE(led.control().takeStatus(led.now() + 0.03, 1));
}

// Fault: who looks at a still view is not told that others have come or gone.
TEST(StreamControl, ReportsRosterChanges) {
  Led led;
  (void)led.frame(10'000);
  (void)led.control().takeStatus(led.now(), 1);
  const auto status = led.control().takeStatus(led.now() + 0.01, 2);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->visitors, 2);
  EXPECT_FALSE(led.control().takeStatus(led.now() + 0.02, 2));
}

// Faults: a limit that is exceeded; one of nothing at all, that stops the stream.
TEST(StreamControl, RespectsVisitorLimits) {
  Led led;
  Limits limits;
  limits.kilobitsPerSecond = 1000;
  led.control().limit(limits);
  for (int i = 0; i < 90; ++i) {
    const StreamControl::Choice choice = led.frame(4'000);
    EXPECT_LE(choice.bytes * 8.0 * led.control().framesPerSecond(), 1e6);
  }
  limits.kilobitsPerSecond = 1;
  limits.lines = 1;
  limits.framesPerSecond = 1;
  led.control().limit(limits);
  for (int i = 0; i < 90; ++i) {
    EXPECT_GT(led.frame(300).bytes, 100.0);
    EXPECT_GE(led.control().framesPerSecond(), 1.0);
  }
}

/// Who limits the stream after ten seconds with these delays.
LimitedBy limitedAfter(const Led::Delays& delays) {
  Led led;
  led.delay(delays);
  for (double end = led.now() + 10.0; led.now() < end;) (void)led.frame(18'000);
  return led.control().status().limitedBy;
}

// Faults: the line that is blamed for a busy server or browser; nobody who is blamed; somebody who is, for nothing.
TEST(StreamControl, NamesTheBottleneck) {
  EXPECT_EQ(limitedAfter({}), LimitedBy::kNothing);
  EXPECT_EQ(limitedAfter({.line = 0.075}), LimitedBy::kNothing) << "a long way is not a slow line";
  EXPECT_EQ(limitedAfter({.server = 0.030}), LimitedBy::kMachine);
  EXPECT_EQ(limitedAfter({.page = 0.060}), LimitedBy::kBrowser);
  EXPECT_EQ(limitedAfter({.server = 0.010, .line = 0.001, .page = 0.090}), LimitedBy::kBrowser);
}

// Faults: pictures that get smaller before they get fewer for a busy browser; a full server that loses frames and goes
// on drawing whole pictures, or names somebody else as the reason.
TEST(StreamControl, BusyBrowserGetsFewerFramesFullServerFewerPixels) {
  Led led;
  led.delay({.line = 0.001, .page = 0.060});
  for (double end = led.now() + 8.0; led.now() < end;) (void)led.frame(18'000);
  EXPECT_EQ(led.control().framesPerSecond(), 20.0);
  EXPECT_EQ(led.control().status().height, 720);
  Led other;
  other.delay({.server = 0.001});
  for (double end = other.now() + 20.0; other.now() < end;) (void)other.frame(18'000);
  EXPECT_EQ(other.control().status().height, 720);
  other.delay({.server = 0.020});
  for (double end = other.now() + 3.2; other.now() < end;) (void)other.frame(18'000);
  EXPECT_EQ(other.control().status().height, 480);
  EXPECT_EQ(other.control().framesPerSecond(), 30.0);
  EXPECT_EQ(other.control().status().limitedBy, LimitedBy::kMachine);
}

// Faults: a full server that gives whole pictures, or as many as ever, to a page that moves them; that takes pictures
// from one that does not; a visitor's own limit that is forgotten.
TEST(StreamControl, FullServerSendsFewerPicturesToPagesThatMoveThem) {
  for (const bool moves : {true, false}) {
    Led led(PageLevel::kMoving);
    led.control().limit({.nearness = moves});
    led.delay({.server = 0.020});
    for (double end = led.now() + 3.2; led.now() < end;) (void)led.frame(18'000);
    EXPECT_EQ(led.control().framesPerSecond(), moves ? 20.0 : 30.0);
    EXPECT_EQ(led.control().status().height, moves ? 720 : 480);
    EXPECT_EQ(led.control().status().limitedBy, LimitedBy::kMachine);
    led.control().limit({.nearness = moves, .framesPerSecond = 12});
    (void)led.frame(18'000);
    EXPECT_EQ(led.control().framesPerSecond(), 12.0);
  }
}

// Faults: H.264 for a server that has no time for it, over a line that could carry anything; JPEG for a visitor who
// insists on H.264.
TEST(StreamControl, ChoosesTheCheapCodecUnderLoad) {
  for (const bool insists : {false, true}) {
    Led led;
    if (insists) led.control().offer({kCodecH264});
    led.delay({.server = 0.030, .line = 0.001});
    for (int i = 0; i < 300; ++i) (void)led.frame(led.control().kind().codec == kCodecJpeg ? 110'000 : 18'000);
    EXPECT_EQ(led.control().kind().codec, insists ? kCodecH264 : kCodecJpeg);
  }
}

// Fault: a frame that was never sent, whose acknowledgement counts.
TEST(StreamControl, RefusesAcknowledgementsOfUnsentFrames) {
  Led led;
  (void)led.frame(10'000);
  EXPECT_FALSE(led.control().acknowledged(2, {.acknowledged = led.now()}));
  EXPECT_TRUE(led.control().acknowledged(1, {.acknowledged = led.now()}));
}

}  // namespace
}  // namespace grove::stream
