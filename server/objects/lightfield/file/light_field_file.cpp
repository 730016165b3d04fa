#include "objects/lightfield/file/light_field_file.h"

#include <cassert>
#include <cstring>
#include <memory>

#include "base/atomic_file.h"
#include "base/checksum.h"
#include "objects/lightfield/file/light_field_reader.h"
#include "objects/lightfield/file/mapped_file.h"
#include "objects/lightfield/file/source_text.h"
#include "objects/lightfield/format/layout.h"

namespace grove::objects::lightfield {
namespace {

/// Writes sections one after the other.
class SectionWriter {
 public:
  explicit SectionWriter(AtomicFile& file) : file_(file) {}

  template <class T>
  void add(std::span<const T> values) {
    const auto bytes = std::as_bytes(values);
    file_.write(end_, bytes);
    checksum_.add(bytes);
    end_ += bytes.size();
  }

  /// Ends the current section and begins the next.
  [[nodiscard]] Section finish() {
    const Section section{start_, end_ - start_, checksum_.value()};
    start_ = end_ = aligned(end_);
    checksum_ = {};
    return section;
  }

  [[nodiscard]] std::uint64_t end() const noexcept { return end_; }

 private:
  static std::uint64_t aligned(std::uint64_t offset) {
    return (offset + kSectionAlignment - 1) & ~(kSectionAlignment - 1);
  }

  AtomicFile& file_;
  std::uint64_t start_ = kSectionAlignment;
  std::uint64_t end_ = kSectionAlignment;
  Checksum checksum_;
};

void put(world::Vec3 from, float (&to)[3]) { std::memcpy(to, &from, sizeof to); }

Header headerOf(const LightField& field) {
  Header header;
  header.headerBytes = sizeof(Header);
  header.subdivision = static_cast<std::uint32_t>(field.sphere.subdivision());
  header.size = static_cast<std::uint32_t>(field.size);
  header.levels = static_cast<std::uint32_t>(field.levels);
  header.lightings = static_cast<std::uint32_t>(field.lightings());
  header.blocks = static_cast<std::uint32_t>(field.depth.size() / kBlockTexels);
  header.heldOut = static_cast<std::uint32_t>(field.heldOut.size());
  put(field.geometry.centre, header.centre);
  header.radius = field.geometry.radius;
  put(field.geometry.target, header.target);
  header.extent = field.geometry.extent;
  put(field.bounds.low, header.boundsLow);
  put(field.bounds.high, header.boundsHigh);
  header.sunAzimuth = field.sunAzimuth;
  header.voxelCells[0] = static_cast<std::uint32_t>(field.voxels.width);
  header.voxelCells[1] = static_cast<std::uint32_t>(field.voxels.height);
  header.voxelCells[2] = static_cast<std::uint32_t>(field.voxels.depth);
  header.voxelCell = field.voxels.cell;
  put(field.voxels.low, header.voxelLow);
  putSourceText(field.source, header.source);
  return header;
}

void addHeldOut(const HeldOutView& view, SectionWriter& writer) {
  HeldOutHeader header;
  put(view.camera.eye, header.eye);
  put(view.camera.corner, header.corner);
  put(view.camera.perColumn, header.perColumn);
  put(view.camera.perRow, header.perRow);
  header.size = static_cast<std::uint32_t>(view.size);
  header.amid = view.amid ? 1 : 0;
  writer.add(std::span<const HeldOutHeader>(&header, 1));
  writer.add(view.colour);
  writer.add(view.depth);
}

void addNear(const NearModel& near, SectionWriter& writer) {
  if (near.empty()) return;
  const NearHeader header{
      static_cast<std::uint32_t>(near.clusters.size()), static_cast<std::uint32_t>(near.positions[0].size()),
      static_cast<std::uint32_t>(near.faces.size()), static_cast<std::uint32_t>(near.colours.front().size() / 2)};
  writer.add(std::span<const NearHeader>(&header, 1));
  writer.add(near.clusters);
  for (const std::span<const float> axis : near.positions) writer.add(axis);
  writer.add(near.faces);
  for (const std::span<const std::uint32_t> colours : near.colours) writer.add(colours);
}

}  // namespace

LightField openLightField(const std::filesystem::path& file) {
  const auto mapped = std::make_shared<const MappedFile>(file);
  LightField field = readLightField(mapped->bytes(), file.string(), mapped);
  field.mapped = mapped.get();
  // The checks have read every page; pictures need few.
  mapped->release();
  return field;
}

void writeLightField(const LightField& field, const std::filesystem::path& file) {
  assert(field.blocks.size() == static_cast<std::size_t>(field.levels) && field.lightings() >= 1);
  AtomicFile target(file);
  SectionWriter writer(target);
  Header header = headerOf(field);
  for (const auto& level : field.blocks) writer.add(level);
  header.sections[kDirectory] = writer.finish();
  writer.add(field.depth);
  header.sections[kDepth] = writer.finish();
  writer.add(field.voxels.cells);
  header.sections[kVoxels] = writer.finish();
  for (const HeldOutView& view : field.heldOut) addHeldOut(view, writer);
  header.sections[kHeldOut] = writer.finish();
  addNear(field.near, writer);
  header.sections[kNear] = writer.finish();
  for (std::size_t k = 0; k < field.colour.size(); ++k) {
    writer.add(field.colour[k]);
    header.fileBytes = writer.end();
    header.sections[kColour + k] = writer.finish();
  }
  header.headerChecksum = checksumOf(std::as_bytes(std::span(&header, 1)));
  target.write(0, std::as_bytes(std::span(&header, 1)));
  target.commit();
}

}  // namespace grove::objects::lightfield
