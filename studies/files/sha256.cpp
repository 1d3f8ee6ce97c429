// sha256.cpp — by OpenSSL's libcrypto, which libzip brings along.
#include "studies/files/sha256.h"

#include <fmt/format.h>
#include <openssl/sha.h>

#include <array>

namespace kurbel {

std::string sha256(std::string_view data) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
  SHA256(reinterpret_cast<const unsigned char*>(data.data()), data.size(), digest.data());
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace kurbel
