#include "stream/web_server/listen_address.h"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <system_error>

#include "base/error.h"

namespace grove::stream {
namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

class Socket {
 public:
  explicit Socket(int family) : fd_(::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (fd_ >= 0) ::close(fd_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  [[nodiscard]] int get() const noexcept { return fd_; }

 private:
  const int fd_;
};

std::string mendFor(int code, const std::string& option) {
  const std::string with = " with " + option + " HOST:PORT";
  if (code == EADDRINUSE) return "stop the other program, or choose another port" + with;
  if (code == EACCES) return "choose a port above 1023" + with;
  return "choose an address of this machine" + with;
}

void tryToBind(const addrinfo& address, const std::string& where, const std::string& option) {
  const Socket socket(address.ai_family);
  const int on = 1;
  // As the server itself does: a port with only old connections in TIME_WAIT is free.
  const bool bound = socket.get() >= 0 && setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
                     ::bind(socket.get(), address.ai_addr, address.ai_addrlen) == 0;
  if (bound) return;
  const int code = errno;
  throw EnvironmentError("cannot listen: " + std::generic_category().message(code), where, mendFor(code, option));
}

}  // namespace

ListenAddress findListenAddress(const std::string& host, int port, const std::string& option) {
  const std::string where = host + ":" + std::to_string(port);
  if (port < 0 || port > 65535) throw EnvironmentError("there is no such port", where, "ports go from 0 to 65535");
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int failed = getaddrinfo(host.empty() ? nullptr : host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (failed != 0) throw EnvironmentError(gai_strerror(failed), where, mendFor(0, option));
  const Addresses addresses(found, &freeaddrinfo);
  tryToBind(*addresses, where, option);
  std::array<char, NI_MAXHOST> numeric{};
  getnameinfo(addresses->ai_addr, addresses->ai_addrlen, numeric.data(), numeric.size(), nullptr, 0, NI_NUMERICHOST);
  return {numeric.data(), addresses->ai_family == AF_INET6};
}

}  // namespace grove::stream
