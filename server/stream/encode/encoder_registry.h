#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "stream/encode/encoder.h"

namespace grove::stream {

/// A way to encode pictures, as a plug-in offers it.
struct EncoderKind {
  std::uint8_t codec = 0;                          ///< as in PROTOCOL.md; several kinds may make the same
  bool chained = false;                            ///< pictures depend on those before them, but for independent ones
  std::string name;                                ///< for options and reports, as in "h264"
  std::string library;                             ///< that does it, with its version
  std::function<std::unique_ptr<Encoder>()> make;  ///< throws EnvironmentError if the library cannot start
};

/// The kinds of encoders that a server has, the best first. Immutable once serving begins; any thread.
class EncoderRegistry {
 public:
  /// One that is added later is preferred to an earlier one of the same codec.
  void add(EncoderKind kind);

  /// The first codec of a page's offer that there is a kind for; JPEG, which every page can decode, if there is none.
  [[nodiscard]] const EncoderKind& choose(std::span<const std::uint8_t> offer) const;
  /// By its name; null if there is none.
  [[nodiscard]] const EncoderKind* find(const std::string& name) const;
  [[nodiscard]] std::span<const EncoderKind> kinds() const noexcept { return kinds_; }

 private:
  std::vector<EncoderKind> kinds_;
};

/// Those that this program is built with. `jpegQuality`, 1 to 100, is the best that JPEG is sent in.
[[nodiscard]] EncoderRegistry builtinEncoders(int jpegQuality);

}  // namespace grove::stream
