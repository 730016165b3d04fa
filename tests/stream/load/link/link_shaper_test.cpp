#include "stream/load/link/link_shaper.h"

#include <gmock/gmock.h>
#include <netinet/in.h>
#include <poll.h>

#include <cerrno>
#include <chrono>
#include <ctime>

#include "base/error.h"
#include "stream/load/link/counting_bytes.h"

namespace grove::stream {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Bytes = std::vector<std::uint8_t>;
using testing::HasSubstr;

constexpr auto kPatience = 20s;

bool waitFor(const Descriptor& socket, short events, std::chrono::milliseconds patience = kPatience) {
  pollfd entry{socket.get(), events, 0};
  return ::poll(&entry, 1, static_cast<int>(patience.count())) > 0;
}

Descriptor blocking(int family = AF_INET) { return Descriptor(::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0)); }

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

void sendAll(const Descriptor& socket, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    ASSERT_GT(count, 0);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

/// All until the end, or so many bytes; fewer if nothing comes for long.
Bytes receive(const Descriptor& socket, std::size_t max = SIZE_MAX) {
  Bytes all;
  Bytes part(65'536);
  while (all.size() < max && waitFor(socket, POLLIN)) {
    const ssize_t count = ::recv(socket.get(), part.data(), std::min(part.size(), max - all.size()), 0);
    if (count <= 0) break;
    all.insert(all.end(), part.begin(), part.begin() + count);
  }
  return all;
}

/// Whether the other side's end, or its breaking off, is what comes next.
bool ends(const Descriptor& socket) {
  std::uint8_t byte = 0;
  return waitFor(socket, POLLIN) && ::recv(socket.get(), &byte, 1, 0) <= 0;
}

double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// A server, and clients who reach it over a shaped link.
class LinkShaperTest : public testing::Test {
 protected:
  LinkShaperTest() : listener_(blocking()) {
    const sockaddr_in address = loopback(0);
    EXPECT_EQ(::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_.get(), 16), 0);
  }
  void shape(const char* profile) {
    shaper_.emplace(LinkShaper::Place{{"127.0.0.1", 0}, "--listen"},
                    LinkShaper::Place{{"127.0.0.1", portOf(listener_)}, "--to"},
                    std::get<LinkProfile>(parseLinkProfile(profile)));
  }
  [[nodiscard]] Descriptor connect() const {
    Descriptor socket = blocking();
    const sockaddr_in address = loopback(shaper_->port());
    EXPECT_EQ(::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    return socket;
  }
  /// Sends bytes to a client and from there at once, and compares what arrives.
  void expectToPass(const Bytes& down, const Bytes& up) const {
    const Descriptor client = connect();
    const Descriptor server = accept();
    std::thread sender([&] {
      sendAll(server, down);
      ::shutdown(server.get(), SHUT_WR);
    });
    std::thread upwards([&] { sendAll(client, up); });
    EXPECT_EQ(receive(client), down);
    EXPECT_EQ(receive(server, up.size()), up);
    sender.join();
    upwards.join();
  }
  [[nodiscard]] Descriptor accept() const {
    EXPECT_TRUE(waitFor(listener_, POLLIN));
    return Descriptor(::accept(listener_.get(), nullptr, nullptr));
  }

  Descriptor listener_;
  std::optional<LinkShaper> shaper_;
};

TEST_F(LinkShaperTest, PassesBytesInOrderBothWays) {
  shape("200mbit,10ms,jitter=5ms");
  expectToPass(counting(3'000'000), counting(500'000));
}

/// Fault: bytes that a loss removes, repeats or reorders, or an end that overtakes a repair.
TEST_F(LinkShaperTest, LossesChangeNoBytes) {
  shape("50mbit,10ms,loss=5,seed=3");
  expectToPass(counting(1'000'000), counting(200'000));
}

/// Only from below: a slow machine is later, but bits that come too soon are a fault of the link.
TEST_F(LinkShaperTest, IsNoFasterThanItsProfile) {
  shape("4mbit,100ms");
  const Descriptor client = connect();
  const Descriptor server = accept();
  auto begin = Clock::now();
  sendAll(client, Bytes{1});
  EXPECT_EQ(receive(server, 1).size(), 1U);
  EXPECT_GE(secondsSince(begin), 0.050);
  sendAll(server, Bytes{1});
  EXPECT_EQ(receive(client, 1).size(), 1U);
  EXPECT_GE(secondsSince(begin), 0.100);

  begin = Clock::now();
  std::thread sender([&] { sendAll(server, counting(500'000)); });
  EXPECT_EQ(receive(client, 500'000).size(), 500'000U);
  sender.join();
  EXPECT_GE(secondsSince(begin), 1.0 + 0.050 - 0.01);
}

TEST_F(LinkShaperTest, KeepsUpWithItsProfile) {
  shape("4mbit,0ms");
  const Descriptor client = connect();
  const Descriptor server = accept();
  const auto begin = Clock::now();
  std::thread sender([&] { sendAll(server, counting(500'000)); });
  EXPECT_EQ(receive(client, 500'000).size(), 500'000U);
  sender.join();
  EXPECT_LE(secondsSince(begin), 10.0) << "1 second, on a machine that is not busy";
}

TEST_F(LinkShaperTest, EachConnectionHasItsOwnLine) {
  shape("500kbit,0ms");
  std::vector<Descriptor> clients;
  std::vector<Descriptor> servers;
  for (int i = 0; i < 8; ++i) {
    clients.push_back(connect());
    servers.push_back(accept());
  }
  const auto begin = Clock::now();
  std::vector<std::thread> senders;
  senders.reserve(servers.size());
  for (const Descriptor& server : servers) senders.emplace_back([&] { sendAll(server, counting(125'000)); });
  for (const Descriptor& client : clients) EXPECT_EQ(receive(client, 125'000), counting(125'000));
  for (std::thread& sender : senders) sender.join();
  EXPECT_LE(secondsSince(begin), 15.5) << "two seconds each; over one line it would be 16";
}

TEST_F(LinkShaperTest, AppliesBackPressure) {
  shape("1mbit,20ms");
  const Descriptor client = connect();
  const Descriptor server = accept();
  const Bytes part(65'536);
  std::size_t sent = 0;
  const auto begin = Clock::now();
  while (secondsSince(begin) < 0.5) {
    const ssize_t count = ::send(server.get(), part.data(), part.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) sent += static_cast<std::size_t>(count);
    if (count < 0) std::this_thread::sleep_for(1ms);
  }
  // The rest is the sender's own kernel's, of which a Linux may take 4 MiB.
  EXPECT_LT(sent, std::size_t{5} << 20U);
  EXPECT_FALSE(waitFor(server, POLLOUT, 0ms));
}

TEST_F(LinkShaperTest, ClosesAfterPendingBytes) {
  shape("4mbit,60ms");
  {
    const Descriptor client = connect();
    Descriptor server = accept();
    sendAll(server, counting(60'000));
    server = Descriptor();
    EXPECT_EQ(receive(client), counting(60'000)) << "the end comes last";
  }
  {
    Descriptor client = connect();
    const Descriptor server = accept();
    sendAll(client, counting(60'000));
    client = Descriptor();
    EXPECT_EQ(receive(server), counting(60'000));
  }
  {
    const Descriptor client = connect();
    const Descriptor server = accept();
    ::shutdown(client.get(), SHUT_WR);
    EXPECT_TRUE(ends(server));
    sendAll(server, counting(1000));
    ::shutdown(server.get(), SHUT_WR);
    EXPECT_EQ(receive(client), counting(1000)) << "one way may end before the other";
  }
}

TEST_F(LinkShaperTest, ForwardsResets) {
  shape("4mbit,20ms");
  Descriptor client = connect();
  const Descriptor server = accept();
  const linger now{1, 0};
  setsockopt(client.get(), SOL_SOCKET, SO_LINGER, &now, sizeof now);
  client = Descriptor();
  EXPECT_TRUE(ends(server));
}

TEST_F(LinkShaperTest, ClosesWithoutListener) {
  listener_ = Descriptor();
  Descriptor gone = blocking();
  const sockaddr_in address = loopback(0);
  ASSERT_EQ(::bind(gone.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  std::swap(listener_, gone);  // bound, but it does not listen
  shape("4mbit,20ms");
  EXPECT_TRUE(ends(connect()));
  EXPECT_TRUE(ends(connect()));
}

TEST_F(LinkShaperTest, StopsWithOpenConnections) {
  shape("100kbit,1s");
  const Descriptor client = connect();
  const Descriptor server = accept();
  sendAll(client, counting(10'000));
  shaper_.reset();
  EXPECT_TRUE(ends(client));
}

/// Or a measurement would measure the shaper.
TEST_F(LinkShaperTest, SleepsWhenIdle) {
  shape("5mbit,50ms");
  const Descriptor client = connect();
  Descriptor server = accept();
  const Bytes part(65'536);
  // One connection whose receiver does not read, one that is closed by half, and one that is idle.
  while (::send(server.get(), part.data(), part.size(), MSG_NOSIGNAL | MSG_DONTWAIT) > 0) {
  }
  const Descriptor half = connect();
  const Descriptor halfServer = accept();
  ::shutdown(half.get(), SHUT_WR);
  EXPECT_TRUE(ends(halfServer));
  const Descriptor idle = connect();
  const Descriptor idleServer = accept();
  std::this_thread::sleep_for(500ms);
  const std::clock_t before = std::clock();
  std::this_thread::sleep_for(500ms);
  EXPECT_LT(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC, 0.25);
}

TEST_F(LinkShaperTest, ReportsABadAddress) {
  const LinkProfile profile = std::get<LinkProfile>(parseLinkProfile("4mbit,20ms"));
  const auto reason = [&](const HostPort& listen, const HostPort& target) -> std::string {
    try {
      const LinkShaper shaper({listen, "--listen"}, {target, "--to"}, profile);
      return "";
    } catch (const EnvironmentError& e) {
      return e.what();
    }
  };
  EXPECT_THAT(reason({"127.0.0.1", portOf(listener_)}, {"127.0.0.1", 1}), HasSubstr("--listen"));
  EXPECT_THAT(reason({"127.0.0.1", 0}, {"no.such.host.invalid", 1}), HasSubstr("--to"));
}

}  // namespace
}  // namespace grove::stream
