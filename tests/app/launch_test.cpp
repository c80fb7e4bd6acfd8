// What launchers leave in the environment, and what an exception means for the exit code.

#include "app/ranks/launch.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "app/ranks/failure.h"
#include "app/ranks/on_all_ranks.h"
#include "io/files.h"
#include "scene/user_error.h"

namespace pseudorigid::app::test {
namespace {

/// The launch of a process with these variables and no others of a launcher.
Launch launch_with(const std::map<std::string, std::string>& variables) {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMI_SIZE", "PMIX_RANK",
                           "SLURM_PROCID", "SLURM_NTASKS", "SLURM_STEP_NUM_TASKS", "SLURM_STEP_ID"})
    ::unsetenv(name);
  for (const auto& [name, value] : variables) ::setenv(name.c_str(), value.c_str(), 1);
  return {};
}

void expect(const Launch& launch, int rank, int n_ranks) {
  EXPECT_EQ(launch.rank, rank);
  EXPECT_EQ(launch.n_ranks, n_ranks);
}

TEST(Launch, OneProcess) { expect(launch_with({}), 0, 1); }

TEST(Launch, OpenMpi) {
  expect(launch_with({{"OMPI_COMM_WORLD_RANK", "3"}, {"OMPI_COMM_WORLD_SIZE", "4"}, {"PMIX_RANK", "3"}}), 3, 4);
  // Within a job of Slurm, whose variables are those of the daemon that mpirun has started.
  expect(launch_with({{"OMPI_COMM_WORLD_RANK", "3"},
                      {"OMPI_COMM_WORLD_SIZE", "4"},
                      {"PMIX_RANK", "3"},
                      {"SLURM_PROCID", "1"},
                      {"SLURM_STEP_NUM_TASKS", "2"}}),
         3, 4);
}

TEST(Launch, MpichAndSlurmWithPmi2) {
  expect(launch_with({{"PMI_RANK", "2"}, {"PMI_SIZE", "8"}, {"SLURM_PROCID", "2"}, {"SLURM_STEP_NUM_TASKS", "8"}}), 2,
         8);
}

TEST(Launch, PmixTellsTheRankAndMpiTheNumber) {
  expect(launch_with({{"PMIX_RANK", "2"}, {"SLURM_PROCID", "2"}, {"SLURM_STEP_NUM_TASKS", "4"}}), 2, Launch::unknown);
  expect(launch_with({{"PMIX_RANK", "0"}}), 0, Launch::unknown);
}

TEST(Launch, ABatchScriptAndStepsWithoutMpiAreSingleProcesses) {
  expect(launch_with({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "64"}}), 0, 1);
  expect(launch_with({{"SLURM_PROCID", "5"}, {"SLURM_NTASKS", "8"}, {"SLURM_STEP_NUM_TASKS", "8"}}), 0, 1);
}

template <class Error>
int code_of(const Error& error) {
  return failure_of(error).exit_code;
}

TEST(Failure, WhatAnExceptionMeans) {
  EXPECT_EQ(code_of(UserError("wrong")), exit_wrong_input);
  EXPECT_EQ(code_of(io::WriteError("a.csv", ENOSPC)), exit_stopped);
  EXPECT_EQ(code_of(std::bad_alloc()), exit_stopped);
  EXPECT_EQ(code_of(std::bad_array_new_length()), exit_stopped);
  EXPECT_EQ(code_of(std::length_error("vector::reserve")), exit_stopped);
  EXPECT_EQ(
      code_of(std::filesystem::filesystem_error("cannot remove", std::error_code(EACCES, std::generic_category()))),
      exit_stopped);
  EXPECT_EQ(code_of(std::logic_error("impossible")), exit_defect);
  EXPECT_EQ(code_of(FailureOnAllRanks({exit_wrong_input, "wrong on rank 3"})), exit_wrong_input);
  EXPECT_EQ(failure_of(FailureOnAllRanks({exit_wrong_input, "wrong on rank 3"})).message, "wrong on rank 3");
  EXPECT_EQ(failure_of(std::bad_alloc()).message.find("defect"), std::string::npos);
}

/// Of three ranks, where the last has failed as well if this one has.
struct ThreeRanks : Ranks {
  explicit ThreeRanks(bool another_fails) : another_fails_(another_fails) {}
  int size() const override { return 3; }
  int first_where(bool mine) const override { return mine ? 0 : another_fails_ ? 2 : 3; }
  int number_of(int rank, int mine) const override { return rank == 0 ? mine : exit_stopped; }
  std::string text_of(int rank, std::string mine) const override { return rank == 0 ? mine : "the disk is full"; }
  void abort(int exit_code) const override { aborted_with = exit_code; }
  mutable int aborted_with = -1;

 private:
  bool another_fails_;
};

Failure agreed_on(const Ranks& ranks, void (*work)()) {
  try {
    on_all_ranks(ranks, work);
  } catch (const FailureOnAllRanks& error) {
    return error.failure();
  }
  return {exit_done, ""};
}

TEST(OnAllRanks, WhatFailsOnOneFailsOnAllWithItsSentence) {
  const auto good = [] {};
  const auto bad = [] { throw UserError("no such row"); };
  EXPECT_EQ(agreed_on(ThreeRanks(false), good).exit_code, exit_done);
  EXPECT_EQ(agreed_on(ThreeRanks(false), bad).exit_code, exit_wrong_input);
  EXPECT_EQ(agreed_on(ThreeRanks(false), bad).message, "no such row");
  EXPECT_EQ(agreed_on(ThreeRanks(true), good).exit_code, exit_stopped);
  EXPECT_EQ(agreed_on(ThreeRanks(true), good).message, "the disk is full");
  EXPECT_THROW(on_all_ranks(one_rank(), bad), UserError);
}

TEST(OnAllRanks, WhatTheOthersDoNotKnowOfEndsThem) {
  const ThreeRanks ranks(false);
  std::string said;
  const auto last_words = [&](const Failure& failure) { said = failure.message; };
  const auto without_memory = []() -> int { throw std::bad_alloc(); };
  EXPECT_THROW(together_or_not_at_all(ranks, without_memory, last_words), std::bad_alloc);
  EXPECT_EQ(ranks.aborted_with, exit_stopped);
  EXPECT_EQ(said, failure_of(std::bad_alloc()).message);

  const ThreeRanks others(false);
  const auto agreed = []() -> int { throw FailureOnAllRanks({exit_stopped, "known to all"}); };
  EXPECT_THROW(together_or_not_at_all(others, agreed, last_words), FailureOnAllRanks);
  EXPECT_EQ(others.aborted_with, -1);
  EXPECT_EQ(together_or_not_at_all(
                others, [] { return 7; }, last_words),
            7);
}

}  // namespace
}  // namespace pseudorigid::app::test
