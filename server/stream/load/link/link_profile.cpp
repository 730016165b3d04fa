#include "stream/load/link/link_profile.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>

namespace grove::stream {
namespace {

struct Unit {
  std::string_view name;
  double scale;
};
constexpr std::array<Unit, 3> kRateUnits = {{{"kbit", 1e3}, {"mbit", 1e6}, {"gbit", 1e9}}};
constexpr std::array<Unit, 2> kTimeUnits = {{{"ms", 1e6}, {"s", 1e9}}};
constexpr double kMinRate = 1e3;
constexpr double kMaxRate = 1e10;
constexpr LinkTime kMaxDelay = std::chrono::seconds(10);
constexpr LinkTime kMaxWhen = std::chrono::hours(1);
constexpr LinkTime kMinPeriod = std::chrono::milliseconds(10);
constexpr std::array<Unit, 1> kPercent = {{{"", 0.01}}};
constexpr double kMaxLoss = 0.2;
constexpr std::size_t kMaxSteps = 1000;

/// Parses a number with a unit; nothing if the text is something else.
std::optional<double> quantity(std::string_view text, std::span<const Unit> units) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
  const std::string_view rest = text.substr(static_cast<std::size_t>(end - text.data()));
  for (const Unit& unit : units) {
    if (unit.name == rest) return number * unit.scale;
  }
  return std::nullopt;
}

/// Removes and returns the text before the separator, and removes the separator. Without a separator returns all, and
/// `text` becomes null.
std::string_view takeUntil(std::string_view& text, char separator) {
  const std::size_t at = text.find(separator);
  const std::string_view part = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view{} : text.substr(at + 1);
  return part;
}

/// Reads part after part. Keeps the first error; parts read after it are meaningless.
class ProfileReader {
 public:
  ParsedLinkProfile read(std::string_view text) {
    const std::string_view rate = takeUntil(text, ',');
    profile_.downstream = steps(rate);
    profile_.roundTrip = time(takeUntil(text, ','), "the round-trip time", LinkTime{0}, kMaxDelay);
    while (text.data() != nullptr) readOption(takeUntil(text, ','));
    if (profile_.upstream.empty()) profile_.upstream = profile_.downstream;
    if (!fault_.empty()) return fault_;
    return profile_;
  }

 private:
  void readOption(std::string_view text) {
    const std::string_view all = text;
    const std::string_view name = takeUntil(text, '=');
    if (name == "up") {
      profile_.upstream = steps(text);
    } else if (name == "jitter") {
      profile_.jitter = time(text, "the jitter", LinkTime{0}, kMaxDelay);
    } else if (name == "stall") {
      profile_.stall = time(takeUntil(text, '/'), "a stall", LinkTime{1}, kMaxDelay);
      profile_.stallEvery = time(text, "the time between stalls", kMinPeriod, kMaxWhen);
      if (profile_.stall >= profile_.stallEvery) fail("a stall must end before the next one", all);
    } else if (name == "loss") {
      const auto share = quantity(text, kPercent);
      if (!share || *share < 0.0 || *share > kMaxLoss) fail("a loss is 0 to 20 percent, as in loss=0.5, unlike", all);
      profile_.loss = share.value_or(0.0);
    } else if (name == "seed") {
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), profile_.seed);
      if (error != std::errc{} || end != text.data() + text.size()) fail("a seed is a whole number", text);
    } else {
      fail("the options after the round-trip time are up, jitter, stall, loss and seed, not", all);
    }
  }

  std::vector<RateStep> steps(std::string_view text) {
    std::vector<RateStep> result;
    do {
      const std::string_view all = takeUntil(text, '/');
      std::string_view step = all;
      const double rate = this->rate(takeUntil(step, '@'));
      const LinkTime from =
          step.data() == nullptr ? LinkTime{0} : time(step, "the time of a rate", LinkTime{0}, kMaxWhen);
      if (result.empty() ? from.count() != 0 : from <= result.back().from) {
        fail("rates begin at 0s and are sorted by time, unlike", all);
      }
      if (result.size() == kMaxSteps) fail("more than 1000 rates:", all);
      result.push_back({from, rate});
    } while (text.data() != nullptr && fault_.empty());
    return result;
  }

  double rate(std::string_view text) {
    const auto value = quantity(text, kRateUnits);
    if (!value) {
      fail("a rate is like 500kbit, 5mbit or 1gbit, unlike", text);
    } else if (*value < kMinRate || *value > kMaxRate) {
      fail("a rate is 1kbit to 10gbit, unlike", text);
    }
    return value.value_or(kMinRate);
  }

  LinkTime time(std::string_view text, const std::string& what, LinkTime low, LinkTime high) {
    const auto value = quantity(text, kTimeUnits);
    if (!value) {
      fail(what + " is like 80ms or 1.5s, unlike", text);
    } else if (*value < static_cast<double>(low.count()) || *value > static_cast<double>(high.count())) {
      fail(what + " is out of range:", text);
    } else {
      return LinkTime{std::llround(*value)};
    }
    return low;
  }

  void fail(const std::string& reason, std::string_view text) {
    if (!fault_.empty()) return;
    fault_.append(reason).append(" '").append(text).append("'");
  }

  LinkProfile profile_;
  std::string fault_;
};

}  // namespace

ParsedLinkProfile parseLinkProfile(std::string_view text) { return ProfileReader().read(text); }

}  // namespace grove::stream
