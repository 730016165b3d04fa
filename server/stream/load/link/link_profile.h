#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace grove::stream {

/// Times of a link, since the connection began.
using LinkTime = std::chrono::nanoseconds;

/// So much a link carries from a time on.
struct RateStep {
  LinkTime from{0};
  double bitsPerSecond = 0.0;
};

/// What a line over the internet is like: what a connection through a LinkShaper gets.
struct LinkProfile {
  std::vector<RateStep> downstream;  ///< to who connected; one at least, the first at 0, in the order of time
  std::vector<RateStep> upstream;    ///< the other way, likewise
  LinkTime roundTrip{0};             ///< of the idle link; half of it each way
  LinkTime jitter{0};                ///< each way: up to so much more delay, drawn anew every 10 ms; never reorders
  LinkTime stall{0};                 ///< so long nothing leaves at the end of each ...
  LinkTime stallEvery{0};            ///< ... of such times; 0: never
  std::uint64_t seed = 1;            ///< of the jitter
};

/// The profile, or in a few words why the text is none.
using ParsedLinkProfile = std::variant<LinkProfile, std::string>;

/// Reads `RATE,RTT[,up=RATE][,jitter=TIME][,stall=TIME/TIME][,seed=N]`, as in `5mbit,80ms,stall=1s/10s`. A rate is a
/// number and `kbit`, `mbit` or `gbit`, 1 kbit to 10 gbit; it may change: `5mbit@0s/500kbit@10s`. A time is a number
/// and `ms` or `s`, 10 s at most, an hour where it says when or how often. Upstream gets the rate of downstream if not
/// told otherwise.
[[nodiscard]] ParsedLinkProfile parseLinkProfile(std::string_view text);

}  // namespace grove::stream
