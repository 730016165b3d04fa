#pragma once

#include <array>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "stream/session/host.h"
#include "stream/web_server/audience.h"

namespace grove::stream {

/// Makes the server's reports, as JSON. `/statistics.json` and `/trace.json` are for the operator; the trace is a
/// Chrome trace of the newest stage runs of the server and its nodes. `/sharing.json` reports what sharing saves, for
/// all visitors. One thread makes all reports, each at most once a second; all readers share it. The trace is large, so
/// there is one at a time: while a reader downloads it, other readers get the same trace.
class LiveReports {
 public:
  using Report = std::shared_ptr<const std::string>;

  /// `ready` is called on that thread when a report is ready. `host` outlives this.
  LiveReports(const Host& host, std::function<void()> ready);
  ~LiveReports();
  LiveReports(const LiveReports&) = delete;
  LiveReports& operator=(const LiveReports&) = delete;

  [[nodiscard]] static bool has(std::string_view path, Audience audience) noexcept;

  /// Returns the report at `path`, which has() must know. Returns null and starts to make the report if the last one is
  /// more than a second older than `asked` (of pipeline::wallSeconds()), unless it is a trace in transfer. Any thread.
  [[nodiscard]] Report find(std::string_view path, double asked);

 private:
  struct Slot {
    Report report;
    double begun = 0.0;
    bool wanted = false;
  };
  void run();
  [[nodiscard]] std::optional<std::size_t> firstWanted() const;

  static constexpr std::size_t kKinds = 3;

  const Host& host_;
  const std::function<void()> ready_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::array<Slot, kKinds> slots_;
  std::thread thread_;
};

}  // namespace grove::stream
