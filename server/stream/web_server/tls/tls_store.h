#pragma once

#include <array>
#include <cstdint>
#include <ctime>
#include <memory>
#include <mutex>

#include "base/tls/tls_certificate.h"

namespace grove::stream {

/// A running server's certificate, reloaded from its files when they change; open connections keep the one they began
/// with. An invalid new pair is reported, and the old one stays.
class TlsStore {
 public:
  /// Throws what TlsCertificate throws. Warns of a certificate that expires soon, now and once a day.
  explicit TlsStore(TlsFiles files);

  /// Any thread.
  [[nodiscard]] std::shared_ptr<const TlsCertificate> current() const;

  /// Reads the files now. Same thread as look().
  void reload();
  /// Call about once a second. Reads the files once they have changed and then stayed the same from one call to the
  /// next, because a certificate and its key are not replaced at the same moment.
  void look();

 private:
  /// Identifies a version of a file, after following symbolic links.
  struct Stamp {
    std::uint64_t device = 0;
    std::uint64_t inode = 0;
    std::int64_t bytes = -1;  ///< negative: no file
    std::int64_t seconds = 0;
    std::int64_t nanoseconds = 0;
    bool operator==(const Stamp&) const = default;
  };
  using Stamps = std::array<Stamp, 2>;
  static Stamp stampOf(const std::string& file);
  [[nodiscard]] Stamps stamps() const;
  void warnOfExpiry();

  const TlsFiles files_;
  Stamps read_;  ///< of the last attempt to read the files, successful or not
  Stamps seen_;  ///< at the last look()
  std::time_t nextWarning_ = 0;
  mutable std::mutex mutex_;
  std::shared_ptr<const TlsCertificate> current_;
};

}  // namespace grove::stream
