// sha256.h — SHA-256 (FIPS 180-4), to check whether a result set is complete.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace kurbel {

// A beginning that texts share, in whole blocks of 64 bytes, and the state of the hash behind it.
struct HashedBeginning {
  std::size_t bytes = 0;
  std::array<std::uint32_t, 8> state = {};
};

// 64 hexadecimal digits, as sha256sum prints them. Data that begin so are hashed from there on.
std::string sha256(std::string_view data, const HashedBeginning& beginning = {});

}  // namespace kurbel
