#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace grove::stream {

/// What one address may take.
struct AddressAllowance {
  int sockets = 48;             ///< at once; a browser that opens the page takes up to seven
  int visitors = 8;             ///< in the world at once
  double socketsPerSecond = 8;  ///< on average
  double burst = 64;            ///< so many new sockets at once, after a while without
};

/// Keeps who has one address from taking what there is for all: counts sockets, new sockets a second, and visitors, by
/// address. Of IPv6 addresses the first 64 bits count, for whoever has one has all others of these. 127.0.0.1 and
/// ::1 are not limited: a proxy on this machine that all visitors come through has one of these. One thread.
class AddressLimits {
 public:
  /// What somebody took; it is given back when the last copy goes.
  using Ticket = std::shared_ptr<void>;

  explicit AddressLimits(const AddressAllowance& allowance) : allowance_(allowance) {}

  /// What a request costs that a proxy passes on, who opens sockets as he likes, of what a new socket does.
  static constexpr double kRequest = 0.125;

  /// Whether one more socket of this numeric address is welcome. Counts it as tried, so that who goes on trying does
  /// not get in sooner. `now` in seconds, which do not go back; `cost` in new sockets.
  [[nodiscard]] bool welcomes(const std::string& address, double now, double cost = 1.0);
  /// A socket that was welcome is there.
  [[nodiscard]] Ticket socket(const std::string& address);
  /// A visitor's place; null if this address has as many as it may.
  [[nodiscard]] Ticket visitor(const std::string& address);
  /// Forgets addresses that have nothing and have been quiet.
  void sweep(double now);

 private:
  struct Guest {
    int sockets = 0;
    int visitors = 0;
    double burst = 0.0;  ///< what is left of it
    double since = 0.0;
  };
  std::shared_ptr<Guest> guest(const std::string& address);
  void refill(Guest& guest, double now) const;

  const AddressAllowance allowance_;
  std::map<std::string, std::shared_ptr<Guest>> guests_;
};

/// The part of a numeric address that stands for one guest: all of IPv4, 64 bits of IPv6; empty for 127.0.0.1 and ::1.
[[nodiscard]] std::string guestOf(const std::string& address);

}  // namespace grove::stream
