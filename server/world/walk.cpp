#include "world/walk.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/plain_file.h"
#include "world/players.h"

namespace grove::world {
namespace {

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{16} << 20U;
constexpr double kMaxSeconds = 86'400.0;
constexpr double kMaxWalkMetres = 1e5;
constexpr double kMaxYaw = 1e4;
constexpr float kFullTurn = 6.2831853F;

/// Reads line by line; throws WalkError at the first invalid one.
class WalkReader {
 public:
  explicit WalkReader(const std::string& fileName) : fileName_(fileName) {}

  std::vector<Walk::Step> read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      readLine(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (steps_.empty()) fail("no step: a line is 'seconds x z yaw pitch'");
    return std::move(steps_);
  }

 private:
  void readLine(std::string_view line) {
    const std::vector<double> numbers = numbersOf(line.substr(0, line.find('#')));
    if (numbers.empty()) return;
    if (numbers.size() != 5 && numbers.size() != 6) {
      fail(std::to_string(numbers.size()) + " numbers: a line is 'seconds x z yaw pitch' or 'seconds x y z yaw pitch'");
    }
    const bool hasHeight = numbers.size() == 6;
    const std::size_t z = hasHeight ? 3 : 2;
    Walk::Step step;
    step.seconds = within(numbers[0], 0.0, kMaxSeconds, "seconds");
    if (!steps_.empty() && step.seconds <= steps_.back().seconds) fail("a time not later than the previous one");
    step.pose.position.x = metres(numbers[1], "x");
    step.pose.position.y = hasHeight ? metres(numbers[2], "y") : kEyeHeight;
    step.pose.position.z = metres(numbers[z], "z");
    step.pose.yaw = static_cast<float>(within(numbers[z + 1], -kMaxYaw, kMaxYaw, "yaw"));
    step.pose.pitch = static_cast<float>(within(numbers[z + 2], -kMaxPitch, kMaxPitch, "pitch"));
    steps_.push_back(step);
  }

  [[nodiscard]] std::vector<double> numbersOf(std::string_view line) const {
    constexpr std::string_view kBlanks = " \t\r";
    std::vector<double> numbers;
    for (;;) {
      const std::size_t begin = line.find_first_not_of(kBlanks);
      if (begin == std::string_view::npos) return numbers;
      line.remove_prefix(begin);
      const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
      double number = 0.0;
      const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (error != std::errc{} || last != word.data() + word.size() || !std::isfinite(number)) fail("not a number");
      numbers.push_back(number);
      line.remove_prefix(word.size());
    }
  }

  [[nodiscard]] double within(double value, double low, double high, const std::string& what) const {
    if (value < low || value > high) fail(what + " out of range");
    return value;
  }
  [[nodiscard]] float metres(double value, const std::string& what) const {
    return static_cast<float>(within(value, -kMaxWalkMetres, kMaxWalkMetres, what));
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw WalkError(fileName_ + ":" + std::to_string(std::max(line_, 1)) + ": " + reason);
  }

  const std::string& fileName_;
  int line_ = 0;
  std::vector<Walk::Step> steps_;
};

}  // namespace

Walk::Walk(std::vector<Step> steps) : steps_(std::move(steps)) {
  assert(!steps_.empty() && steps_.front().seconds >= 0.0);
}

Pose Walk::at(double seconds) const {
  const auto after = std::ranges::upper_bound(steps_, seconds, {}, &Step::seconds);
  if (after == steps_.begin()) return steps_.front().pose;
  if (after == steps_.end()) return steps_.back().pose;
  const Step& before = *std::prev(after);
  const auto share = static_cast<float>((seconds - before.seconds) / (after->seconds - before.seconds));
  Pose pose = before.pose;
  pose.position += (after->pose.position - pose.position) * share;
  pose.yaw += std::remainder(after->pose.yaw - pose.yaw, kFullTurn) * share;
  pose.pitch += (after->pose.pitch - pose.pitch) * share;
  return pose;
}

Pose Walk::thereAndBack(double seconds) const {
  const double length = this->seconds();
  if (length <= 0.0) return at(0.0);
  return at(length - std::abs(std::fmod(std::abs(seconds), 2.0 * length) - length));
}

Pose onGround(Pose pose, std::span<const Hill> hills) noexcept {
  pose.position.y += groundHeight(hills, {pose.position.x, pose.position.z});
  return pose;
}

Walk loadWalk(const std::filesystem::path& file) {
  return parseWalk(PlainFile(file, "a walk is a text file", kMaxFileBytes).readAll(), file.string());
}

Walk parseWalk(std::string_view text, const std::string& fileName) { return Walk(WalkReader(fileName).read(text)); }

}  // namespace grove::world
