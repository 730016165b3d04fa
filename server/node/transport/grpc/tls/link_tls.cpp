#include "node/transport/grpc/tls/link_tls.h"

#include <cstdint>
#include <ctime>

#include "base/plain_file.h"

namespace grove::node {
namespace {

constexpr std::uint64_t kMaxPemBytes = std::uint64_t{1} << 20U;

std::string textOf(const std::string& file) { return PlainFile(file, "", kMaxPemBytes).readAll(); }

}  // namespace

LinkTls readLinkTls(const TlsFiles& own, const std::string& authorities) {
  LinkTls tls;
  if (!own.certificate.empty()) {
    const TlsCertificate judged(own, std::time(nullptr));
    tls.certificate = textOf(own.certificate);
    tls.key = textOf(own.key);
  }
  if (!authorities.empty()) tls.trusted = std::make_shared<const TlsAuthorities>(own.option + "-ca", authorities);
  return tls;
}

}  // namespace grove::node
