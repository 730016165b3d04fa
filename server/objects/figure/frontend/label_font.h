#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace grove::objects::figure {

/// A line of text as coverage, rows from the top.
struct LabelMask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> coverage;
};

/// The font that is compiled in (DejaVu Sans, Bitstream Vera licence), drawn by stb_truetype. Any thread.
class LabelFont {
 public:
  LabelFont();
  ~LabelFont();
  LabelFont(LabelFont&&) noexcept;
  LabelFont& operator=(LabelFont&&) noexcept;

  /// Draws UTF-8 text; what is not UTF-8 becomes U+FFFD, and at most `kMaxCharacters` are drawn.
  [[nodiscard]] LabelMask draw(std::string_view text, int pixels) const;

  static constexpr int kMaxCharacters = 32;

 private:
  struct Face;
  std::unique_ptr<const Face> face_;
};

}  // namespace grove::objects::figure
