#include "cli/version_report.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/simd/target.h"
#include "base/version.h"
#include "cli/bench/codec_names.h"
#include "gl/context.h"
#include "stream/encode/encoder_registry.h"
#include "stream/session/host.h"

namespace grove::cli {
namespace {

std::string simdTargets() {
  std::string others;
  for (const simd::Target target : simd::availableTargets()) {
    if (target != simd::currentTarget()) others += (others.empty() ? "" : ", ") + simd::nameOf(target);
  }
  const std::string used = simd::nameOf(simd::currentTarget());
  return others.empty() ? used : used + " (this processor also has " + others + ")";
}

std::string graphics() {
  try {
    const gl::Context context(gl::ContextKind::kAuto);
    return context.description() + ", by " + context.driver();
  } catch (const EnvironmentError& error) {
    return std::string("none: ") + error.what();
  }
}

std::string codecs() {
  std::vector<std::string> names;  // two kinds of encoders may share a library
  const stream::EncoderRegistry encoders = stream::builtinEncoders(stream::HostOptions{}.jpegQuality);
  for (const stream::EncoderKind& kind : encoders.kinds()) {
    std::string name = codecName(kind.codec) + " (" + kind.library + ")";
    if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  }
  std::string text;
  for (const std::string& name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

}  // namespace

std::string versionReport() {
  return "grove " + std::string(version()) + "\nSIMD: " + simdTargets() + "\nGL: " + graphics() +
         "\ncodecs: " + codecs() + "\n";
}

}  // namespace grove::cli
