#include "io/run_directory.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <set>

#include "io/files.h"
#include "scene/user_error.h"
#include "scratch.h"

namespace pseudorigid::io::test {
namespace {

/// Models as the program has them.
const std::vector<std::string> movers{"reduced", "continuum"};

namespace fs = std::filesystem;

std::set<std::string> tree(const fs::path& directory) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    names.insert(entry.path().lexically_relative(directory).native());
  return names;
}

TEST(RunDirectory, IsNamedAfterTheSceneOrAsAsked) {
  EXPECT_EQ(RunDirectory("output", "params/stretch.prm", {}).path(), "output/stretch");
  EXPECT_EQ(RunDirectory("output", "params/v1.2.prm", {}).path(), "output/v1.2");
  EXPECT_EQ(RunDirectory("output", "scene.txt", {}).path(), "output/scene.txt");
  EXPECT_EQ(RunDirectory("output", "params/stretch.prm", "here/there").path(), "here/there");
}

TEST(RunDirectory, ConstructionTouchesNothing) {
  const ScratchDirectory scratch;
  const RunDirectory directory(scratch / "out", "a.prm", {});
  EXPECT_EQ(directory.csv("reduced"), scratch / "out/a/reduced.csv");
  EXPECT_EQ(directory.frame("continuum", 12), scratch / "out/a/graphics/continuum-000012.vtu");
  EXPECT_EQ(directory.checkpoint("reduced"), scratch / "out/a/checkpoint-reduced.bin");
  EXPECT_TRUE(tree(scratch.path()).empty());
}

TEST(RunDirectory, FreshRunRemovesOurResultsAndNothingElse) {
  const ScratchDirectory scratch;
  const RunDirectory directory(scratch / "out");
  directory.prepare_fresh(movers);
  directory.prepare_graphics();
  for (const auto& path :
       {directory.used_prm(), directory.manifest(), directory.log(), directory.report(), directory.comparison_json(),
        directory.csv("reduced"), directory.csv("continuum"), directory.csv("comparison"), directory.csv("modes"),
        directory.pvd("reduced"), directory.pvd("continuum"), directory.checkpoint("reduced"),
        directory.checkpoint("continuum"), directory.frame("reduced", 0), directory.frame("continuum", 999999),
        fs::path(directory.csv("reduced").native() + ".partial")})
    put(path, "ours");
  const std::set<std::string> foreign{"notes.txt",      "mine.csv",          "scene.prm",
                                      "checkpoint.bin", "graphics/mine.vtu", "graphics/reduced.png",
                                      "modes.csv.bak"};
  for (const std::string& name : foreign) put(directory.path() / name, "mine");
  fs::create_directories(directory.path() / "comparison.csv.d");
  directory.prepare_fresh(movers);
  std::set<std::string> expected = foreign;
  expected.insert({"graphics", "comparison.csv.d"});
  EXPECT_EQ(tree(directory.path()), expected);
}

TEST(RunDirectory, FreshRunRemovesAnEmptiedGraphicsFolder) {
  const ScratchDirectory scratch;
  const RunDirectory directory(scratch / "out");
  directory.prepare_fresh(movers);
  directory.prepare_graphics();
  put(directory.frame("reduced", 1), "");
  directory.prepare_fresh(movers);
  EXPECT_TRUE(tree(directory.path()).empty());
}

TEST(RunDirectory, ALinkIsRemovedAndItsTargetKept) {
  const ScratchDirectory scratch;
  const RunDirectory directory(scratch / "out");
  directory.prepare_fresh(movers);
  put(scratch / "precious.csv", "mine");
  fs::create_symlink(scratch / "precious.csv", directory.csv("reduced"));
  directory.prepare_fresh(movers);
  EXPECT_EQ(contents(scratch / "precious.csv"), "mine");
  EXPECT_TRUE(tree(directory.path()).empty());
}

TEST(RunDirectory, AnImpossibleFolderIsAUserErrorWithPathAndReason) {
  const ScratchDirectory scratch;
  put(scratch / "file", "");
  const RunDirectory below_file(scratch / "file/out"), in_proc("/proc/pseudorigid-test");
  const auto message = message_of<UserError>([&] { below_file.prepare_fresh(movers); });
  EXPECT_NE(message.find("file/out': Not a directory"), message.npos) << message;
  EXPECT_THROW(RunDirectory(scratch / "file").prepare_fresh(movers), UserError);
  EXPECT_THROW(in_proc.prepare_fresh(movers), UserError);
}

/// Root may write everywhere, so a process of its own steps down to nobody first. Says the message on stderr.
[[noreturn]] void prepare_as_nobody(const fs::path& path) {
  if (::geteuid() == 0 && ::setuid(65534) != 0) std::_Exit(10);
  std::fputs(message_of<UserError>([&] { RunDirectory(path).prepare_fresh(movers); }).c_str(), stderr);
  std::_Exit(0);
}

TEST(RunDirectoryDeathTest, AReadOnlyFolderIsAUserError) {
  const ScratchDirectory scratch;
  fs::permissions(scratch.path(), fs::perms(0555));
  EXPECT_EXIT(prepare_as_nobody(scratch.path()), ::testing::ExitedWithCode(0), "cannot write to .*Permission denied");
  EXPECT_EXIT(prepare_as_nobody(scratch / "new"), ::testing::ExitedWithCode(0), "cannot create .*Permission denied");
  fs::permissions(scratch.path(), fs::perms::owner_all);
}

TEST(RunDirectory, ResumeWantsACheckpointAndRemovesNothing) {
  const ScratchDirectory scratch;
  const RunDirectory directory(scratch / "out");
  EXPECT_THROW(directory.prepare_resume(), UserError);
  directory.prepare_fresh(movers);
  put(directory.csv("reduced"), "ours");
  const auto message = message_of<UserError>([&] { directory.prepare_resume(); });
  EXPECT_NE(message.find("nothing to resume"), message.npos) << message;
  put(directory.checkpoint("reduced"), "ours");
  directory.prepare_resume();
  EXPECT_EQ(tree(directory.path()), (std::set<std::string>{"reduced.csv", "checkpoint-reduced.bin"}));
}

TEST(RunLock, BelongsToOneAtATime) {
  const ScratchDirectory scratch;
  const RunDirectory directory(scratch / "out");
  {
    const RunLock lock = directory.prepare_fresh(movers);
    put(directory.csv("reduced"), "ours");
    const auto message = message_of<UserError>([&] { directory.prepare_fresh(movers); });
    EXPECT_NE(message.find("another run is at work in the output directory"), message.npos) << message;
    put(directory.checkpoint("reduced"), "ours");
    EXPECT_THROW(directory.prepare_resume(), UserError);
    EXPECT_EQ(tree(directory.path()), (std::set<std::string>{"reduced.csv", "checkpoint-reduced.bin", "run.lock"}));
  }
  EXPECT_EQ(tree(directory.path()), (std::set<std::string>{"reduced.csv", "checkpoint-reduced.bin"}));
  directory.prepare_resume();
}

TEST(RunLock, IsNotRemovedWhereItIsAnothers) {
  const ScratchDirectory scratch;
  {
    const RunLock lock(scratch.path());
    put(scratch / "run.lock", "host: elsewhere\n");  // after the user has removed ours
  }
  EXPECT_EQ(contents(scratch / "run.lock"), "host: elsewhere\n");
  RunLock::remove(scratch.path());
  EXPECT_TRUE(tree(scratch.path()).empty());
}

TEST(RunLock, AFullDiskLeavesNothingBehind) {
  const ScratchDirectory scratch;
  {
    const FileSizeLimit full(10);
    EXPECT_THROW(RunLock(scratch.path()), WriteError);
  }
  EXPECT_TRUE(tree(scratch.path()).empty());
}

TEST(RunLock, OneThatWasNeverTakenIsCleared) {
  const ScratchDirectory scratch;
  put(scratch / "run.lock-host-12.partial", "");
  RunDirectory(scratch.path()).prepare_fresh(movers);
  EXPECT_TRUE(tree(scratch.path()).empty());
}

TEST(Files, AtomicReplacementKeepsTheOldFileWhenItFails) {
  const ScratchDirectory scratch;
  write_file_atomically(scratch / "a", {"one ", "two"});
  EXPECT_EQ(read_file(scratch / "a"), "one two");
  {
    const FileSizeLimit full(10);
    EXPECT_THROW(write_file_atomically(scratch / "a", {std::string(100, 'x')}), WriteError);
  }
  EXPECT_EQ(read_file(scratch / "a"), "one two");
  EXPECT_EQ(tree(scratch.path()), std::set<std::string>{"a"});
  EXPECT_THROW(write_file_atomically(scratch / "none/a", {}), WriteError);
  fs::create_directory(scratch / "folder");
  EXPECT_THROW(write_file_atomically(scratch / "folder", {"x"}), WriteError);
  EXPECT_EQ(tree(scratch.path()), (std::set<std::string>{"a", "folder"}));
}

}  // namespace
}  // namespace pseudorigid::io::test
