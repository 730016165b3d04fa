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

/// What the server reports of itself, as JSON: `/statistics.json` and `/trace.json`, the newest stage runs as a Chrome
/// trace, its nodes' below its own, to its operator, and `/sharing.json`, what sharing saves, to anybody. Made on a
/// thread of its own, one at a time, each kind at most once a second however many ask. All who read one share it. Of
/// the trace, which is large, there is no second one: as long as somebody reads it, others get the same.
class LiveReports {
 public:
  using Report = std::shared_ptr<const std::string>;

  /// `ready` is called on that thread whenever a report is there. `host` outlives this.
  LiveReports(const Host& host, std::function<void()> ready);
  ~LiveReports();
  LiveReports(const LiveReports&) = delete;
  LiveReports& operator=(const LiveReports&) = delete;

  [[nodiscard]] static bool has(std::string_view path, Audience audience) noexcept;

  /// The report at a path that has() knows, if it was made less than a second before `asked` (of
  /// pipeline::wallSeconds()) or is a trace that is being read; else none, and it is made. Any thread.
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
