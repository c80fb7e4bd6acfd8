#pragma once
/// What the tests of damaged files share: how many, the scenes of params/, and how a refusal must read.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "io/scratch.h"
#include "support/mutants.h"

namespace pseudorigid::testing {

/// How many of each kind: PSEUDORIGID_MUTANTS, which scripts/stress.sh sets, or the short form's 1000.
inline int n_mutants() {
  const char* number = std::getenv("PSEUDORIGID_MUTANTS");
  return number ? std::atoi(number) : 1000;
}

/// What became of them; the line is read by tests/stress/mutants.py.
struct Tally {
  std::string of;
  int n_refused = 0, n_accepted = 0;

  ~Tally() { std::printf("mutants of %s: %d refused, %d accepted\n", of.c_str(), n_refused, n_accepted); }
};

/// One line, not empty, that a terminal shows as it is.
inline ::testing::AssertionResult is_one_sentence(const std::string& message) {
  if (message.empty()) return ::testing::AssertionFailure() << "an empty message";
  if (std::any_of(message.begin(), message.end(), [](unsigned char c) { return std::iscntrl(c); }))
    return ::testing::AssertionFailure() << "control characters in: " << message;
  return ::testing::AssertionSuccess();
}

inline std::vector<std::string> texts_of(const std::string& folder, const std::string& extension) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == extension) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const auto& path : paths) texts.push_back(io::test::contents(path));
  return texts;
}

/// Pieces of the language of parameter files that do harm in the wrong place.
inline const std::vector<std::string> prm_words{"\nend\n",
                                                "\nsubsection Body\n",
                                                "\nsubsection Time\nset End = ",
                                                "\ninclude scene.prm\n",
                                                "\ninclude nowhere.prm\n",
                                                "set Models = continuum\n",
                                                "\nset System = torus\n",
                                                "\nsubsection Sweep\nset Parameters = a: 1 .. 2 in 3\nend\n",
                                                "$(a)",
                                                "auto",
                                                "; ",
                                                ", ",
                                                " = ",
                                                "set ",
                                                "\n\n"};

}  // namespace pseudorigid::testing
