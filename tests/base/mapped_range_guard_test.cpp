#include "base/mapped_range_guard.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "sanitized.h"

namespace grove {
namespace {

constexpr std::size_t kPage = 4096;

/// A file of some pages full of sevens, mapped.
class Mapping {
 public:
  explicit Mapping(std::size_t pages) : size_(pages * kPage) {
    std::string name = (std::filesystem::temp_directory_path() / "grove_guard_XXXXXX").string();
    file_ = mkstemp(name.data());
    unlink(name.c_str());
    const std::vector<char> sevens(size_, 7);
    EXPECT_EQ(pwrite(file_, sevens.data(), size_, 0), static_cast<ssize_t>(size_));
    address_ = static_cast<std::byte*>(mmap(nullptr, size_, PROT_READ, MAP_SHARED, file_, 0));
  }
  ~Mapping() {
    munmap(address_, size_);
    close(file_);
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  void shorten(std::size_t bytes) const { EXPECT_EQ(ftruncate(file_, static_cast<off_t>(bytes)), 0); }
  [[nodiscard]] std::span<const std::byte> bytes() const { return {address_, size_}; }
  [[nodiscard]] int at(std::size_t offset) const {
    return std::to_integer<int>(*const_cast<const volatile std::byte*>(address_ + offset));
  }

 private:
  std::size_t size_;
  int file_;
  std::byte* address_;
};

TEST(MappedRangeGuard, TruncatedPagesReadAsZero) {
  const Mapping mapping(8);
  const MappedRangeGuard guard(mapping.bytes());
  EXPECT_EQ(mapping.at(6 * kPage), 7);
  EXPECT_FALSE(guard.cut());
  mapping.shorten(2 * kPage + 100);
  EXPECT_EQ(mapping.at(kPage), 7);
  EXPECT_FALSE(guard.cut()) << "nobody has read what is gone";
  EXPECT_EQ(mapping.at(5 * kPage + 17), 0);
  EXPECT_TRUE(guard.cut());
  EXPECT_EQ(mapping.at(3 * kPage), 0);
  EXPECT_EQ(mapping.at(8 * kPage - 1), 0);
  EXPECT_EQ(mapping.at(2 * kPage + 99), 7) << "what is still there is still read";
}

TEST(MappedRangeGuard, ConcurrentFaults) {
  const Mapping mapping(64);
  const MappedRangeGuard guard(mapping.bytes());
  mapping.shorten(0);
  std::vector<std::jthread> readers;
  for (std::size_t reader = 0; reader < 4; ++reader) {
    readers.emplace_back([&mapping, reader] {
      for (std::size_t page = 64; page-- > 0;) EXPECT_EQ(mapping.at(page * kPage + reader), 0);
    });
  }
  readers.clear();
  EXPECT_TRUE(guard.cut());
}

TEST(MappedRangeGuard, RangesAreIndependent) {
  const Mapping first(4);
  const Mapping second(4);
  const MappedRangeGuard one(first.bytes());
  const MappedRangeGuard two(second.bytes());
  second.shorten(0);
  EXPECT_EQ(second.at(0), 0);
  EXPECT_FALSE(one.cut());
  EXPECT_TRUE(two.cut());
}

TEST(MappedRangeGuard, ExcessRangesAreUnguarded) {
  const Mapping mapping(1);
  std::vector<std::unique_ptr<MappedRangeGuard>> guards;
  guards.reserve(1100);
  while (guards.size() < guards.capacity()) guards.push_back(std::make_unique<MappedRangeGuard>(mapping.bytes()));
  guards.clear();
  const MappedRangeGuard guard(mapping.bytes());
  mapping.shorten(0);
  EXPECT_EQ(mapping.at(0), 0);
  EXPECT_TRUE(guard.cut());
}

/// Reads beyond the end of a file that is not guarded (any more), while another is.
void readUnguarded(bool guardedOnce) {
  const Mapping guarded(4);
  const Mapping bare(4);
  const MappedRangeGuard guard(guarded.bytes());
  if (guardedOnce) const MappedRangeGuard shortly(bare.bytes());
  bare.shorten(0);
  std::exit(bare.at(0));
}

TEST(MappedRangeGuardDeathTest, AnyOtherFaultEndsTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (const bool guardedOnce : {false, true}) {
    if constexpr (kSanitized) {
      EXPECT_DEATH(readUnguarded(guardedOnce), "SIGBUS|BUS|DEADLYSIGNAL");
    } else {
      EXPECT_EXIT(readUnguarded(guardedOnce), testing::KilledBySignal(SIGBUS), "");
    }
  }
}

TEST(MappedRangeGuardDeathTest, SentSignalsAreNoFaults) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const Mapping guarded(1);
  const MappedRangeGuard guard(guarded.bytes());
  if constexpr (kSanitized) {
    EXPECT_DEATH(raise(SIGBUS), "SIGBUS|BUS|DEADLYSIGNAL");
  } else {
    EXPECT_EXIT(raise(SIGBUS), testing::KilledBySignal(SIGBUS), "");
  }
}

volatile std::sig_atomic_t handled = 0;

TEST(MappedRangeGuardDeathTest, OtherFaultsGoToTheFormerHandler) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto run = [] {
    std::signal(SIGBUS, [](int) { handled = handled + 1; });
    const Mapping mapping(2);
    const MappedRangeGuard guard(mapping.bytes());
    raise(SIGBUS);
    mapping.shorten(0);
    std::exit(handled == 1 && mapping.at(kPage) == 0 && guard.cut() ? 0 : 1);
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace grove
