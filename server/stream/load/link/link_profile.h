#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace grove::stream {

/// Time since the connection began, or a duration.
using LinkTime = std::chrono::nanoseconds;

/// A rate that holds from a time on.
struct RateStep {
  LinkTime from{0};
  double bitsPerSecond = 0.0;
};

/// Properties of an internet connection that a LinkShaper imitates.
struct LinkProfile {
  std::vector<RateStep> downstream;  ///< to the client; at least one, the first at 0, sorted by time
  std::vector<RateStep> upstream;    ///< to the server, likewise
  LinkTime roundTrip{0};             ///< of the idle link; half in each direction
  LinkTime jitter{0};                ///< maximum additional delay per direction, redrawn every 10 ms; never reorders
  LinkTime stall{0};                 ///< at the end of each stallEvery, nothing leaves for this long
  LinkTime stallEvery{0};            ///< period of the stalls; 0: none
  double loss = 0.0;                 ///< share of TCP's segments that are lost in each direction, 0 to 0.2
  std::uint64_t seed = 1;            ///< of the jitter and the losses
};

/// The profile, or a short error.
using ParsedLinkProfile = std::variant<LinkProfile, std::string>;

/// Parses `RATE,RTT[,up=RATE][,jitter=TIME][,stall=TIME/TIME][,loss=PERCENT][,seed=N]`, as in
/// `5mbit,80ms,stall=1s/10s`. A rate is a number and `kbit`, `mbit` or `gbit`, 1 kbit to 10 gbit; it may change over
/// time: `5mbit@0s/500kbit@10s`. A time is a number and `ms` or `s`, at most 10 s, or at most an hour for the time of a
/// rate and the period of stalls. The upstream rate defaults to the downstream rate. A loss is a number from 0 to 20,
/// in percent.
[[nodiscard]] ParsedLinkProfile parseLinkProfile(std::string_view text);

}  // namespace grove::stream
