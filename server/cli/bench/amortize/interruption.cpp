#include "cli/bench/amortize/interruption.h"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <ctime>

#include "base/error.h"

namespace grove::cli {

Interruption::Interruption() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  descriptor_ = signalfd(-1, &signals_, SFD_CLOEXEC);
  if (descriptor_ < 0) throw EnvironmentError("cannot wait for signals", "signalfd", "raise ulimit -n");
  sigprocmask(SIG_BLOCK, &signals_, &former_);
}

Interruption::~Interruption() {
  // One Ctrl-C may be two signals: to the process, and to its group.
  constexpr timespec kNow{0, 0};
  while (sigtimedwait(&signals_, nullptr, &kNow) > 0) continue;
  close(descriptor_);
  sigprocmask(SIG_SETMASK, &former_, nullptr);
}

bool Interruption::awaitReadable(int descriptor) {
  std::array<pollfd, 2> both{{{descriptor_, POLLIN, 0}, {descriptor, POLLIN, 0}}};
  while (!hasCome_ && both[1].revents == 0) {
    if (poll(both.data(), both.size(), -1) < 0) continue;
    signalfd_siginfo signal{};
    if (both[0].revents != 0) hasCome_ = read(descriptor_, &signal, sizeof signal) == sizeof signal;
  }
  return !hasCome_;
}

}  // namespace grove::cli
