#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "stream/load/load_report.h"
#include "stream/load/picture_check.h"
#include "stream/load/steering.h"
#include "stream/protocol/protocol.h"
#include "stream/session/stroll.h"

namespace grove::stream {

/// One visitor of a load test: walks, looks around, acknowledges each frame on arrival, and measures. Uses no sockets.
/// Not thread-safe. Times are seconds of pipeline::wallSeconds().
class LoadVisitor {
 public:
  /// `index` makes visitors differ; `plan` outlives this; visitors of one thread may share `decoder`.
  LoadVisitor(int index, const LoadPlan& plan, JpegDecoder& decoder);

  /// Sets the negotiated sub-protocol, before all other calls; grove.v1 if not called.
  void agreedOn(std::string_view subProtocol);

  /// The next input is due; the page sends at most one per displayed frame.
  void inputDue() { inputDue_ = true; }

  /// Returns the next message to send; empty if there is none. An input counts as sent at `now`.
  [[nodiscard]] std::vector<std::uint8_t> nextMessage(double now);
  [[nodiscard]] bool hasMessage() const { return !helloSent_ || !replies_.empty() || (inputDue_ && isLetIn()); }

  /// Handles a complete message of the server.
  void receive(std::span<const std::uint8_t> message, double now);

  void fail(std::string reason) { statistics_.errors.push_back(std::move(reason)); }

  [[nodiscard]] bool isLetIn() const noexcept { return welcome_.has_value(); }
  /// Admitted, and at the begin of the walk.
  [[nodiscard]] bool isInPlace() const { return steering_ && steering_->isInPlace(); }

  /// Begins the measurement; errors count always.
  void beginCounting(double now);
  void endCounting(double now);
  [[nodiscard]] const VisitorStatistics& statistics() const noexcept { return statistics_; }

 private:
  [[nodiscard]] world::Input steer(double now);
  void take(const Welcome& welcome);
  void takePicture(const PictureHeader& header, std::span<const std::uint8_t> picture, std::size_t bytes, double now);
  void takeStatus(const Status& status, double now);
  void reply(const PictureHeader& header, double now);
  /// The screen shows the effect of this input.
  void showsInput(std::uint32_t input, double now);
  void recordUpdate(double now);
  /// The server names this limit from now on.
  void isLimitedBy(LimitedBy limit, double now);

  const int index_;
  const LoadPlan& plan_;
  PictureCheck check_;
  bool video_ = false;
  std::optional<Welcome> welcome_;
  std::optional<Steering> steering_;
  bool offerSent_ = false;
  bool helloSent_ = false;
  bool inputDue_ = false;
  std::deque<std::vector<std::uint8_t>> replies_;  ///< to pictures; as bounded as the frames in flight
  std::optional<double> walksSince_;
  std::uint32_t lastInput_ = 0;
  InputLatency latency_;
  std::uint32_t lastFrame_ = 0;
  std::uint32_t lastInputOfPicture_ = 0;
  std::uint32_t lastInputShown_ = 0;
  std::optional<ShownPicture> screen_;
  double lastUpdate_ = 0.0;
  LimitedBy limit_ = LimitedBy::kNothing;
  double limitedSince_ = 0.0;
  VisitorStatistics statistics_;
};

}  // namespace grove::stream
