// fuzz_test.cpp — the short part of the attack that scripts/fuzz goes on with: the same targets and inputs, from fixed
// numbers on and from one that the clock draws. It is printed; KURBEL_FUZZ_FROM=NUMBER repeats it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <utility>

#include "engine/scene/scene.h"
#include "studies/scenes/kinds.h"
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/seeds.h"
#include "tests/fuzz/targets.h"
#include "tests/fuzz/toml_text.h"

namespace kurbel::fuzz::fuzz_test {
namespace {

class Attack {
 public:
  explicit Attack(const char* target) : target_(target_named(target)) {}
  // From 1 on, and as many that nobody has seen.
  void expect_no_fault(std::uint64_t count) const {
    judge_all(1, count);
    const char* asked = std::getenv("KURBEL_FUZZ_FROM");
    const std::uint64_t drawn = asked ? std::strtoull(asked, nullptr, 10) : number_of_now();
    fmt::print("{}: {} inputs from {} on; KURBEL_FUZZ_FROM={} repeats them\n", target_->name, count, drawn, drawn);
    std::fflush(stdout);  // before one of them crashes
    judge_all(drawn, count);
  }

 private:
  void judge_all(std::uint64_t from, std::uint64_t count) const {
    for (std::uint64_t number = from; number < from + count; ++number) {
      const std::string input = input_of(*target_, number);
      EXPECT_EQ(target_->judge(input), "") << "kurbel_fuzz " << target_->name << " --from " << number << " --count 1";
    }
  }

  const Target* target_;
};

TEST(Fuzz, EveryTextIsReadOrRefusedWithAPlace) { Attack("reader").expect_no_fault(1200); }

TEST(Fuzz, EveryTableIsReadOrRefusedWithAPlace) { Attack("csv").expect_no_fault(3000); }

TEST(Fuzz, EveryWorkbookIsReadOrRefused) { Attack("xlsx").expect_no_fault(600); }

TEST(Fuzz, EveryMatFileIsReadOrRefused) { Attack("mat").expect_no_fault(2000); }

TEST(Fuzz, EveryMassElasticSheetBecomesASceneOrIsRefused) { Attack("sheet").expect_no_fault(800); }

TEST(Fuzz, EveryCheckpointAndSummaryIsUsedOrRefused) { Attack("json").expect_no_fault(800); }

TEST(Fuzz, EveryFormulaIsComputedOrRefusedWithAColumn) { Attack("formula").expect_no_fault(2000); }

TEST(Fuzz, EverySceneThatCanBeReadIsCompiledOrRefusedWithAPlace) { Attack("compile").expect_no_fault(1200); }

TEST(Fuzz, EveryMachineRunsOrSaysWhyNot) { Attack("run").expect_no_fault(25); }

TEST(Fuzz, EveryOtherVerbAnswersOrRefuses) { Attack("study").expect_no_fault(10); }

// What was found stays found: by every target, and every verb.
TEST(Fuzz, InputsThatCrashedAreAnswered) {
  EXPECT_FALSE(crashes().empty());
  for (const Seed& seed : crashes())
    for (const auto judge : {judge_reader, judge_compile, judge_run, judge_every_study})
      EXPECT_EQ(judge(seed.text), "") << seed.name;
}

// By their numbers: a checkpoint at 9.5e18 rad/s, and a gear between speeds whose ratio no two wheels have.
TEST(Fuzz, InputsThatWereFaultsAreAnswered) {
  for (const auto& [name, number] : {std::pair("json", 1795837502007077u), std::pair("sheet", 1795837442268982u)}) {
    const Target& target = *target_named(name);
    EXPECT_EQ(target.judge(input_of(target, number)), "") << name;
  }
}

// Each list of each example emptied, and each list key of each kind given as []: once by key and kind.
class EmptyLists {
 public:
  void judge(const Seed& seed) {
    name_ = seed.name;
    document_ = parse_toml(seed.text, "seed");
    visit(document_, "");
  }
  int judged() const { return static_cast<int>(seen_.size()); }

 private:
  using Type = DocumentValue::Type;

  static DocumentValue empty_list() {
    DocumentValue list;
    list.type = Type::list;
    return list;
  }
  void visit(DocumentValue& value, const std::string& owner) {
    for (DocumentValue& item : value.items) visit(item, owner);
    if (value.type != Type::table) return;
    const DocumentEntry* named = value.find("kind");
    const std::string kind = named ? named->value.text : owner;
    for (std::size_t i = 0; i < value.entries.size(); ++i) {
      const std::string key = value.entries[i].key;
      visit(value.entries[i].value, kind + "." + key);
      if (value.entries[i].value.type == Type::list && seen_.insert(kind + "." + key).second) {
        const DocumentValue before = std::exchange(value.entries[i].value, empty_list());
        judge_document(kind + "." + key);
        value.entries[i].value = before;
      }
    }
    for (const Kind& known : all_kinds())
      if (known.name == kind) add_lists(value, known);
  }
  void add_lists(DocumentValue& table, const Kind& kind) {
    for (const Key& key : kind.keys) {
      const bool list = key.type == KeyType::quantities || key.type == KeyType::integers;
      if (!(list || key.type == KeyType::sections) || table.find(key.name)) continue;
      if (!seen_.insert(kind.name + "." + key.name).second) continue;
      table.entries.push_back({key.name, {}, empty_list()});
      judge_document(kind.name + "." + key.name);
      table.entries.pop_back();
    }
  }
  void judge_document(const std::string& what) {
    EXPECT_EQ(judge_compile(toml_document(document_)), "") << name_ << ": " << what << " = []";
  }

  std::string name_;
  DocumentValue document_;
  std::set<std::string> seen_;
};

TEST(Fuzz, EveryListMayBeEmptyOrIsRefusedWithAPlace) {
  EmptyLists lists;
  for (const Seed& seed : good_scenes()) lists.judge(seed);
  EXPECT_GT(lists.judged(), 60);
}

// The mutator writes trees as TOML: of every example the same machine.
TEST(Fuzz, ASceneWrittenFromItsTreeIsTheSameScene) {
  for (const Seed& seed : good_scenes()) {
    const std::string again = toml_document(parse_toml(seed.text, "seed"));
    EXPECT_EQ(toml_document(parse_toml(again, "again")), again) << seed.name;
    EXPECT_EQ(judge_reader(again), "") << seed.name;
    EXPECT_NO_THROW(parse_scene(again, scene_path(), all_kinds())) << seed.name;
  }
}

// Mutations neither leave all scenes valid nor break all of them: both paths are taken.
TEST(Fuzz, SomeInputsAreValidAndSomeAreNot) {
  int valid = 0;
  constexpr int n = 200;
  for (std::uint64_t number = 1; number <= n; ++number) try {
      parse_scene(input_of(*target_named("run"), number), scene_path(), all_kinds());
      ++valid;
    } catch (const SceneError&) {
    }
  EXPECT_GT(valid, n / 10);
  EXPECT_LT(valid, n * 9 / 10);
}

// What the judges must not let pass.
TEST(Fuzz, AMessageBehindTheEndOfItsLineIsAFault) {
  EXPECT_EQ(judge_reader(""), "");
  EXPECT_EQ(judge_reader("line = [\"\xBF"), "");
  EXPECT_EQ(judge_csv("\"1,2\n"), "");
}

}  // namespace
}  // namespace kurbel::fuzz::fuzz_test
