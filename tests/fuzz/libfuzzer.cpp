// libfuzzer.cpp — the targets for libFuzzer, which goes where the code that an input reaches is new. KURBEL_FUZZ names
// the target; our mutator changes scenes by the table of keys, the library's own is taken now and then.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/fuzz/mutator.h"
#include "tests/fuzz/targets.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

const kurbel::fuzz::Target& target() {
  static const kurbel::fuzz::Target* const chosen = [] {
    const char* name = std::getenv("KURBEL_FUZZ");
    const kurbel::fuzz::Target* found = kurbel::fuzz::target_named(name ? name : "reader");
    if (!found) {
      fmt::print(stderr, "KURBEL_FUZZ={}: no such target\n", name);
      std::exit(2);
    }
    return found;
  }();
  return *chosen;
}

std::string text_of(const std::uint8_t* data, std::size_t size) { return {reinterpret_cast<const char*>(data), size}; }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string fault = target().judge(text_of(data, size));
  if (fault.empty()) return 0;
  fmt::print(stderr, "{}: {}\n", target().name, fault);
  std::abort();
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  kurbel::fuzz::Random random(seed);
  const bool is_scene = target().mutated == kurbel::fuzz::mutated_scene;
  if (random.chance(is_scene ? 0.1 : 0.5)) return LLVMFuzzerMutate(data, size, most);
  std::string text = target().mutated(text_of(data, size), random, target().style);
  text.resize(std::min(text.size(), most));
  std::memcpy(data, text.data(), text.size());
  return text.size();
}
