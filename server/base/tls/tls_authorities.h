#pragma once

#include <openssl/x509.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace grove {

/// Authorities that a process trusts; verifies other processes' certificates. Immutable.
class TlsAuthorities {
 public:
  /// The role of the other process.
  enum class Role : std::uint8_t { kServer, kClient };

  /// Reads certificates in PEM form. Throws EnvironmentError that names the option and the file if the file has none,
  /// or if one cannot be read.
  TlsAuthorities(const std::string& option, const std::string& file);

  /// Returns the reason for rejecting a certificate, in words that follow "the process": it is expired, no authority
  /// has signed it, or it is for another purpose or another host. Empty: it is accepted. `chain` has the certificates
  /// of its issuers. An empty `host` is not compared.
  [[nodiscard]] std::optional<std::string> complaint(std::string_view certificate, std::string_view chain, Role role,
                                                     const std::string& host) const;

 private:
  struct Deleter {
    void operator()(X509_STORE* store) const noexcept { X509_STORE_free(store); }
  };
  const std::string file_;
  const std::unique_ptr<X509_STORE, Deleter> store_;
};

}  // namespace grove
