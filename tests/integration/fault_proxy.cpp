#include "integration/fault_proxy.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace grove::integration {
namespace {

constexpr int kBacklog = 64;
constexpr std::size_t kPieceBytes = std::size_t{1} << 16U;
/// Who sends more than the delay holds is held back.
constexpr std::size_t kMaxPieces = 256;
/// Between two looks at what is due.
constexpr int kTickMilliseconds = 1;

sockaddr_in addressOf(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

stream::Descriptor newSocket() {
  stream::Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int yes = 1;
  setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  return socket;
}

stream::Descriptor listenAnywhere() {
  stream::Descriptor socket = newSocket();
  const sockaddr_in anywhere = addressOf(0);
  const bool listens = bind(socket.get(), reinterpret_cast<const sockaddr*>(&anywhere), sizeof anywhere) == 0 &&
                       listen(socket.get(), kBacklog) == 0;
  if (!listens) throw std::runtime_error("the proxy cannot listen");
  return socket;
}

/// Begins to connect; who is not there is found out by reading.
stream::Descriptor connectTo(int port) {
  stream::Descriptor socket = newSocket();
  const sockaddr_in there = addressOf(port);
  (void)connect(socket.get(), reinterpret_cast<const sockaddr*>(&there), sizeof there);
  return socket;
}

bool mayWork(ssize_t result) { return result > 0 || (result < 0 && (errno == EAGAIN || errno == EINTR)); }

/// Closed without a word: the other end gets a reset.
void reset(const stream::Descriptor& socket) {
  const linger none{1, 0};
  setsockopt(socket.get(), SOL_SOCKET, SO_LINGER, &none, sizeof none);
}

}  // namespace

FaultProxy::FaultProxy(int target) : target_(target), listener_(listenAnywhere()), thread_([this] { run(); }) {}

int FaultProxy::port() const {
  sockaddr_in here{};
  socklen_t length = sizeof here;
  getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&here), &length);
  return ntohs(here.sin_port);
}

FaultProxy::~FaultProxy() {
  stopping_ = true;
  thread_.join();
}

void FaultProxy::delay(std::chrono::milliseconds oneWay) {
  const std::lock_guard lock(mutex_);
  delay_ = oneWay;
}

void FaultProxy::cut() {
  const std::lock_guard lock(mutex_);
  for (const Connection& connection : connections_) {
    reset(connection.server);
    reset(connection.node);
  }
  connections_.clear();
}

void FaultProxy::setHalfOpen(bool isHalfOpen) {
  const std::lock_guard lock(mutex_);
  isHalfOpen_ = isHalfOpen;
}

void FaultProxy::setDeaf(bool isDeaf) {
  const std::lock_guard lock(mutex_);
  isDeaf_ = isDeaf;
}

void FaultProxy::corrupt(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  for (Connection& connection : connections_) connection.toServer.corrupted = bytes;
}

void FaultProxy::run() {
  while (!stopping_) {
    waitForBytes();
    const std::lock_guard lock(mutex_);
    accept();
    if (isHalfOpen_) continue;
    for (Connection& connection : connections_) serve(connection);
    std::erase_if(connections_, [](const Connection& connection) { return connection.isOver; });
  }
}

void FaultProxy::waitForBytes() {
  std::vector<pollfd> sockets{{listener_.get(), POLLIN, 0}};
  {
    // What nobody reads would end the wait at once.
    const std::lock_guard lock(mutex_);
    for (const Connection& connection : connections_) {
      if (!isHalfOpen_ && !isDeaf_) sockets.push_back({connection.server.get(), POLLIN, 0});
      if (!isHalfOpen_) sockets.push_back({connection.node.get(), POLLIN, 0});
    }
  }
  poll(sockets.data(), sockets.size(), kTickMilliseconds);
}

void FaultProxy::accept() {
  while (true) {
    stream::Descriptor server(accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!server) return;
    const int yes = 1;
    setsockopt(server.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    ++accepted_;
    connections_.push_back({std::move(server), connectTo(target_)});
  }
}

void FaultProxy::serve(Connection& connection) {
  const bool isHeard = isDeaf_ || read(connection.server, connection.toNode);
  const bool isOpen = isHeard && read(connection.node, connection.toServer);
  const bool isTaken = write(connection.node, connection.toNode) && write(connection.server, connection.toServer);
  connection.isOver = !isOpen || !isTaken;
}

bool FaultProxy::read(const stream::Descriptor& from, Way& way) {
  if (way.waiting.size() == kMaxPieces) return true;
  std::vector<char> bytes(kPieceBytes);
  const ssize_t count = recv(from.get(), bytes.data(), bytes.size(), 0);
  // It has not connected yet.
  if (count < 0 && errno == ENOTCONN) return true;
  if (count <= 0) return mayWork(count);
  bytes.resize(static_cast<std::size_t>(count));
  const std::size_t inverted = std::min(way.corrupted, bytes.size());
  for (std::size_t i = 0; i < inverted; ++i) bytes[i] = static_cast<char>(~bytes[i]);
  way.corrupted -= inverted;
  way.waiting.push_back({Clock::now() + delay_, std::move(bytes)});
  return true;
}

bool FaultProxy::write(const stream::Descriptor& to, Way& way) {
  while (!way.waiting.empty() && way.waiting.front().due <= Clock::now()) {
    Piece& piece = way.waiting.front();
    const ssize_t count =
        send(to.get(), piece.bytes.data() + piece.sent, piece.bytes.size() - piece.sent, MSG_NOSIGNAL);
    if (count <= 0) return mayWork(count);
    piece.sent += static_cast<std::size_t>(count);
    if (piece.sent == piece.bytes.size()) way.waiting.pop_front();
  }
  return true;
}

}  // namespace grove::integration
