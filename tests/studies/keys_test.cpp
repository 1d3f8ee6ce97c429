// keys_test.cpp — the documents say what the reader does.
#include <fstream>
#include <sstream>

#include "studies/kinds.h"
#include "tests/support/scenes.h"

namespace kurbel {
namespace {

TEST(Documents, KeysAreThoseOfTheReader) {
  std::ifstream in(test::source_path("docs/keys.md"));
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), keys_in_markdown()) << "renew it: kurbel keys > docs/keys.md";
}

TEST(Documents, EveryFallbackIsWithinItsOwnDomain) {
  for (const Kind& kind : all_kinds())
    for (const Key& key : kind.keys) EXPECT_FALSE(key.doc.empty()) << kind.name << "." << key.name;
}

}  // namespace
}  // namespace kurbel
