#pragma once

#include <array>
#include <cstdint>
#include <ctime>
#include <memory>
#include <mutex>

#include "base/tls/tls_certificate.h"

namespace grove::stream {

/// The certificate that a running server shows, made anew from its files when they change: connections that are there
/// go on with the one they began with. A bad new pair is reported, and the one before stays.
class TlsStore {
 public:
  /// Throws what TlsCertificate throws. A certificate that expires soon is warned of, now and once a day.
  explicit TlsStore(TlsFiles files);

  /// Any thread.
  [[nodiscard]] std::shared_ptr<const TlsCertificate> current() const;

  /// Reads the files now. One thread, as look().
  void reload();
  /// To be called about once a second: reads the files once they have changed and then stayed the same from one call to
  /// the next, for a certificate and its key are not replaced at the same moment.
  void look();

 private:
  /// What tells a file from what it was before, behind all symbolic links.
  struct Stamp {
    std::uint64_t device = 0;
    std::uint64_t inode = 0;
    std::int64_t bytes = -1;  ///< negative: there is none
    std::int64_t seconds = 0;
    std::int64_t nanoseconds = 0;
    bool operator==(const Stamp&) const = default;
  };
  using Stamps = std::array<Stamp, 2>;
  static Stamp stampOf(const std::string& file);
  [[nodiscard]] Stamps stamps() const;
  void warnOfExpiry();

  const TlsFiles files_;
  Stamps read_;  ///< of the files as they were read last, whatever came of it
  Stamps seen_;  ///< at the last look
  std::time_t nextWarning_ = 0;
  mutable std::mutex mutex_;
  std::shared_ptr<const TlsCertificate> current_;
};

}  // namespace grove::stream
