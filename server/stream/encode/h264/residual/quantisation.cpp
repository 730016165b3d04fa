#include "stream/encode/h264/residual/quantisation.h"

#include <cmath>
#include <utility>

namespace grove::stream::h264 {
namespace {

/// By quantiser modulo 6: for both frequencies even, both odd, and one of each (section 8.5.9).
constexpr std::array<std::array<int, 3>, 6> kScales{
    {{10, 16, 13}, {11, 18, 14}, {13, 20, 16}, {14, 23, 18}, {16, 25, 20}, {18, 29, 23}}};
/// The square of the forward transform's gain, times 2^15, divided by the scale.
constexpr std::array<std::array<int, 3>, 6> kFactors{{{13107, 5243, 8066},
                                                      {11916, 4660, 7490},
                                                      {10082, 4194, 6554},
                                                      {9362, 3647, 5825},
                                                      {8192, 3355, 5243},
                                                      {7282, 2893, 4559}}};
/// Inter and intra.
constexpr std::array<double, 2> kRounding{1.0 / 6.0, 1.0 / 3.0};

template <std::size_t... kIndices>
auto allQuantisations(std::index_sequence<kIndices...> /*indices*/) {
  return std::array<std::array<Quantisation, 2>, sizeof...(kIndices)>{
      {{{Quantisation(kIndices, kRounding[0]), Quantisation(kIndices, kRounding[1])}}...}};
}

}  // namespace

Quantisation::Quantisation(int quantiser, double rounding) {
  const auto remainder = static_cast<std::size_t>(quantiser % 6);
  const int octaves = quantiser / 6;
  for (std::size_t place = 0; place < 16; ++place) {
    const std::size_t odd = place / 4 % 2 + place % 2;
    const std::size_t kind = odd == 0 ? 0 : odd == 2 ? 1 : 2;
    const int product = 2 * kFactors[remainder][kind] >> octaves;
    factor[place] = static_cast<std::uint16_t>(product);
    bias[place] = static_cast<std::uint16_t>(std::lround(rounding * 65536.0 / product));
    scale[place] = static_cast<std::int16_t>(kScales[remainder][kind] << octaves);
  }
}

Quantisations::Quantisations() : byQuantiser(allQuantisations(std::make_index_sequence<kMaxQuantiser + 1>())) {}

int chromaQuantiser(int quantiser) {
  constexpr int kFirst = 30;
  constexpr std::array<int, kMaxQuantiser - kFirst + 1> kCoarse{29, 30, 31, 32, 32, 33, 34, 34, 35, 35, 36,
                                                                36, 37, 37, 37, 38, 38, 38, 39, 39, 39, 39};
  return quantiser < kFirst ? quantiser : kCoarse[static_cast<std::size_t>(quantiser - kFirst)];
}

}  // namespace grove::stream::h264
