#include "objects/figure/frontend/label_font.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/error.h"
#include "base/utf8.h"
#include "pipeline/embedded.h"

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

namespace grove::embedded {
std::span<const File> fonts();
}

namespace grove::objects::figure {

struct LabelFont::Face {
  stbtt_fontinfo info{};
};

LabelFont::LabelFont() {
  auto face = std::make_unique<Face>();
  const embedded::File& file = embedded::fonts().front();
  if (stbtt_InitFont(&face->info, file.bytes, stbtt_GetFontOffsetForIndex(file.bytes, 0)) == 0) {
    throw EnvironmentError("not a TrueType font", file.path, "build with fonts-dejavu-core installed");
  }
  face_ = std::move(face);
}

LabelFont::~LabelFont() = default;
LabelFont::LabelFont(LabelFont&&) noexcept = default;
LabelFont& LabelFont::operator=(LabelFont&&) noexcept = default;

LabelMask LabelFont::draw(std::string_view text, int pixels) const {
  const stbtt_fontinfo* font = &face_->info;
  const float scale = stbtt_ScaleForPixelHeight(font, static_cast<float>(pixels));
  int ascent = 0;
  int descent = 0;
  int gap = 0;
  stbtt_GetFontVMetrics(font, &ascent, &descent, &gap);
  std::vector<std::uint32_t> points = utf8::codePoints(text);
  points.resize(std::min(points.size(), std::size_t{kMaxCharacters}));

  std::vector<float> starts;
  float pen = 1.0F;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int glyph = static_cast<int>(points[i]);
    int advance = 0;
    int bearing = 0;
    stbtt_GetCodepointHMetrics(font, glyph, &advance, &bearing);
    starts.push_back(pen);
    const int kern =
        i + 1 < points.size() ? stbtt_GetCodepointKernAdvance(font, glyph, static_cast<int>(points[i + 1])) : 0;
    pen += static_cast<float>(advance + kern) * scale;
  }

  LabelMask mask;
  mask.width = static_cast<int>(std::ceil(pen)) + 1;
  mask.height = pixels + 2;
  mask.coverage.assign(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height), 0);
  const int baseline = 1 + static_cast<int>(std::lround(static_cast<float>(ascent) * scale));
  for (std::size_t i = 0; i < points.size(); ++i) {
    int width = 0;
    int height = 0;
    int left = 0;
    int top = 0;
    const float whole = std::floor(starts[i]);
    const std::unique_ptr<unsigned char, void (*)(unsigned char*)> glyph(
        stbtt_GetCodepointBitmapSubpixel(font, scale, scale, starts[i] - whole, 0.0F, static_cast<int>(points[i]),
                                         &width, &height, &left, &top),
        [](unsigned char* bitmap) { stbtt_FreeBitmap(bitmap, nullptr); });
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int column = static_cast<int>(whole) + left + x;
        const int row = baseline + top + y;
        if (column < 0 || row < 0 || column >= mask.width || row >= mask.height) continue;
        std::uint8_t& to = mask.coverage[static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width) +
                                         static_cast<std::size_t>(column)];
        to = std::max(to, static_cast<std::uint8_t>(glyph.get()[y * width + x]));
      }
    }
  }
  return mask;
}

}  // namespace grove::objects::figure
