#include "objects/lightfield/bake/partial_bake.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "base/checksum.h"
#include "base/error.h"
#include "objects/lightfield/file/mapped_file.h"

namespace grove::bake {

using objects::lightfield::kBlock;
using objects::lightfield::kBlockTexels;
using objects::lightfield::kNoBlock;
using objects::lightfield::LightField;
using objects::lightfield::MappedFile;
using objects::lightfield::PackedView;

namespace {

/// Header of the journal.
struct JournalHead {
  std::array<char, 8> magic{'G', 'r', 'o', 'v', 'e', 'J', '1', '\n'};
  std::uint64_t key = 0;
  std::int32_t views = 0;
  std::int32_t size = 0;
  std::int32_t levels = 0;
  std::int32_t lightings = 0;
};

/// Header of a view's record; its table follows.
struct RecordHead {
  std::uint64_t ownChecksum = 0;   ///< of the rest of the record
  std::uint64_t dataChecksum = 0;  ///< of its blocks in all sections
  std::uint32_t view = 0;
  std::uint32_t blocks = 0;
};
constexpr std::size_t kChecked = sizeof(RecordHead::ownChecksum);

std::size_t blocksAcross(const PartialBake::Shape& shape, int level) {
  return static_cast<std::size_t>(shape.size >> level) / static_cast<std::size_t>(kBlock);
}

std::size_t tableEntries(const PartialBake::Shape& shape) {
  std::size_t entries = 0;
  for (int level = 0; level < shape.levels; ++level) entries += blocksAcross(shape, level) * blocksAcross(shape, level);
  return entries;
}

/// Owner of the memory behind LightField::storage.
struct Storage {
  std::vector<std::vector<std::uint32_t>> blocks;
  std::vector<std::unique_ptr<MappedFile>> sections;
};

template <class T>
std::span<const T> as(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

}  // namespace

PartialBake::PartialBake(std::filesystem::path folder, const Shape& shape) : folder_(std::move(folder)), shape_(shape) {
  std::error_code error;
  std::filesystem::create_directory(folder_, error);
  if (error) {
    throw EnvironmentError("cannot create this folder: " + error.message(), folder_.string(),
                           "the folder above must exist and be writable");
  }
  journal_ = open(folder_ / "journal");
  if (flock(journal_.descriptor, LOCK_EX | LOCK_NB) != 0) {
    close(journal_.descriptor);
    throw EnvironmentError("another process is baking this light field", folder_.string(), "wait for it or stop it");
  }
  for (std::size_t i = 0; i <= static_cast<std::size_t>(shape_.lightings); ++i) {
    sections_.push_back(open(sectionPath(i)));
  }
  takeUp();
}

PartialBake::~PartialBake() {
  for (const File& section : sections_) close(section.descriptor);
  close(journal_.descriptor);
}

std::filesystem::path PartialBake::sectionPath(std::size_t section) const {
  return folder_ / (section == 0 ? "depth" : "colour" + std::to_string(section - 1));
}

std::uint64_t PartialBake::blockBytes(std::size_t section) noexcept {
  return static_cast<std::uint64_t>(kBlockTexels) * (section == 0 ? sizeof(std::uint16_t) : sizeof(std::uint32_t));
}

std::size_t PartialBake::recordBytes() const noexcept {
  return sizeof(RecordHead) + tableEntries(shape_) * sizeof(std::uint32_t);
}

std::uint64_t PartialBake::bytesOfView(const Shape& shape, std::uint64_t blocks) noexcept {
  return blocks * (blockBytes(0) + static_cast<std::uint64_t>(shape.lightings) * blockBytes(1)) + sizeof(RecordHead) +
         tableEntries(shape) * sizeof(std::uint32_t);
}

std::uint64_t PartialBake::bytes() const noexcept {
  return blockCounts_.size() * bytesOfView(shape_, 0) + bytesOfView(shape_, blocks_) - bytesOfView(shape_, 0);
}

PartialBake::File PartialBake::open(const std::filesystem::path& path) const {
  constexpr int kPermissions = 0644;
  File file{path, ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kPermissions)};
  if (file.descriptor < 0) fail(file);
  return file;
}

void PartialBake::fail(const File& file) const {
  const int error = errno;
  std::string what = "cannot write: " + std::generic_category().message(error);
  if (error == ENOSPC && views() > 0) {
    const auto left = static_cast<std::uint64_t>(shape_.views - views());
    const std::uint64_t all = bytes() / static_cast<std::uint64_t>(views()) * static_cast<std::uint64_t>(shape_.views);
    what +=
        ", " + std::to_string(all + bytes() / static_cast<std::uint64_t>(views()) * left) + " more bytes are needed";
  }
  throw EnvironmentError(what, file.path.string(), "free disk space, then run the same command to continue");
}

void PartialBake::write(const File& file, std::uint64_t offset, std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(file.descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(file);
    offset += static_cast<std::uint64_t>(written);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void PartialBake::takeUp() {
  JournalHead head;
  head.key = shape_.key;
  head.views = shape_.views;
  head.size = shape_.size;
  head.levels = shape_.levels;
  head.lightings = shape_.lightings;
  const MappedFile journal(journal_.path);
  std::span<const std::byte> rest = journal.bytes();
  if (rest.size() >= sizeof head && std::memcmp(rest.data(), &head, sizeof head) == 0) {
    std::vector<std::unique_ptr<MappedFile>> files;
    for (const File& section : sections_) files.push_back(std::make_unique<MappedFile>(section.path));
    const std::size_t entries = tableEntries(shape_);
    for (rest = rest.subspan(sizeof head); rest.size() >= recordBytes() && views() < shape_.views;
         rest = rest.subspan(recordBytes())) {
      RecordHead record;
      std::memcpy(&record, rest.data(), sizeof record);
      if (record.view != blockCounts_.size() ||
          record.ownChecksum != checksumOf(rest.subspan(kChecked, recordBytes() - kChecked))) {
        break;
      }
      Checksum data;
      bool there = true;
      for (std::size_t i = 0; i < files.size(); ++i) {
        const std::uint64_t begin = blocks_ * blockBytes(i);
        const std::uint64_t count = record.blocks * blockBytes(i);
        there = there && begin + count <= files[i]->bytes().size();
        if (there) data.add(files[i]->bytes().subspan(begin, count));
      }
      if (!there || data.value() != record.dataChecksum) break;
      const auto table = as<std::uint32_t>(rest.subspan(sizeof record, entries * sizeof(std::uint32_t)));
      tables_.insert(tables_.end(), table.begin(), table.end());
      blockCounts_.push_back(record.blocks);
      blocks_ += record.blocks;
    }
  }
  // Removes everything that is not known to be complete.
  const auto cut = [&](const File& file, std::uint64_t bytes) {
    if (ftruncate(file.descriptor, static_cast<off_t>(bytes)) != 0) fail(file);
  };
  cut(journal_, views() == 0 ? 0 : sizeof head + blockCounts_.size() * recordBytes());
  for (std::size_t i = 0; i < sections_.size(); ++i) cut(sections_[i], blocks_ * blockBytes(i));
  write(journal_, 0, std::as_bytes(std::span(&head, 1)));
}

void PartialBake::append(const PackedView& view) {
  assert(views() < shape_.views && view.colour.size() + 1 == sections_.size());
  Checksum data;
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    const std::span<const std::byte> bytes =
        i == 0 ? std::as_bytes(std::span(view.depth)) : std::as_bytes(std::span(view.colour[i - 1]));
    assert(bytes.size() == view.blockCount() * blockBytes(i));
    write(sections_[i], blocks_ * blockBytes(i), bytes);
    data.add(bytes);
  }
  RecordHead head;
  head.dataChecksum = data.value();
  head.view = static_cast<std::uint32_t>(views());
  head.blocks = static_cast<std::uint32_t>(view.blockCount());
  std::vector<std::byte> record(sizeof head);
  for (const auto& level : view.blocks) {
    tables_.insert(tables_.end(), level.begin(), level.end());
    const auto bytes = std::as_bytes(std::span(level));
    record.insert(record.end(), bytes.begin(), bytes.end());
  }
  assert(record.size() == recordBytes());
  std::memcpy(record.data(), &head, sizeof head);
  head.ownChecksum = checksumOf(std::span(record).subspan(kChecked));
  std::memcpy(record.data(), &head, sizeof head);
  write(journal_, sizeof(JournalHead) + blockCounts_.size() * recordBytes(), record);
  blockCounts_.push_back(head.blocks);
  blocks_ += head.blocks;
}

void PartialBake::fill(LightField& field) const {
  assert(views() == shape_.views);
  const auto storage = std::make_shared<Storage>();
  const std::size_t entries = tableEntries(shape_);
  std::size_t levelStart = 0;
  for (int level = 0; level < shape_.levels; ++level) {
    const std::size_t count = blocksAcross(shape_, level) * blocksAcross(shape_, level);
    std::vector<std::uint32_t>& blocks = storage->blocks.emplace_back();
    blocks.reserve(count * blockCounts_.size());
    std::uint32_t before = 0;
    for (std::size_t view = 0; view < blockCounts_.size(); ++view) {
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t block = tables_[view * entries + levelStart + i];
        blocks.push_back(block == kNoBlock ? kNoBlock : before + block);
      }
      before += blockCounts_[view];
    }
    levelStart += count;
  }
  for (const File& section : sections_) storage->sections.push_back(std::make_unique<MappedFile>(section.path));
  field.blocks.assign(storage->blocks.begin(), storage->blocks.end());
  field.depth = as<std::uint16_t>(storage->sections[0]->bytes());
  field.colour.clear();
  for (std::size_t i = 1; i < sections_.size(); ++i) {
    field.colour.push_back(as<std::uint32_t>(storage->sections[i]->bytes()));
  }
  field.storage = storage;
}

void PartialBake::remove() {
  std::error_code ignored;  // leftovers are harmless: the next bake uses or truncates them
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace grove::bake
