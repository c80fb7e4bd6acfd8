// What surrounds a run: log, progress, manifest, signals.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "io/build_info.h"
#include "io/files.h"
#include "io/log.h"
#include "io/manifest.h"
#include "io/progress.h"
#include "io/signals.h"
#include "scratch.h"

namespace pseudorigid::io::test {
namespace {

using ::testing::internal::CaptureStderr;
using ::testing::internal::GetCapturedStderr;

std::string said(Verbosity verbosity, const std::optional<std::filesystem::path>& file, bool append = false) {
  CaptureStderr();
  const auto logger = make_logger(verbosity, file, append);
  logger->debug("details");
  logger->info("news");
  logger->warn("caution");
  logger->error("trouble");
  return GetCapturedStderr();
}

TEST(Log, TheTerminalHearsWhatItAskedFor) {
  EXPECT_EQ(said(Verbosity::verbose, {}), "details\nnews\nwarning: caution\nerror: trouble\n");
  EXPECT_EQ(said(Verbosity::normal, {}), "news\nwarning: caution\nerror: trouble\n");
  EXPECT_EQ(said(Verbosity::quiet, {}), "warning: caution\nerror: trouble\n");
  EXPECT_EQ(said(Verbosity::silent, {}), "");
}

TEST(Log, TheFileHearsEverythingWithTimestamps) {
  const ScratchDirectory scratch;
  said(Verbosity::quiet, scratch / "log.txt");
  const std::string text = contents(scratch / "log.txt");
  EXPECT_NE(text.find("debug   details\n"), text.npos) << text;
  EXPECT_NE(text.find("info    news\n"), text.npos) << text;
  int year, month, day, hour, minute, second;
  EXPECT_EQ(std::sscanf(text.c_str(), "%d-%d-%d %d:%d:%d", &year, &month, &day, &hour, &minute, &second), 6) << text;
}

TEST(Log, AResumedRunContinuesTheFileAndAFreshOneDoesNot) {
  const ScratchDirectory scratch;
  const auto n_lines = [&] { return std::ranges::count(contents(scratch / "log.txt"), '\n'); };
  said(Verbosity::silent, scratch / "log.txt");
  EXPECT_EQ(n_lines(), 4);
  said(Verbosity::silent, scratch / "log.txt", true);
  EXPECT_EQ(n_lines(), 8);
  said(Verbosity::silent, scratch / "log.txt");
  EXPECT_EQ(n_lines(), 4);
}

TEST(Log, AnImpossibleFileIsAWriteErrorAndAFullOneIsSilent) {
  const ScratchDirectory scratch;
  put(scratch / "file", "");
  EXPECT_THROW(make_logger(Verbosity::quiet, scratch / "file/log.txt"), WriteError);
  EXPECT_EQ(said(Verbosity::silent, "/dev/full"), "");
}

TEST(Progress, SaysFractionRateAndTimeLeft) {
  EXPECT_EQ(progress_text(0.42, 123456, 180), " 42 %  1.23e+05 steps/s  3 min left");
  EXPECT_EQ(progress_text(1, 2, 7), "100 %  2 steps/s  7 s left");
  EXPECT_EQ(progress_text(0, 2, 9000), "  0 %  2 steps/s  2.5 h left");
}

/// Runs a loop of the given pace for a while; what it drew.
std::string drawn(bool enabled, std::chrono::microseconds pause, double first_fraction = 0) {
  CaptureStderr();
  {
    Progress progress("reduced", enabled);
    const auto start = std::chrono::steady_clock::now();
    double elapsed = 0;
    while (elapsed < 0.5) {
      if (pause.count() > 0) std::this_thread::sleep_for(pause);
      elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      progress.step(first_fraction + (1 - first_fraction) * elapsed);
    }
  }
  return GetCapturedStderr();
}

TEST(Progress, DrawsNowAndThenAndClearsItsLine) {
  for (const auto pause : {std::chrono::microseconds(0), std::chrono::microseconds(20000)}) {
    const std::string text = drawn(true, pause);
    const auto n_draws = std::ranges::count(text, '%');
    EXPECT_GE(n_draws, 1) << text;
    EXPECT_LE(n_draws, 3) << text;
    EXPECT_TRUE(text.starts_with("\rreduced   ")) << text;
    EXPECT_TRUE(text.ends_with("\r\033[K"));
  }
  EXPECT_NE(drawn(true, std::chrono::microseconds(1000), 0.9).find("reduced   9"), std::string::npos);
}

TEST(Progress, SaysNothingInAPipe) {
  EXPECT_EQ(drawn(false, std::chrono::microseconds(0)), "");
  CaptureStderr();
  EXPECT_FALSE(Progress::stderr_is_terminal());
  GetCapturedStderr();
}

nlohmann::json manifest_in(const ScratchDirectory& scratch) {
  return nlohmann::json::parse(contents(scratch / "manifest.json"));
}

Manifest titled(const std::string& title) {
  Manifest manifest;
  manifest.title = title;
  return manifest;
}

TEST(Manifest, TellsWhatRanAndHowItEnded) {
  const ScratchDirectory scratch;
  Manifest content;
  content.build = build_info();
  content.command = {"pseudorigid", "run", "a.prm"};
  content.title = "A \"quoted\" title that is not UTF-8: \xff";
  content.libraries = {{"Eigen", "3.4.0"}};
  content.entries = {{"Time/End", "10"}, {"Body/Radius", "0.5"}};
  ManifestFile file(scratch / "manifest.json", content);
  EXPECT_EQ(manifest_in(scratch)["state"], "running");
  EXPECT_FALSE(manifest_in(scratch).contains("end"));
  file.content().models["reduced"].counters["steps"] = 1e6;
  file.content().models["reduced"].timers["stepping"] = 0.25;
  file.finish(mechanics::Outcome::finished, 0);
  const auto json = manifest_in(scratch);
  EXPECT_EQ(json["state"], "done");
  EXPECT_EQ(json["exit_code"], 0);
  EXPECT_EQ(json["models"]["reduced"]["counters"]["steps"], 1000000);
  EXPECT_EQ(json["models"]["reduced"]["timers"]["stepping"], 0.25);
  EXPECT_EQ(json["libraries"]["Eigen"], "3.4.0");
  EXPECT_EQ(json["command"][2], "a.prm");
  EXPECT_EQ(json["entries"]["Body/Radius"], "0.5");
  for (const char* name : {"version", "git_hash", "compiler", "flags", "cpu", "start", "end", "wall_seconds"})
    EXPECT_TRUE(json.contains(name)) << name;
  EXPECT_GT(json["peak_memory_bytes"], 1 << 20);
  EXPECT_LT(json["peak_memory_bytes"], std::int64_t{1} << 40);
  EXPECT_FALSE(json["cpu"].get<std::string>().empty());
}

TEST(Manifest, AnExceptionLeavesOneThatSaysFailed) {
  const ScratchDirectory scratch;
  try {
    ManifestFile file(scratch / "manifest.json", {});
    throw std::runtime_error("step failed");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(manifest_in(scratch)["state"], "failed");
  ManifestFile(scratch / "manifest.json", {}).finish(mechanics::Outcome::failed, 3, "det F = -0.1");
  EXPECT_EQ(manifest_in(scratch)["message"], "det F = -0.1");
  EXPECT_EQ(manifest_in(scratch)["exit_code"], 3);
}

TEST(Manifest, WithoutRoomForANewFileTheOldOneSaysFailed) {
  const ScratchDirectory scratch;
  ManifestFile file(scratch / "manifest.json", titled("\"state\": \"running\""));
  std::filesystem::create_directory(scratch / "manifest.json.partial");
  EXPECT_THROW(file.finish(mechanics::Outcome::interrupted, 3), WriteError);
  EXPECT_EQ(manifest_in(scratch)["state"], "failed");
  EXPECT_EQ(manifest_in(scratch)["title"], "\"state\": \"running\"");
}

TEST(Manifest, AnotherProcessCanNoteTheFailure) {
  const ScratchDirectory scratch;
  note_failure(scratch / "manifest.json", 3, "no memory");
  EXPECT_FALSE(std::filesystem::exists(scratch / "manifest.json"));
  const ManifestFile file(scratch / "manifest.json", titled("a"));
  note_failure(scratch / "manifest.json", 3, "no memory");
  const auto json = manifest_in(scratch);
  EXPECT_EQ(json["state"], "failed");
  EXPECT_EQ(json["exit_code"], 3);
  EXPECT_EQ(json["message"], "no memory");
  EXPECT_EQ(json["title"], "a");
}

TEST(Manifest, BuildInfoIsFilledIn) {
  EXPECT_FALSE(build_info().version.empty());
  EXPECT_FALSE(build_info().compiler.empty());
  EXPECT_FALSE(build_info().build_type.empty());
  EXPECT_TRUE(build_info().git_hash == "unknown" || build_info().git_hash.size() >= 40);
}

void raise_twice(int signal) {
  install_signal_handlers();
  if (interrupt_requested()) std::_Exit(10);
  std::raise(signal);
  if (!interrupt_requested()) std::_Exit(11);
  std::raise(signal);
}

TEST(SignalsDeathTest, TheFirstIsAFlagAndTheSecondKills) {
  for (const int signal : {SIGINT, SIGTERM}) EXPECT_EXIT(raise_twice(signal), ::testing::KilledBySignal(signal), "");
}

/// Exit code 0 if the signal is a request as often as it comes.
void raise_often(int signal) {
  install_signal_handlers();
  for (int i = 0; i < 3; ++i) std::raise(signal);
  std::_Exit(interrupt_requested() ? 0 : 11);
}

TEST(SignalsDeathTest, AConnectionThatIsGoneAndALimitOfTimeAreRequestsToStop) {
  for (const int signal : {SIGHUP, SIGXCPU}) EXPECT_EXIT(raise_often(signal), ::testing::ExitedWithCode(0), "");
}

/// Exit code 11 if the signal changes nothing.
void raise_ignored(int signal) {
  std::signal(SIGHUP, SIG_IGN);
  raise_often(signal);
}

TEST(SignalsDeathTest, NohupAndPipesWithoutReader) {
  for (const int signal : {SIGHUP, SIGPIPE}) EXPECT_EXIT(raise_ignored(signal), ::testing::ExitedWithCode(11), "");
}

/// Exit code 0 if a file that may not grow gives a WriteError.
void write_beyond_limit(const std::filesystem::path& path) {
  install_signal_handlers();
  const rlimit limit{10, 10};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  try {
    write_file_atomically(path, {std::string(100, 'x')});
  } catch (const WriteError& error) {
    std::_Exit(error.error_number == EFBIG ? 0 : 12);
  }
  std::_Exit(13);
}

TEST(SignalsDeathTest, AFileSizeLimitBecomesAWriteError) {
  const ScratchDirectory scratch;
  EXPECT_EXIT(write_beyond_limit(scratch / "a"), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace pseudorigid::io::test
