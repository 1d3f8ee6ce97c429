// result_set_test.cpp — results are whole or not there; what is not kurbel's is never lost; who was killed leaves
// nothing.
#include "studies/files/result_set.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <set>
#include <thread>

#include "studies/files/clear_away.h"
#include "studies/files/sha256.h"
#include "studies/files/whole_file.h"
#include "studies/report/write_output.h"
#include "tests/support/files.h"

namespace kurbel::result_set_test {
namespace {

namespace fs = std::filesystem;

using test::text_of;

void write_text(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

class ResultSetTest : public testing::TestWithParam<bool> {
 protected:
  // Two files of one run.
  void put(const std::string& run, const std::string& out = "out") {
    ResultSet set(folder_ / out);
    if (!GetParam()) set.do_without_exchange();
    set.add("a.txt", run);
    set.add("plots/b.txt", run);
    set.put_in_place("test " + run, true);
  }
  void expect_run(const std::string& run) {
    EXPECT_EQ(text_of(folder_ / "out/a.txt"), run);
    EXPECT_EQ(text_of(folder_ / "out/plots/b.txt"), run);
    const std::string manifest = text_of(folder_ / "out" / manifest_name);
    EXPECT_NE(manifest.find(sha256(run) + "  a.txt\n"), std::string::npos) << manifest;
    EXPECT_NE(manifest.find(sha256(run) + "  plots/b.txt\n"), std::string::npos) << manifest;
  }

  const test::ScratchFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Exchange, ResultSetTest, testing::Bool());
using ResultSetOnce = ResultSetTest;
INSTANTIATE_TEST_SUITE_P(Once, ResultSetOnce, testing::Values(true));

TEST_P(ResultSetTest, IsThereWholeAndNotBefore) {
  {
    ResultSet set(folder_ / "deeper/out");
    set.add("a.txt", "1");
    EXPECT_FALSE(fs::exists(folder_ / "deeper/out"));
  }
  EXPECT_TRUE(names_in(folder_ / "deeper").empty()) << "what was not put in place is gone";
  put("first");
  expect_run("first");
  put("second");
  expect_run("second");
  EXPECT_EQ(names_in(folder_ / "out"), (std::set<std::string>{"a.txt", "plots", manifest_name}));
  EXPECT_EQ(names_in(folder_), (std::set<std::string>{"deeper", "out"}));
}

TEST_P(ResultSetTest, TakesOverWhatIsNotKurbels) {
  put("first");
  write_text(folder_ / "out/notes.txt", "mine");
  write_text(folder_ / "out/plots/drawing.txt", "mine");
  fs::create_directories(folder_ / "out/photos/2026");
  write_text(folder_ / "out/photos/2026/press.jpg", "mine");
  fs::create_symlink("/etc", folder_ / "out/link");
  put("second");
  expect_run("second");
  EXPECT_EQ(text_of(folder_ / "out/notes.txt"), "mine");
  EXPECT_EQ(text_of(folder_ / "out/plots/drawing.txt"), "mine");
  EXPECT_EQ(text_of(folder_ / "out/photos/2026/press.jpg"), "mine");
  EXPECT_EQ(fs::read_symlink(folder_ / "out/link"), "/etc");
  EXPECT_EQ(names_in(folder_), std::set<std::string>{"out"});
}

TEST_P(ResultSetTest, FileOfANameThatTheNewSetHasIsKeptUnderAnother) {
  {
    ResultSet set(folder_ / "out");
    set.add("c.txt", "first");
    set.put_in_place("test", true);
  }
  write_text(folder_ / "out/a.txt", "mine");
  put("second");
  expect_run("second");
  EXPECT_EQ(text_of(folder_ / "out/a.txt.kept-1"), "mine");
  EXPECT_FALSE(fs::exists(folder_ / "out/c.txt"));
}

TEST_P(ResultSetTest, EmptyFolderIsTakenAndItsModeKept) {
  fs::create_directories(folder_ / "out");
  fs::permissions(folder_ / "out", fs::perms(0770));
  EXPECT_EQ(why_no_results_in(folder_ / "out"), "");
  put("first");
  expect_run("first");
  EXPECT_EQ(fs::status(folder_ / "out").permissions(), fs::perms(0770));
}

TEST_P(ResultSetTest, ManyWritersNeverFailAndOneOfThemStands) {
  put("first");
  std::vector<std::thread> writers;
  std::atomic<int> failed = 0;
  for (int w = 0; w < 4; ++w)
    writers.emplace_back([&, w] {
      for (int i = 0; i < 25; ++i) try {
          put(std::to_string(w) + "." + std::to_string(i));
        } catch (const std::exception& error) {
          if (++failed == 1) ADD_FAILURE() << error.what();
        }
    });
  // Whoever holds the folder open reads one run.
  for (int i = 0; i < 200; ++i) {
    const Descriptor folder = open_folder(AT_FDCWD, folder_ / "out");
    if (!folder) continue;
    const std::string a = text_of_file(folder.get(), "a.txt", 100), b = text_of_file(folder.get(), "plots/b.txt", 100);
    EXPECT_TRUE(a.empty() || b.empty() || a == b) << a << " beside " << b;
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(failed, 0);
  expect_run(text_of(folder_ / "out/a.txt"));
  EXPECT_EQ(names_in(folder_), std::set<std::string>{"out"});
}

TEST_P(ResultSetOnce, FolderOfOtherThingsIsRefusedWithANextStep) {
  fs::create_directories(folder_ / "mine");
  write_text(folder_ / "mine/thesis.txt", "years of work");
  const std::string why = why_no_results_in(folder_ / "mine");
  EXPECT_NE(why.find("holds files that are not of a result set of kurbel (\"thesis.txt\" …)"), std::string::npos)
      << why;
  EXPECT_NE(why.find("mine/results"), std::string::npos) << why;
  EXPECT_EQ(why_no_results_in(folder_ / "mine/results"), "");
  ResultSet set(folder_ / "mine");
  set.add("a.txt", "1");
  EXPECT_THROW(set.put_in_place("test", true), std::runtime_error) << "nor when it filled while the run went on";
  EXPECT_EQ(text_of(folder_ / "mine/thesis.txt"), "years of work");
}

TEST_P(ResultSetOnce, PlacesThatCannotChangePlacesAreRefused) {
  write_text(folder_ / "file", "");
  fs::create_symlink("nowhere", folder_ / "dangling");
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  const std::string here = why_no_results_in("."), above = why_no_results_in(".."), root = why_no_results_in("/");
  fs::current_path(before);
  EXPECT_NE(here.find("is the folder that you are in"), std::string::npos) << here;
  EXPECT_NE(above.find("is the folder that you are in, or holds it"), std::string::npos) << above;
  EXPECT_FALSE(root.empty());
  EXPECT_NE(why_no_results_in(folder_ / "file").find("is a file; give a folder"), std::string::npos);
  EXPECT_NE(why_no_results_in(folder_ / "file/deeper").find("is a file; give a folder"), std::string::npos);
  EXPECT_NE(why_no_results_in(folder_ / "dangling").find("is a link that leads nowhere"), std::string::npos);
  EXPECT_NE(why_no_results_in("/dev/shm").find("is where a file system is mounted"), std::string::npos);
  EXPECT_NE(why_no_results_in(folder_ / std::string(250, 'x')).find("longer than"), std::string::npos);
}

TEST_P(ResultSetOnce, LinkToAFolderIsFollowed) {
  fs::create_directories(folder_ / "disk");
  fs::create_directory_symlink("disk/press", folder_ / "out");
  fs::create_directories(folder_ / "disk/press");
  put("first");
  put("second");
  expect_run("second");
  EXPECT_TRUE(fs::is_symlink(folder_ / "out"));
  EXPECT_EQ(names_in(folder_ / "disk"), std::set<std::string>{"press"});
}

TEST_P(ResultSetOnce, NextRunClearsAwayWhatTheDeadLeftAndNothingOfTheLiving) {
  put("first");
  ResultSet living(folder_ / "other");
  living.add("a.txt", "1");
  const pid_t killed = fork();
  if (killed == 0) {
    ResultSet set(folder_ / "out");
    set.add("plots/half.txt", "half");
    raise(SIGKILL);
  }
  waitpid(killed, nullptr, 0);
  EXPECT_EQ(names_in(folder_).size(), 3u);
  put("second");
  expect_run("second");
  EXPECT_EQ(names_in(folder_).size(), 2u) << "the set of the living one stands";
  living.put_in_place("test", true);
  EXPECT_EQ(names_in(folder_), (std::set<std::string>{"other", "out"}));
}

// What `kill −9` leaves at each step of an exchange, by hand.
TEST_P(ResultSetOnce, KilledJustAfterTheExchangeLosesNoFileThatIsNotKurbels) {
  put("first");
  write_text(folder_ / "out/notes.txt", "mine");
  fs::rename(folder_ / "out", folder_ / ".out.kurbel-new-0123456789ab");
  {
    ResultSet set(folder_ / "elsewhere");  // clears away; without a target the user's file stays where it is
  }
  EXPECT_EQ(text_of(folder_ / ".out.kurbel-new-0123456789ab/notes.txt"), "mine");
  put("second");
  put("third");
  expect_run("third");
  EXPECT_EQ(text_of(folder_ / "out/notes.txt"), "mine");
  EXPECT_EQ(names_in(folder_), std::set<std::string>{"out"});
}

TEST_P(ResultSetOnce, KilledBetweenTwoMovesLosesNothing) {
  put("first");
  fs::rename(folder_ / "out", folder_ / ".out.kurbel-old-0123456789ab");
  const Descriptor folder = open_folder(AT_FDCWD, folder_.string());
  clear_abandoned(folder.get());
  expect_run("first");
  EXPECT_EQ(names_in(folder_), std::set<std::string>{"out"});
}

TEST_P(ResultSetOnce, OnlyStagedNamesAreClearedAway) {
  for (const char* name : {".out.kurbel-new-", ".out.kurbel-new-0123456789aX", "out.kurbel-new-0123456789ab", ".kurbel",
                           ".kurbel-new-0123456789ab", ".out.part"})
    fs::create_directories(folder_ / name / "x");
  put("first");
  EXPECT_EQ(names_in(folder_).size(), 7u);
}

TEST_P(ResultSetOnce, LongNamesOfFilesAreShortened) {
  ResultSet set(folder_ / "out");
  set.add(std::string(400, 'g') + ".wheel1.csv", "1");
  set.add(std::string(400, 'g') + ".wheel2.csv", "2");
  set.put_in_place("test", true);
  EXPECT_EQ(names_in(folder_ / "out").size(), 3u);
}

using WholeFile = ResultSetTest;
INSTANTIATE_TEST_SUITE_P(Once, WholeFile, testing::Values(true));

TEST_P(WholeFile, ReplacesALinkAndNotWhatItNames) {
  write_text(folder_ / "victim", "precious");
  fs::create_symlink("victim", folder_ / "lean.toml");
  for (const char* guess : {"lean.toml.part", "lean.toml.tmp", ".lean.toml.part"})
    fs::create_symlink("victim", folder_ / guess);
  EXPECT_TRUE(write_whole(folder_ / "lean.toml", "new"));
  EXPECT_EQ(text_of(folder_ / "lean.toml"), "new");
  EXPECT_FALSE(fs::is_symlink(folder_ / "lean.toml"));
  EXPECT_EQ(text_of(folder_ / "victim"), "precious");
}

TEST_P(WholeFile, IsKeptWhereItIsToBeKept) {
  EXPECT_TRUE(write_whole(folder_ / "new.toml", "first", Existing::keep));
  EXPECT_FALSE(write_whole(folder_ / "new.toml", "second", Existing::keep));
  EXPECT_EQ(text_of(folder_ / "new.toml"), "first");
  EXPECT_EQ(names_in(folder_), std::set<std::string>{"new.toml"});
}

TEST_P(WholeFile, NothingButARegularFileIsReplaced) {
  fs::create_directories(folder_ / "folder");
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/null", folder_ / "null");
  for (const char* name : {"folder", "pipe", "null", "absent/x", "."})
    EXPECT_THROW(write_whole(folder_ / name, "x"), std::invalid_argument) << name;
  EXPECT_TRUE(fs::is_symlink(folder_ / "null"));
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
}

TEST(Sha256, OfFips180AndOfEveryLengthAroundABlock) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  std::set<std::string> different;
  for (std::size_t n = 0; n < 200; ++n) different.insert(sha256(std::string(n, '\0')));
  EXPECT_EQ(different.size(), 200u);
}

// The hash of a page goes on from the state behind what all pages share, which was hashed when kurbel was built.
TEST(Sha256, OfAPageInTheManifestIsThatOfTheWholeFile) {
  const test::ScratchFolder folder;
  for (const char* title : {"", "Press"}) {
    StudyOutput output;
    output.title = title;
    const fs::path out = folder / "out";
    write_output(output, out);
    EXPECT_NE(text_of(out / manifest_name).find(sha256(text_of(out / "report.html")) + "  report.html\n"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace kurbel::result_set_test
