#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "cli/bench/picture_size.h"
#include "pipeline/clocks.h"
#include "stream/session/headless_session.h"
#include "stream/session/host.h"
#include "stream/session/stroll.h"

namespace grove::cli {

/// Returns the controls of visitor `index`, who arrived with `yaw` and has walked for `seconds`.
using Steering = std::function<world::Input(int index, float yaw, double seconds)>;

/// The pictures that a walker gets.
struct WalkerStream {
  PictureSize size;
  std::uint8_t codec = stream::kCodecJpeg;  ///< with its usual quantiser, without rate control
};

/// A walking visitor of a bench, in the server's process.
class Walker {
 public:
  Walker(stream::Host& host, int index, const WalkerStream& stream, Steering steering);

  void walk(double now);

  [[nodiscard]] std::uint64_t frames() const { return session_.framesReceived(); }

  void beginCounting();
  /// Since then.
  [[nodiscard]] std::uint64_t framesCounted() const { return frames() - framesBefore_; }
  /// Since then, from inputs to the frames that show them, milliseconds.
  [[nodiscard]] std::vector<float> latencies() const;
  /// Of the newest frame.
  [[nodiscard]] std::uint8_t codec() const;

 private:
  /// Outlives the walker while a worker still delivers.
  struct Seen {
    std::mutex mutex;
    stream::InputLatency latency;
    std::vector<float> latencies;
    std::uint8_t codec = stream::kCodecJpeg;
  };
  const int index_;
  const Steering steering_;
  const std::shared_ptr<Seen> seen_ = std::make_shared<Seen>();
  stream::HeadlessSession session_;
  const float yaw_;
  std::optional<double> walksSince_;
  std::uint64_t framesBefore_ = 0;
};

using Walkers = std::vector<std::unique_ptr<Walker>>;

[[nodiscard]] Walkers makeWalkers(stream::Host& host, int count, const WalkerStream& stream, const Steering& steering);

inline constexpr std::chrono::milliseconds kInputPeriod{16};

/// All walk until `done`, in seconds since `begin`; returns false if it was stopped.
template <class Condition>
bool walkUntil(const Walkers& walkers, double begin, const std::stop_token& stop, Condition done) {
  while (!done()) {
    if (stop.stop_requested()) return false;
    for (const auto& walker : walkers) walker->walk(pipeline::wallSeconds() - begin);
    std::this_thread::sleep_for(kInputPeriod);
  }
  return true;
}

}  // namespace grove::cli
