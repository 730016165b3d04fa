#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stream/encode/jpeg_decoder.h"
#include "stream/load_report.h"
#include "stream/protocol.h"
#include "stream/stroll.h"

namespace grove::stream {

/// One visitor of a load test: walks, looks around, acknowledges each frame when it is there, and measures. Knows no
/// sockets. One thread. Times are seconds of world::World::now().
class LoadVisitor {
 public:
  /// `index` makes visitors differ; `decoder` may be shared by all of a thread.
  LoadVisitor(int index, int width, int height, JpegDecoder& decoder);

  /// Time for the next input; the page sends one per displayed frame at most.
  void inputDue() { inputDue_ = true; }

  /// The next message to send, empty if there is none. An input counts as sent at `now`.
  [[nodiscard]] std::vector<std::uint8_t> nextMessage(double now);
  [[nodiscard]] bool hasMessage() const { return !helloSent_ || acknowledge_ || (inputDue_ && isLetIn()); }

  /// Takes a whole message of the server.
  void receive(std::span<const std::uint8_t> message, double now);

  void fail(std::string reason) { statistics_.errors.push_back(std::move(reason)); }

  [[nodiscard]] bool isLetIn() const noexcept { return welcome_.has_value(); }

  /// What is counted begins here, errors excepted.
  void beginCounting();
  [[nodiscard]] const VisitorStatistics& statistics() const noexcept { return statistics_; }

 private:
  [[nodiscard]] world::Input steer(double now);
  void receiveFrame(const FrameMessage& frame, std::size_t bytes, double now);
  void checkPicture(const FrameMessage& frame);

  const int index_;
  const int width_;
  const int height_;
  JpegDecoder& decoder_;
  std::optional<Welcome> welcome_;
  bool helloSent_ = false;
  bool inputDue_ = false;
  std::optional<Ack> acknowledge_;
  std::optional<double> walksSince_;
  std::uint32_t lastInput_ = 0;
  InputLatency latency_;
  std::uint32_t lastFrame_ = 0;
  std::uint32_t lastInputShown_ = 0;
  std::uint64_t framesReceived_ = 0;
  VisitorStatistics statistics_;
};

}  // namespace grove::stream
