#pragma once

#include <ctime>
#include <filesystem>
#include <string>

#include "base/tls/tls_certificate.h"

namespace grove {

/// A folder of one test, gone with it.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  const std::filesystem::path path_;
};

/// How a certificate that nobody else has signed is to be.
struct CertificateWish {
  std::string name = "localhost";
  long beginsIn = -3600;         ///< seconds from now
  long expiresIn = 90 * 86'400;  ///< seconds from now
  int rsaBits = 0;               ///< 0: an elliptic key
  std::string passphrase = {};
};

/// Makes a new key and its certificate and writes both, each at once. A file that is there is replaced by another one,
/// as certbot does.
void writePair(const TlsFiles& files, const CertificateWish& wish = {});

void writeFile(const std::string& file, const std::string& text);
[[nodiscard]] std::string readFile(const std::string& file);

}  // namespace grove
