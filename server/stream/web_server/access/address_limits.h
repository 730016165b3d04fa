#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace grove::stream {

/// What one address may take of the server.
struct AddressAllowance {
  int sockets = 48;             ///< at once; a browser that opens the page takes up to seven
  int visitors = 8;             ///< in the world at once
  double socketsPerSecond = 8;  ///< on average
  double burst = 64;            ///< new sockets at once after a pause
};

/// Limits sockets, new sockets per second and visitors by address, so that one address cannot take what is there for
/// all. An IPv6 address counts by its first 64 bits, because its owner has all addresses of that prefix. 127.0.0.1 and
/// ::1 are not limited: they are the address of a local proxy, through which all visitors come. Not thread-safe.
class AddressLimits {
 public:
  /// A socket or a place; the last copy returns it.
  using Ticket = std::shared_ptr<void>;

  explicit AddressLimits(const AddressAllowance& allowance) : allowance_(allowance) {}

  /// Cost, in new sockets, of a request that a proxy forwards: the number of the proxy's sockets says nothing about its
  /// visitors.
  static constexpr double kRequest = 0.125;

  /// Returns whether this numeric address may open one more socket. Failed attempts count, too, so that repeating them
  /// does not help. `now`: monotonic seconds; `cost`: in new sockets.
  [[nodiscard]] bool allows(const std::string& address, double now, double cost = 1.0);
  /// Counts an open socket.
  [[nodiscard]] Ticket socket(const std::string& address);
  /// Takes a visitor's place; null if this address has all that it may.
  [[nodiscard]] Ticket visitor(const std::string& address);
  /// Removes addresses without sockets and visitors whose burst is full again.
  void sweep(double now);

 private:
  struct Guest {
    int sockets = 0;
    int visitors = 0;
    double burst = 0.0;  ///< new sockets still allowed at once
    double since = 0.0;
  };
  std::shared_ptr<Guest> guest(const std::string& address);
  void refill(Guest& guest, double now) const;

  const AddressAllowance allowance_;
  std::map<std::string, std::shared_ptr<Guest>> guests_;
};

/// Returns the part of a numeric address that the limits count by: all of IPv4, 64 bits of IPv6; empty for 127.0.0.1
/// and ::1.
[[nodiscard]] std::string guestOf(const std::string& address);

}  // namespace grove::stream
