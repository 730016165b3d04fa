#include "stream/web_server/tls/tls_store.h"

#include <sys/stat.h>

#include <string>
#include <utility>

#include "base/log.h"

namespace grove::stream {
namespace {

constexpr std::time_t kDay = 24 * 3600;
constexpr std::time_t kWarnBefore = 14 * kDay;

}  // namespace

TlsStore::TlsStore(TlsFiles files)
    : files_(std::move(files)),
      read_(stamps()),
      seen_(read_),
      current_(std::make_shared<TlsCertificate>(files_, std::time(nullptr))) {
  warnOfExpiry();
}

std::shared_ptr<const TlsCertificate> TlsStore::current() const {
  const std::lock_guard lock(mutex_);
  return current_;
}

void TlsStore::reload() {
  read_ = seen_ = stamps();
  try {
    auto fresh = std::make_shared<const TlsCertificate>(files_, std::time(nullptr));
    log::info("new connections get the certificate that expires on " + dateOf(fresh->expires()));
    const std::lock_guard lock(mutex_);
    current_ = std::move(fresh);
  } catch (const std::exception& e) {
    log::error(std::string(e.what()) + "; the certificate that expires on " + dateOf(current_->expires()) + " stays");
  }
  nextWarning_ = 0;
  warnOfExpiry();
}

void TlsStore::look() {
  const Stamps now = stamps();
  const bool rests = std::exchange(seen_, now) == now;
  if (rests && now != read_) reload();
  warnOfExpiry();
}

TlsStore::Stamp TlsStore::stampOf(const std::string& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return {};
  return {status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

TlsStore::Stamps TlsStore::stamps() const { return {stampOf(files_.certificate), stampOf(files_.key)}; }

void TlsStore::warnOfExpiry() {
  const std::time_t now = std::time(nullptr);
  const std::time_t expires = current_->expires();
  if (now < nextWarning_ || expires - now > kWarnBefore) return;
  nextWarning_ = now + kDay;
  log::warning("--tls-cert " + files_.certificate + ": the certificate " + (now > expires ? "expired" : "expires") +
               " on " + dateOf(expires) + " (renew it; changed files are reloaded)");
}

}  // namespace grove::stream
