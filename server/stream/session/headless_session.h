#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "stream/session/host.h"
#include "stream/session/session.h"

namespace grove::stream {

/// A visitor without a browser or a socket, for tests and benchmarks: the same Session that a browser gets, which
/// acknowledges each frame as it comes. Any thread.
class HeadlessSession {
 public:
  /// Sees each frame as it comes, on a worker thread; may still be called while the session is being destroyed.
  using Watch = std::function<void(const FrameHeader&)>;

  /// Plays one of `codecs`. Throws EnvironmentError if the host refuses.
  HeadlessSession(Host& host, const std::string& name, int width, int height, Watch watch = {},
                  std::vector<std::uint8_t> codecs = {kCodecJpeg});
  ~HeadlessSession();
  HeadlessSession(const HeadlessSession&) = delete;
  HeadlessSession& operator=(const HeadlessSession&) = delete;

  [[nodiscard]] Session& session() noexcept { return *session_; }
  [[nodiscard]] Welcome welcome() const { return session_->welcome(); }

  /// Sets the controls and returns the input's number.
  std::uint32_t control(std::uint8_t keys, float yaw, float pitch);

  /// The newest frame once it shows input `number` or a later one; null after `timeout`.
  [[nodiscard]] std::shared_ptr<const EncodedFrame> frameShowing(std::uint32_t number,
                                                                 std::chrono::milliseconds timeout);
  /// A frame that is newer than `frame`; null after `timeout`.
  [[nodiscard]] std::shared_ptr<const EncodedFrame> frameAfter(node::FrameNumber frame,
                                                               std::chrono::milliseconds timeout);

  [[nodiscard]] std::uint64_t framesReceived() const;

 private:
  /// Where frames go; outlives the visitor for as long as a worker still delivers.
  struct Inbox {
    std::mutex mutex;
    std::condition_variable arrived;
    std::shared_ptr<const EncodedFrame> newest;
    std::uint64_t count = 0;
    std::weak_ptr<Session> session;
  };
  template <class Condition>
  std::shared_ptr<const EncodedFrame> waitFor(Condition condition, std::chrono::milliseconds timeout);

  const std::shared_ptr<Inbox> inbox_;
  std::shared_ptr<Session> session_;
  std::uint32_t lastInput_ = 0;
};

}  // namespace grove::stream
