// keys_test.cpp — the documents say what the reader does.
#include <fstream>
#include <sstream>

#include "studies/scenes/kinds.h"
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

// The scene on the first screen of README.md runs as it stands.
TEST(Documents, SceneOfTheReadmeRuns) {
  std::ifstream in(test::source_path("README.md"));
  std::stringstream text;
  text << in.rdbuf();
  const std::string readme = text.str();
  const std::size_t begin = readme.find("```toml\n") + 8;
  const Result r = test::run(readme.substr(begin, readme.find("```", begin) - begin));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_TRUE(r.accuracy_confirmed);
  EXPECT_GT(test::figure(r, "peak_torque.main_coupling"), 1000);
}

}  // namespace
}  // namespace kurbel
