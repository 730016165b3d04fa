#include "objects/lightfield/file/light_field_reader.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <tuple>
#include <utility>
#include <vector>

#include "base/checksum.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/near_reader.h"
#include "objects/lightfield/file/source_text.h"
#include "objects/lightfield/format/layout.h"
#include "world/camera.h"

namespace grove::objects::lightfield {
namespace {

static_assert(std::endian::native == std::endian::little, "files are read in place");

// As with kLongest, for quotients.
constexpr float kShortest = 1.0e-4F;
constexpr float kShortestVoxel = 1.0e-6F;

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  LightField read(std::shared_ptr<const void> storage) {
    readHeader();
    checkShape();
    checkSections();
    LightField field;
    field.sphere = ViewSphere(static_cast<int>(header_.subdivision));
    field.geometry = geometry();
    field.bounds = {vector(header_.boundsLow), vector(header_.boundsHigh)};
    field.size = static_cast<int>(header_.size);
    field.levels = static_cast<int>(header_.levels);
    field.sunAzimuth = header_.sunAzimuth;
    field.source = header_.source;
    readBlocks(field);
    readVoxels(field);
    readHeldOut(field);
    const auto clusters = readNear(bytesOf(header_.sections[kNear]), header_.lightings, name_, field);
    field.storage = std::make_shared<const Storage>(std::move(storage), std::move(directory_), clusters);
    return field;
  }

 private:
  using Storage = std::tuple<std::shared_ptr<const void>, std::shared_ptr<const std::vector<std::uint32_t>>,
                             std::shared_ptr<const std::vector<NearCluster>>>;

  void require(bool good, const char* reason) const {
    if (!good) throw LightFieldError(name_ + ": " + reason);
  }

  void readHeader() {
    constexpr std::size_t kVersionEnd = offsetof(Header, version) + sizeof(Header::version);
    const bool ours = bytes_.size() >= kMagic.size() && std::memcmp(bytes_.data(), kMagic.data(), kMagic.size()) == 0;
    require(ours, "is not a light-field file");
    require(bytes_.size() >= kVersionEnd, "is truncated");
    std::memcpy(&header_.version, bytes_.data() + offsetof(Header, version), sizeof header_.version);
    if (header_.version > kFormatVersion) {
      throw LightFieldError(name_ + ": is of format version " + std::to_string(header_.version) +
                            ", made by a newer Grove; this one reads version " + std::to_string(kFormatVersion));
    }
    require(header_.version == kFormatVersion, "has no valid format version");
    require(bytes_.size() >= sizeof(Header), "is truncated");
    std::memcpy(&header_, bytes_.data(), sizeof(Header));
    require(header_.headerBytes == sizeof(Header), "has a header of the wrong length");
    require(bytes_.size() >= header_.fileBytes, "is truncated");
    require(bytes_.size() == header_.fileBytes, "has bytes after its end");
    Header unsummed = header_;
    unsummed.headerChecksum = 0;
    require(checksumOf(std::as_bytes(std::span(&unsummed, 1))) == header_.headerChecksum, "has a damaged header");
  }

  static world::Vec3 vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

  [[nodiscard]] ViewGeometry geometry() const {
    return {vector(header_.centre), header_.radius, vector(header_.target), header_.extent};
  }

  void checkShape() const {
    require(header_.subdivision >= 1 && header_.subdivision <= ViewSphere::kMaxSubdivision,
            "has a subdivision out of range");
    require(header_.size >= kMinSize && header_.size <= kMaxSize && std::has_single_bit(header_.size),
            "has views of a size out of range");
    require(header_.levels >= 1 && header_.levels <= 16 && (header_.size >> (header_.levels - 1)) >= kBlock,
            "has a number of mip levels out of range");
    require(header_.lightings >= 1 && header_.lightings <= kMaxLightings, "has a number of lightings out of range");
    checkLengths();
    require(isSourceText(header_.source), "has a source that is not a line of UTF-8");
  }

  void checkLengths() const {
    const auto sane = [](std::initializer_list<std::span<const float>> all) {
      return std::ranges::all_of(all, [](std::span<const float> some) {
        return std::ranges::all_of(some, [](float v) { return std::abs(v) <= kLongest; });
      });
    };
    const Header& h = header_;
    const auto one = [](const float& v) { return std::span(&v, 1); };
    require(sane({h.centre, h.target, h.boundsLow, h.boundsHigh, h.voxelLow, one(h.radius), one(h.extent),
                  one(h.sunAzimuth), one(h.voxelCell)}),
            "has a length out of range");
    require(h.extent >= kShortest, "has an extent out of range");
    require(seesItsBall(geometry()), "has a radius out of range");
    for (int axis = 0; axis < 3; ++axis) require(h.boundsLow[axis] <= h.boundsHigh[axis], "has inverted bounds");
  }

  void checkSections() const {
    const std::size_t used = kColour + header_.lightings;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges{{0, sizeof(Header)}};
    for (std::size_t i = 0; i < std::size(header_.sections); ++i) {
      const Section& section = header_.sections[i];
      if (i >= used) {
        require(section.offset == 0 && section.bytes == 0 && section.checksum == 0, "has more sections than lightings");
        continue;
      }
      require(section.offset % kSectionAlignment == 0, "has a section that is not aligned");
      require(section.offset <= bytes_.size() && section.bytes <= bytes_.size() - section.offset,
              "has a section outside the file");
      if (section.bytes > 0) ranges.emplace_back(section.offset, section.offset + section.bytes);
    }
    std::ranges::sort(ranges);
    for (std::size_t i = 1; i < ranges.size(); ++i)
      require(ranges[i - 1].second <= ranges[i].first, "has sections that overlap");
    for (std::size_t i = 0; i < used; ++i) {
      const bool whole = checksumOf(bytesOf(header_.sections[i])) == header_.sections[i].checksum;
      require(whole, "has a damaged section (its checksum is wrong)");
    }
  }

  [[nodiscard]] std::span<const std::byte> bytesOf(const Section& section) const {
    return bytes_.subspan(section.offset, section.bytes);
  }

  /// `bytes` start at a multiple of alignof(T) in the file.
  template <class T>
  [[nodiscard]] static std::span<const T> as(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }

  void readBlocks(LightField& field) {
    const std::uint64_t texels = std::uint64_t{header_.blocks} * kBlockTexels;
    const Section& depth = header_.sections[kDepth];
    require(depth.bytes == texels * sizeof(std::uint16_t), "has depth of the wrong length");
    field.depth = as<std::uint16_t>(bytesOf(depth));
    field.bytes += depth.bytes;
    for (std::size_t k = 0; k < header_.lightings; ++k) {
      const Section& colour = header_.sections[kColour + k];
      require(colour.bytes == texels * sizeof(std::uint32_t), "has colour of the wrong length");
      field.colour.push_back(as<std::uint32_t>(bytesOf(colour)));
      field.bytes += colour.bytes;
    }

    // A copy, because readers navigate by it: later writes to the mapped file must not corrupt it.
    const auto mapped = as<std::uint32_t>(bytesOf(header_.sections[kDirectory]));
    directory_ = std::make_shared<const std::vector<std::uint32_t>>(mapped.begin(), mapped.end());
    const std::span<const std::uint32_t> directory(*directory_);
    std::size_t next = 0;
    for (int level = 0; level < field.levels; ++level) {
      const auto across = static_cast<std::size_t>(field.blocksAcross(level));
      const std::size_t entries = static_cast<std::size_t>(field.sphere.views()) * across * across;
      require(entries <= directory.size() - next, "has a directory of the wrong length");
      field.blocks.push_back(directory.subspan(next, entries));
      next += entries;
    }
    require(next * sizeof(std::uint32_t) == header_.sections[kDirectory].bytes, "has a directory of the wrong length");
    const bool within = std::ranges::all_of(
        directory, [this](std::uint32_t block) { return block == kNoBlock || block < header_.blocks; });
    require(within, "has a directory that names a block that is not there");
    field.bytes += directory.size_bytes();
  }

  void readVoxels(LightField& field) const {
    constexpr std::uint32_t kMaxCells = 4096;
    const std::uint32_t(&n)[3] = header_.voxelCells;
    const Section& section = header_.sections[kVoxels];
    require(std::ranges::all_of(n, [](std::uint32_t cells) { return cells <= kMaxCells; }),
            "has a number of voxels out of range");
    require(std::uint64_t{n[0]} * n[1] * n[2] == section.bytes, "has voxels of the wrong length");
    require(section.bytes > 0 ? header_.voxelCell >= kShortestVoxel : n[0] == 0 && n[1] == 0 && n[2] == 0,
            "has voxels without size");
    field.voxels = {static_cast<int>(n[0]), static_cast<int>(n[1]),   static_cast<int>(n[2]),
                    header_.voxelCell,      vector(header_.voxelLow), as<std::uint8_t>(bytesOf(section))};
    const auto known = [](std::uint8_t voxel) { return voxel <= static_cast<std::uint8_t>(Voxel::kLeaves); };
    require(std::ranges::all_of(field.voxels.cells, known), "has voxels of an unknown kind");
    field.bytes += section.bytes;
  }

  void readHeldOut(LightField& field) const {
    std::span<const std::byte> rest = bytesOf(header_.sections[kHeldOut]);
    for (std::uint32_t i = 0; i < header_.heldOut; ++i) {
      HeldOutHeader header;
      require(rest.size() >= sizeof header, "has held-out views of the wrong length");
      std::memcpy(&header, rest.data(), sizeof header);
      rest = rest.subspan(sizeof header);
      require(header.size >= 1 && header.size <= kMaxSize && header.amid <= 1,
              "has a held-out view of a size out of range");
      const world::Vec3 camera[] = {vector(header.eye), vector(header.corner), vector(header.perColumn),
                                    vector(header.perRow)};
      for (const world::Vec3& v : camera) require(glm::length(v) <= kLongest, "has a held-out view from nowhere");
      const std::size_t pixels = std::size_t{header.size} * header.size;
      require(rest.size() >= pixels * (sizeof(std::uint32_t) + sizeof(float)),
              "has held-out views of the wrong length");
      const auto colour = as<std::uint32_t>(rest.first(pixels * sizeof(std::uint32_t)));
      rest = rest.subspan(colour.size_bytes());
      const auto depth = as<float>(rest.first(pixels * sizeof(float)));
      rest = rest.subspan(depth.size_bytes());
      require(std::ranges::all_of(depth, [](float d) { return d >= 0.0F && d <= world::kInfiniteDepth; }),
              "has a held-out view with invalid depths");
      field.heldOut.push_back({{camera[0], camera[1], camera[2], camera[3]},
                               static_cast<int>(header.size),
                               colour,
                               depth,
                               header.amid == 1});
      field.bytes += colour.size_bytes() + depth.size_bytes();
    }
    require(rest.empty(), "has held-out views of the wrong length");
  }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  Header header_;
  std::shared_ptr<const std::vector<std::uint32_t>> directory_;
};

}  // namespace

LightField readLightField(std::span<const std::byte> bytes, const std::string& name,
                          std::shared_ptr<const void> storage) {
  return Reader(bytes, name).read(std::move(storage));
}

}  // namespace grove::objects::lightfield
