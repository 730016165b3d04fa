#include "objects/figure/frontend/utf8.h"

#include <array>

namespace grove::objects::figure {

std::vector<std::uint32_t> decodeUtf8(std::string_view text) {
  constexpr std::uint32_t kReplacement = 0xFFFD;
  // The least value that a sequence of so many further bytes may carry.
  constexpr std::array<std::uint32_t, 4> kMin = {0, 0x80, 0x800, 0x10000};
  std::vector<std::uint32_t> points;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t more = lead < 0x80U ? 0 : lead >= 0xF0U ? 3 : lead >= 0xE0U ? 2 : 1;
    std::uint32_t point = more == 0 ? lead : lead & (0x3FU >> more);
    bool valid = lead < 0x80U || (lead >= 0xC2U && lead < 0xF5U);
    valid = valid && i + more < text.size();
    for (std::size_t k = 1; valid && k <= more; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      valid = (next & 0xC0U) == 0x80U;
      point = point << 6U | (next & 0x3FU);
    }
    valid = valid && point >= kMin[more] && point <= 0x10FFFFU && (point < 0xD800U || point > 0xDFFFU);
    points.push_back(valid ? point : kReplacement);
    i += valid ? more + 1 : 1;
  }
  return points;
}

}  // namespace grove::objects::figure
