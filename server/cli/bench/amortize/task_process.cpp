#include "cli/bench/amortize/task_process.h"

#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <exception>
#include <span>
#include <stdexcept>

#include "base/error.h"
#include "cli/stop_on_signal.h"

namespace grove::cli {
namespace {

enum class Kind : std::uint8_t { kArrived, kResult, kStopped, kFailed };

struct Header {
  Kind kind = Kind::kFailed;
  std::uint64_t bytes = 0;
};

bool sendAll(int link, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = send(link, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

bool receiveAll(int link, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t received = recv(link, bytes.data(), bytes.size(), 0);
    if (received <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(received));
  }
  return true;
}

bool sendMessage(int link, Kind kind, const std::string& text) {
  const Header header{kind, text.size()};
  return sendAll(link, std::as_bytes(std::span(&header, 1))) && sendAll(link, std::as_bytes(std::span(text)));
}

constexpr std::byte kProceed{1};
constexpr std::byte kEnd{0};

std::byte receiveOrder(int link) {
  std::byte order = kEnd;
  return receiveAll(link, {&order, 1}) ? order : kEnd;
}

}  // namespace

bool TaskProcess::Parent::arrive() const {
  return sendMessage(link_, Kind::kArrived, {}) && receiveOrder(link_) == kProceed;
}

TaskProcess::TaskProcess(const Task& task) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw EnvironmentError("cannot open a socket", "grove bench amortize", "raise ulimit -n");
  }
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) become(ends[1], parent, task);
  close(ends[1]);
  link_ = ends[0];
  if (process_ < 0) {
    close(link_);
    throw EnvironmentError("cannot start a process", "grove bench amortize", "raise ulimit -u");
  }
}

TaskProcess::~TaskProcess() {
  (void)sendAll(link_, {&kEnd, 1});
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
  close(link_);
}

/// Neither destructors nor exit handlers run: they belong to the process that was copied.
void TaskProcess::become(int link, pid_t parent, const Task& task) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  try {
    const StopOnSignal stop;
    const std::optional<std::string> result = task(Parent(link), stop.token());
    sendMessage(link, result ? Kind::kResult : Kind::kStopped, result.value_or(""));
  } catch (const std::exception& e) {
    sendMessage(link, Kind::kFailed, e.what());
  }
  (void)receiveOrder(link);
  _exit(0);
}

std::optional<std::string> TaskProcess::await(Interruption& interruption) const {
  if (!interruption.awaitReadable(link_)) return std::nullopt;
  Header header;
  std::string text;
  bool isWhole = receiveAll(link_, std::as_writable_bytes(std::span(&header, 1)));
  if (isWhole) {
    text.resize(header.bytes);
    isWhole = receiveAll(link_, std::as_writable_bytes(std::span(text)));
  }
  if (!isWhole) throw EnvironmentError("a process has ended early", "grove bench amortize", "is there memory enough?");
  if (header.kind == Kind::kFailed) throw std::runtime_error(text);
  if (header.kind != Kind::kStopped) return text;
  interruption.reportStopped();
  return std::nullopt;
}

bool TaskProcess::awaitArrival(Interruption& interruption) { return await(interruption).has_value(); }

void TaskProcess::proceed() const { (void)sendAll(link_, {&kProceed, 1}); }

std::optional<std::string> TaskProcess::awaitResult(Interruption& interruption) { return await(interruption); }

}  // namespace grove::cli
