#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "stream/encode/encoder.h"

namespace grove::stream {

/// A kind of encoder, as a plug-in offers it.
struct EncoderKind {
  std::uint8_t codec = 0;                          ///< as in PROTOCOL.md; several kinds may share one
  bool chained = false;                            ///< pictures depend on earlier ones, except independent ones
  std::string name;                                ///< unique, for reports, for example "openh264"
  std::string library;                             ///< name and version of what encodes
  std::function<std::unique_ptr<Encoder>()> make;  ///< throws EnvironmentError if the library cannot start
};

/// The kinds of encoders of a server, the best first. Immutable after the start; then thread-safe.
class EncoderRegistry {
 public:
  /// Adds a kind, which is preferred to earlier ones of the same codec.
  void add(EncoderKind kind);

  /// Returns the kind of the first known codec of a page's offer; JPEG, which every page can decode, if none is known.
  [[nodiscard]] const EncoderKind& choose(std::span<const std::uint8_t> offer) const;
  [[nodiscard]] std::span<const EncoderKind> kinds() const noexcept { return kinds_; }

 private:
  std::vector<EncoderKind> kinds_;
};

/// Returns the built-in kinds. `jpegQuality`, 1 to 100, is the maximum quality of JPEG.
[[nodiscard]] EncoderRegistry builtinEncoders(int jpegQuality);

}  // namespace grove::stream
