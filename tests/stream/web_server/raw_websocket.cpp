#include "stream/web_server/raw_websocket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

namespace grove::stream {

RawSocket::RawSocket(int port, int receiveBufferBytes, const char* source)
    : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const timeval patience{5, 0};
  setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  setsockopt(fd_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  if (receiveBufferBytes > 0) {
    setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receiveBufferBytes, sizeof receiveBufferBytes);
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  inet_pton(AF_INET, source, &address.sin_addr);
  if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(fd_);
    throw std::runtime_error(std::string("cannot come from ") + source);
  }
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(fd_);
    throw std::runtime_error("cannot connect to port " + std::to_string(port));
  }
}

RawSocket::~RawSocket() {
  if (fd_ >= 0) ::close(fd_);
}

bool RawSocket::startTls(std::string_view offer, int newestVersion) {
  SSL_CTX* const context = SSL_CTX_new(TLS_client_method());
  // Old versions have old signatures, which the machine's own rules might not let us offer.
  SSL_CTX_set_security_level(context, 0);
  SSL_CTX_set_min_proto_version(context, TLS1_VERSION);
  SSL_CTX_set_max_proto_version(context, newestVersion);
  tls_.reset(SSL_new(context));
  SSL_CTX_free(context);
  SSL_set_fd(tls_.get(), fd_);
  if (!offer.empty()) {
    SSL_set_alpn_protos(tls_.get(), reinterpret_cast<const unsigned char*>(offer.data()),
                        static_cast<unsigned>(offer.size()));
  }
  return SSL_connect(tls_.get()) == 1;
}

std::string RawSocket::certificateName() const {
  X509* const certificate = SSL_get0_peer_certificate(tls_.get());
  std::array<char, 256> name{};
  if (certificate != nullptr) {
    X509_NAME_get_text_by_NID(X509_get_subject_name(certificate), NID_commonName, name.data(), name.size());
  }
  return name.data();
}

bool RawSocket::send(std::string_view bytes) {
  if (tls_) {
    return bytes.empty() || SSL_write(tls_.get(), bytes.data(), static_cast<int>(bytes.size())) > 0;
  }
  while (!bytes.empty()) {
    const ssize_t sent = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

std::string RawSocket::receive() {
  std::string bytes(65536, '\0');
  const ssize_t received = tls_ ? SSL_read(tls_.get(), bytes.data(), static_cast<int>(bytes.size()))
                                : ::recv(fd_, bytes.data(), bytes.size(), 0);
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(0, received)));
  return bytes;
}

std::string RawSocket::receiveAll() {
  std::string all;
  for (std::string bytes = receive(); !bytes.empty(); bytes = receive()) all += bytes;
  return all;
}

void RawSocket::reset() {
  const linger now{1, 0};
  setsockopt(fd_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
  ::close(fd_);
  fd_ = -1;
}

HttpAnswer request(int port, const std::string& method, const std::string& path, const std::string& headers) {
  RawSocket socket(port);
  return request(socket, method, path, "Host: localhost\r\n" + headers);
}

HttpAnswer request(RawSocket& socket, const std::string& method, const std::string& path, const std::string& headers) {
  std::string text = method;
  text.append(" ").append(path).append(" HTTP/1.1\r\nConnection: close\r\n").append(headers);
  socket.send(text.append("\r\n"));
  const std::string answer = socket.receiveAll();
  HttpAnswer result;
  const std::size_t end = std::min(answer.find("\r\n\r\n"), answer.size());
  result.head = answer.substr(0, end);
  std::ranges::transform(result.head, result.head.begin(), [](unsigned char c) { return std::tolower(c); });
  if (end < answer.size()) result.body = answer.substr(end + 4);
  if (answer.size() > 12) result.status = std::stoi(answer.substr(9, 3));
  return result;
}

RawWebsocket::RawWebsocket(int port, const std::string& headers, int receiveBufferBytes, const char* source)
    : RawWebsocket(RawSocket(port, receiveBufferBytes, source), "127.0.0.1:" + std::to_string(port), headers) {}

RawWebsocket::RawWebsocket(RawSocket socket, const std::string& host, const std::string& headers)
    : socket_(std::move(socket)) {
  std::string hello = "GET / HTTP/1.1\r\nHost: ";
  hello.append(host).append("\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n");
  hello.append("Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n");
  if (headers.find("Sec-WebSocket-Protocol") == std::string::npos) hello.append("Sec-WebSocket-Protocol: grove.v1\r\n");
  hello.append(headers).append("\r\n");
  socket_.send(hello);
  std::size_t end = std::string::npos;
  while (end == std::string::npos) {
    const std::string bytes = socket_.receive();
    if (bytes.empty()) break;
    received_ += bytes;
    end = received_.find("\r\n\r\n");
  }
  if (received_.size() > 12) status_ = std::stoi(received_.substr(9, 3));
  received_.erase(0, end == std::string::npos ? received_.size() : end + 4);
}

bool RawWebsocket::send(std::span<const std::uint8_t> bytes, Opcode opcode, bool final) {
  return socket_.send(frame(bytes, opcode, final));
}

std::string RawWebsocket::frame(std::span<const std::uint8_t> bytes, Opcode opcode, bool final) {
  std::string frame;
  frame += static_cast<char>(opcode | (final ? 0x80 : 0));
  if (bytes.size() < 126) {
    frame += static_cast<char>(0x80 | bytes.size());
  } else {
    frame += static_cast<char>(0x80 | 126);
    frame += static_cast<char>(bytes.size() >> 8U);
    frame += static_cast<char>(bytes.size() & 0xFFU);
  }
  constexpr std::array<std::uint8_t, 4> kMask = {0x12, 0x34, 0x56, 0x78};
  for (const std::uint8_t byte : kMask) frame += static_cast<char>(byte);
  for (std::size_t i = 0; i < bytes.size(); ++i) frame += static_cast<char>(bytes[i] ^ kMask[i % 4]);
  return frame;
}

bool RawWebsocket::fill(std::size_t bytes) {
  while (received_.size() < bytes) {
    const std::string more = socket_.receive();
    if (more.empty()) return false;
    received_ += more;
  }
  return true;
}

std::optional<RawWebsocket::Message> RawWebsocket::receive() {
  const auto at = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(received_[i])}; };
  if (!fill(2)) return std::nullopt;
  std::size_t length = at(1) & 0x7FU;
  std::size_t head = 2;
  if (length >= 126) {
    const std::size_t digits = length == 126 ? 2 : 8;
    if (!fill(head + digits)) return std::nullopt;
    length = 0;
    for (std::size_t i = 0; i < digits; ++i) length = (length << 8U) | at(head + i);
    head += digits;
  }
  if (!fill(head + length)) return std::nullopt;
  Message message{static_cast<std::uint8_t>(at(0) & 0x0FU), {}};
  message.bytes.assign(received_.begin() + static_cast<std::ptrdiff_t>(head),
                       received_.begin() + static_cast<std::ptrdiff_t>(head + length));
  received_.erase(0, head + length);
  return message;
}

std::optional<RawWebsocket::Close> RawWebsocket::receiveClose() {
  while (const auto message = receive()) {
    if (message->opcode != kClose) continue;
    send(message->bytes, kClose);
    if (message->bytes.size() < 2) return std::nullopt;
    return Close{message->bytes[0] * 256 + message->bytes[1], {message->bytes.begin() + 2, message->bytes.end()}};
  }
  return std::nullopt;
}

}  // namespace grove::stream
