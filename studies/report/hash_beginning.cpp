// hash_beginning.cpp — hashes, while kurbel is built, the beginning that all pages share: what stands before the title, above
// all Plotly.js, as far as it fills blocks of SHA-256. Writes its length and the state behind it.
#define OPENSSL_API_COMPAT 0x10100000L  // the functions of 3.0 and later do not show their state
#include <openssl/sha.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

namespace {

std::string text_of(const char* path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

// Arguments: page.html, page.css, Plotly.js.
int main(int count, char** path) {
  if (count != 4) return 1;
  std::string page = text_of(path[1]);
  for (const auto& [name, file] : {std::pair("{{css}}", path[2]), std::pair("{{plotly}}", path[3])})
    page.replace(page.find(name), std::string(name).size(), text_of(file));
  const std::size_t bytes = page.find("{{title}}") / SHA256_CBLOCK * SHA256_CBLOCK;
  SHA256_CTX context;
  SHA256_Init(&context);
  SHA256_Update(&context, page.data(), bytes);
  std::printf("{%zu, {", bytes);
  for (const auto word : context.h) std::printf("0x%08xu, ", word);
  std::printf("}}\n");
}
