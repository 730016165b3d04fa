#include "stream/load/link/link_shaper.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/timerfd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <exception>
#include <system_error>
#include <tuple>

#include "base/error.h"
#include "base/log.h"

namespace grove::stream {
namespace {

// The tag of an event is twice the connection's id, plus one for the server's side. These tags belong to no connection.
constexpr std::uint64_t kListenerId = 0;
constexpr std::uint64_t kStopTag = 2;
constexpr std::uint64_t kTimerTag = 3;
constexpr std::uint64_t kFirstId = 2;
constexpr std::size_t kMaxConnections = 4096;
constexpr std::size_t kBufferBytes = std::size_t{64} << 10U;
constexpr LinkTime kAcceptAgain = std::chrono::milliseconds(100);

double maxRate(const LinkProfile& profile) {
  double rate = 0.0;
  for (const auto* steps : {&profile.downstream, &profile.upstream}) {
    for (const RateStep& step : *steps) rate = std::max(rate, step.bitsPerSecond);
  }
  return rate;
}

Descriptor checked(int descriptor) {
  if (descriptor < 0) throw EnvironmentError("cannot be opened: too many open files", "shaped link", "raise ulimit -n");
  return Descriptor(descriptor);
}

SocketAddress freeAddress(const LinkShaper::Place& place) {
  std::ignore = findListenAddress(place.address.host, place.address.port, place.option);
  return resolve(place.address, place.option);
}

}  // namespace

LinkShaper::LinkShaper(const Place& listen, const Place& target, LinkProfile profile)
    : profile_(std::move(profile)),
      bufferBytes_(socketBufferBytes(maxRate(profile_))),
      target_(resolve(target.address, target.option)),
      listener_(listenAt(freeAddress(listen), bufferBytes_)),
      epoll_(checked(epoll_create1(EPOLL_CLOEXEC))),
      timer_(checked(timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK))),
      stop_(checked(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK))),
      nextId_(kFirstId),
      buffer_(kBufferBytes) {
  watch(listener_.get(), 2 * kListenerId, EPOLLIN | EPOLLET);
  watch(stop_.get(), kStopTag, EPOLLIN);
  watch(timer_.get(), kTimerTag, EPOLLIN | EPOLLET);
  thread_ = std::thread([this] { run(); });
}

LinkShaper::~LinkShaper() {
  std::ignore = eventfd_write(stop_.get(), 1);
  thread_.join();
}

void LinkShaper::run() noexcept {
  try {
    std::vector<Id> ids;
    while (!stopped_) {
      waitFor(ids);
      const LinkTime time = now();
      for (const Id id : ids) {
        if (id == kListenerId) {
          acceptAll(time);
        } else {
          serve(id, time);
        }
      }
    }
  } catch (const std::exception& e) {
    log::error(std::string("shaped link: ") + e.what());
  }
}

void LinkShaper::waitFor(std::vector<Id>& ids) {
  setTimer();
  std::array<epoll_event, 64> events{};
  const int count = epoll_wait(epoll_.get(), events.data(), events.size(), -1);
  ids.clear();
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = events[static_cast<std::size_t>(i)];
    const std::uint64_t tag = event.data.u64;
    if (tag == kStopTag) {
      stopped_ = true;
    } else if (tag == 2 * kListenerId) {
      mayAccept_ = true;
      ids.push_back(kListenerId);
    } else if (const auto line = lines_.find(tag / 2); tag != kTimerTag && line != lines_.end()) {
      // Reading and writing detect a broken connection.
      const bool broke = (event.events & (EPOLLERR | EPOLLHUP)) != 0;
      line->second.connection.wake(static_cast<ShapedConnection::Side>(tag % 2),
                                   broke || (event.events & (EPOLLIN | EPOLLRDHUP)) != 0,
                                   broke || (event.events & EPOLLOUT) != 0);
      ids.push_back(tag / 2);
    }
  }
  const LinkTime time = now();
  for (const auto& [due, id] : times_) {
    if (due > time) break;
    ids.push_back(id);
  }
}

void LinkShaper::acceptAll(LinkTime time) {
  std::erase_if(times_, [](const auto& entry) { return entry.second == kListenerId; });
  for (;;) {
    Descriptor client = acceptFrom(listener_);
    if (!client) {
      // Most likely out of descriptors; edge-triggered epoll does not report waiting connections again.
      const bool none = errno == EAGAIN || errno == EWOULDBLOCK;
      if (!none) times_.emplace(errno == ECONNABORTED || errno == EINTR ? time : time + kAcceptAgain, kListenerId);
      return;
    }
    Descriptor server = lines_.size() < kMaxConnections ? connectTo(target_, bufferBytes_) : Descriptor();
    if (!server) continue;
    const Id id = nextId_++;
    const auto [line, added] = lines_.try_emplace(
        id, Line{{std::move(client), std::move(server), profile_, profile_.seed + id}, time, std::nullopt});
    using Side = ShapedConnection::Side;
    for (const Side side : {Side::kClient, Side::kServer}) {
      watch(line->second.connection.socket(side), 2 * id + static_cast<std::uint64_t>(side),
            EPOLLIN | EPOLLOUT | EPOLLRDHUP | EPOLLET);
    }
  }
}

void LinkShaper::serve(Id id, LinkTime time) {
  const auto found = lines_.find(id);
  if (found == lines_.end()) return;  // was listed twice, and has ended
  Line& line = found->second;
  if (line.next) times_.erase({*line.next, id});
  line.next = line.connection.serve(time - line.began, buffer_);
  if (line.next) *line.next += line.began;
  if (line.connection.isOver()) {
    lines_.erase(found);
  } else if (line.next) {
    times_.emplace(*line.next, id);
  }
}

void LinkShaper::setTimer() const {
  constexpr LinkTime::rep kSecond = 1'000'000'000;
  itimerspec when{};  // all zero: off
  if (!times_.empty()) {
    const LinkTime::rep due = std::max<LinkTime::rep>(times_.begin()->first.count(), 1);
    when.it_value = {due / kSecond, due % kSecond};
  }
  timerfd_settime(timer_.get(), TFD_TIMER_ABSTIME, &when, nullptr);
}

void LinkShaper::watch(int descriptor, std::uint64_t tag, std::uint32_t events) const {
  epoll_event event{};
  event.events = events;
  event.data.u64 = tag;
  if (epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, descriptor, &event) != 0) {
    throw EnvironmentError(std::generic_category().message(errno), "shaped link", "");
  }
}

LinkTime LinkShaper::now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);  // the timer's
  return std::chrono::seconds(time.tv_sec) + LinkTime{time.tv_nsec};
}

}  // namespace grove::stream
