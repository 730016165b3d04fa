#include "cli/bench/lightfield/bench_lightfield.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <latch>
#include <nlohmann/json.hpp>
#include <random>
#include <stop_token>
#include <vector>

#include "cli/bench/lightfield/lightfield_quality.h"
#include "cli/figures.h"
#include "cli/prepare/progress.h"
#include "measure/memory_use.h"
#include "models/plants/plants.h"
#include "objects/lightfield/backend/simd/simd_sampler.h"
#include "objects/lightfield/bake/bake.h"
#include "objects/lightfield/file/light_field_file.h"
#include "pipeline/clocks.h"
#include "pipeline/worker_pool.h"

namespace grove::cli {
namespace {

namespace lightfield = objects::lightfield;
using lightfield::DepthCorrection;
using lightfield::LightField;
using world::Vec3;

constexpr int kRepeats = 3;

/// A small oak's light field in a temporary file, deleted by the destructor.
class TemporaryOak {
 public:
  explicit TemporaryOak(int threads)
      : path_(std::filesystem::temp_directory_path() / ("grove-bench-" + std::to_string(getpid()) + ".glf")) {
    bake::BakeOptions options;
    options.lightings = 1;
    options.threads = threads;
    Progress progress;
    (void)bake::bakeLightField(
        models::makePlant("oak", 1, models::Detail::kSmall), options, path_,
        [&](const bake::BakeProgress& now) { progress.show(now.step, now.share); }, std::stop_token());
    progress.finish();
  }
  ~TemporaryOak() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryOak(const TemporaryOak&) = delete;
  TemporaryOak& operator=(const TemporaryOak&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Cameras all around, inside and outside the sphere of views, that frame the object as its views do: it fills the
/// picture.
std::vector<lightfield::ObjectCamera> randomCameras(const LightField& field, int count, int size) {
  std::mt19937 random(1);
  const auto uniform = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
  std::vector<lightfield::ObjectCamera> cameras;
  for (int i = 0; i < count; ++i) {
    const float azimuth = uniform(-3.14159265F, 3.14159265F);
    const float elevation = uniform(0.03F, 1.2F);
    lightfield::ViewGeometry geometry = field.geometry;
    geometry.radius *= uniform(0.6F, 2.0F);
    const Vec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                         std::cos(elevation) * std::cos(azimuth));
    cameras.push_back(objectCamera(viewCamera(geometry, direction), size));
  }
  return cameras;
}

struct Speed {
  double wallSeconds = 0.0;
  double cpuMsPerRequest = 0.0;
};

/// Renders all cameras once, on all threads of the pool.
Speed renderAll(const LightField& field, const std::vector<lightfield::ObjectCamera>& cameras, int size,
                DepthCorrection correction, pipeline::WorkerPool& pool) {
  const auto coarser = std::bit_width(static_cast<unsigned>(field.size / size));
  const int level = std::clamp(static_cast<int>(coarser) - 1, 0, field.levels - 1);
  std::atomic<std::size_t> next{0};
  std::atomic<std::int64_t> cpu{0};
  std::latch done(pool.width());
  const std::int64_t begin = pipeline::wallNanoseconds();
  for (int thread = 0; thread < pool.width(); ++thread) {
    pool.post([&] {
      raster::ImagePool images;
      const auto image = images.acquire({0, 0, size, size});
      raster::Image* const target = image.get();
      lightfield::SimdSampler sampler(correction);
      const std::int64_t cpuBegin = pipeline::threadCpuNanoseconds();
      for (std::size_t i = next++; i < cameras.size(); i = next++) {
        lightfield::SampleRequest request;
        request.field = &field;
        request.level = level;
        request.camera = cameras[i];
        sampler.render({&request, 1}, {&target, 1});
      }
      cpu += pipeline::threadCpuNanoseconds() - cpuBegin;
      done.count_down();
    });
  }
  done.wait();
  Speed speed;
  speed.wallSeconds = static_cast<double>(pipeline::wallNanoseconds() - begin) * 1.0e-9;
  speed.cpuMsPerRequest = static_cast<double>(cpu) * 1.0e-6 / static_cast<double>(cameras.size());
  return speed;
}

/// Returns medians over repeats, after a first one that loads the file into memory.
Speed measure(const LightField& field, const std::vector<lightfield::ObjectCamera>& cameras, int size,
              DepthCorrection correction, pipeline::WorkerPool& pool) {
  (void)renderAll(field, cameras, size, correction, pool);
  std::vector<double> wall;
  std::vector<double> cpu;
  for (int i = 0; i < kRepeats; ++i) {
    const Speed speed = renderAll(field, cameras, size, correction, pool);
    wall.push_back(speed.wallSeconds);
    cpu.push_back(speed.cpuMsPerRequest);
  }
  return {median(wall), median(cpu)};
}

}  // namespace

int runBenchLightfield(const BenchLightfieldOptions& options) {
  const int threads = options.threads > 0 ? options.threads : pipeline::coreCount();
  std::optional<TemporaryOak> oak;
  if (!options.file) oak.emplace(threads);
  const std::filesystem::path file = options.file ? std::filesystem::path(*options.file) : oak->path();
  const LightField field = lightfield::openLightField(file);

  const auto cameras = randomCameras(field, options.requests, options.size);
  pipeline::WorkerPool pool(threads);
  const Speed speed = measure(field, cameras, options.size, DepthCorrection::kOn, pool);
  const std::size_t resident = grove::measure::residentBytes();
  const Speed plain = measure(field, cameras, options.size, DepthCorrection::kOff, pool);
  const auto perSecond = [&](const Speed& of) { return static_cast<double>(options.requests) / of.wallSeconds; };
  const LightfieldQuality quality = measureQuality(field, DepthCorrection::kOn);
  const LightfieldQuality without = measureQuality(field, DepthCorrection::kOff);

  nlohmann::ordered_json report = {{"source", field.source},
                                   {"views", field.sphere.views()},
                                   {"subdivision", field.sphere.subdivision()},
                                   {"view_size", field.size},
                                   {"lightings", field.lightings()},
                                   {"file_bytes", std::filesystem::file_size(file)},
                                   {"resident_bytes", resident},
                                   {"size", options.size},
                                   {"requests", options.requests},
                                   {"threads", threads},
                                   {"requests_per_s", perSecond(speed)},
                                   {"cpu_ms_per_request", speed.cpuMsPerRequest},
                                   {"requests_per_s_without_depth", perSecond(plain)},
                                   {"held_out_views", field.heldOut.size()},
                                   {"psnr_db", quality.psnr},
                                   {"ssim", quality.ssim},
                                   {"psnr_db_over_sky", quality.psnrOverSky},
                                   {"psnr_db_without_depth", without.psnr},
                                   {"ssim_without_depth", without.ssim}};
  if (models::isTile(field.source)) {
    report["seam_psnr_db"] = quality.seamPsnr;
    report["inside_psnr_db"] = quality.insidePsnr;
  }
  if (options.json) {
    std::printf("%s\n", report.dump(2).c_str());
  } else {
    std::printf(
        "%s, %d views of %d^2: %.0f requests/s at %d^2 on %d threads, %.2f ms CPU each; held-out views %.1f dB, "
        "SSIM %.3f; without depth %.1f dB\n",
        field.source.c_str(), field.sphere.views(), field.size, perSecond(speed), options.size, threads,
        speed.cpuMsPerRequest, quality.psnr, quality.ssim, without.psnr);
  }
  return 0;
}

}  // namespace grove::cli
