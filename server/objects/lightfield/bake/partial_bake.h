#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "objects/lightfield/file/view_packer.h"
#include "objects/lightfield/format/light_field.h"

namespace grove::bake {

/// The finished views of a bake in progress, in a folder beside its file: the sections of the future light field, to
/// which views are appended in order, and a journal of the bytes that are complete. The folder outlives its process, so
/// that a killed bake continues where it stopped. One thread at a time; a lock permits one process at a time. Throws
/// EnvironmentError: no permission, disk full, or another process holds the lock.
class PartialBake {
 public:
  struct Shape {
    int views = 0;
    int size = 0;
    int levels = 1;
    int lightings = 1;
    std::uint64_t key = 0;  ///< of all inputs that determine the views' bytes
  };

  /// Continues with the folder's views if they have the same shape, else starts over.
  PartialBake(std::filesystem::path folder, const Shape& shape);
  ~PartialBake();
  PartialBake(const PartialBake&) = delete;
  PartialBake& operator=(const PartialBake&) = delete;

  /// Number of finished views, also the index of the next one.
  [[nodiscard]] int views() const noexcept { return static_cast<int>(blockCounts_.size()); }
  /// Disk space in use.
  [[nodiscard]] std::uint64_t bytes() const noexcept;
  void append(const objects::lightfield::PackedView& view);

  /// Sets the field's blocks, depth, colour and storage. All views must be present, and no view may be appended later.
  void fill(objects::lightfield::LightField& field) const;

  /// Deletes the folder; call last.
  void remove();

  /// Disk space of a view with this many blocks.
  [[nodiscard]] static std::uint64_t bytesOfView(const Shape& shape, std::uint64_t blocks) noexcept;

 private:
  /// An open file of the folder.
  struct File {
    std::filesystem::path path;
    int descriptor = -1;
  };

  [[nodiscard]] std::filesystem::path sectionPath(std::size_t section) const;
  [[nodiscard]] static std::uint64_t blockBytes(std::size_t section) noexcept;
  [[nodiscard]] std::size_t recordBytes() const noexcept;
  [[nodiscard]] File open(const std::filesystem::path& path) const;
  void takeUp();
  void write(const File& file, std::uint64_t offset, std::span<const std::byte> bytes) const;
  [[noreturn]] void fail(const File& file) const;

  const std::filesystem::path folder_;
  const Shape shape_;
  File journal_;
  std::vector<File> sections_;              ///< depth, then each lighting's colour
  std::vector<std::uint32_t> blockCounts_;  ///< by view
  std::vector<std::uint32_t> tables_;       ///< by view: its blocks by level, numbered from 0
  std::uint64_t blocks_ = 0;
};

}  // namespace grove::bake
