// sha256.cpp — by OpenSSL's libcrypto, which libzip brings along.
#define OPENSSL_API_COMPAT 0x10100000L  // the functions of 3.0 and later cannot go on from a state
#include "studies/files/sha256.h"

#include <fmt/format.h>
#include <openssl/sha.h>

#include <algorithm>

namespace kurbel {

std::string sha256(std::string_view data, const HashedBeginning& beginning) {
  SHA256_CTX context;
  SHA256_Init(&context);
  if (beginning.bytes > 0) {
    std::copy(beginning.state.begin(), beginning.state.end(), context.h);
    context.Nl = static_cast<SHA_LONG>(8 * beginning.bytes);
    context.Nh = static_cast<SHA_LONG>(beginning.bytes >> 29);
    data.remove_prefix(beginning.bytes);
  }
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
  SHA256_Update(&context, data.data(), data.size());
  SHA256_Final(digest.data(), &context);
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace kurbel
