#include "stream/web_server/access/address_limits.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace grove::stream {

std::string guestOf(const std::string& address) {
  in_addr four{};
  if (inet_pton(AF_INET, address.c_str(), &four) == 1) return address == "127.0.0.1" ? std::string() : address;
  in6_addr six{};
  // Link-local addresses have a zone, as in fe80::1%eth0.
  if (inet_pton(AF_INET6, address.substr(0, address.find('%')).c_str(), &six) != 1) return address;
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (IN6_IS_ADDR_LOOPBACK(&six)) return {};
  if (IN6_IS_ADDR_V4MAPPED(&six)) {
    inet_ntop(AF_INET, &six.s6_addr[12], text.data(), text.size());
    return guestOf(text.data());
  }
  std::memset(&six.s6_addr[8], 0, 8);
  inet_ntop(AF_INET6, &six, text.data(), text.size());
  return text.data();
}

bool AddressLimits::allows(const std::string& address, double now, double cost) {
  const auto guest = this->guest(address);
  if (!guest) return true;
  refill(*guest, now);
  const bool has = guest->burst >= cost;
  guest->burst = std::max(0.0, guest->burst - cost);
  return has && guest->sockets < allowance_.sockets;
}

AddressLimits::Ticket AddressLimits::socket(const std::string& address) {
  const auto guest = this->guest(address);
  if (!guest) return nullptr;
  ++guest->sockets;
  return {guest.get(), [guest](void*) { --guest->sockets; }};
}

AddressLimits::Ticket AddressLimits::visitor(const std::string& address) {
  const auto guest = this->guest(address);
  if (!guest) return std::make_shared<int>();
  if (guest->visitors >= allowance_.visitors) return nullptr;
  ++guest->visitors;
  return {guest.get(), [guest](void*) { --guest->visitors; }};
}

void AddressLimits::sweep(double now) {
  std::erase_if(guests_, [&](const auto& entry) {
    Guest& guest = *entry.second;
    refill(guest, now);
    return guest.sockets == 0 && guest.visitors == 0 && guest.burst >= allowance_.burst;
  });
}

std::shared_ptr<AddressLimits::Guest> AddressLimits::guest(const std::string& address) {
  const std::string name = guestOf(address);
  if (name.empty()) return nullptr;
  auto& guest = guests_[name];
  if (!guest) guest = std::make_shared<Guest>(Guest{.burst = allowance_.burst});
  return guest;
}

void AddressLimits::refill(Guest& guest, double now) const {
  guest.burst = std::min(allowance_.burst, guest.burst + (now - guest.since) * allowance_.socketsPerSecond);
  guest.since = now;
}

}  // namespace grove::stream
