/// Damaged scenes of params/ by the program's reader and by deal.II's ParameterHandler with all entries of the program:
/// the same values, or refused by both. What the reader deliberately does in another way (scene/prm_reader.h) is left
/// out: control characters, a byte order mark, a slash in a name, `include`.

#include <gtest/gtest.h>

#include <cctype>
#include <random>
#include <string>

#include "app/models/catalogue.h"
#include "scene/entries.h"
#include "stress/mutants.h"
#include "support/prm_oracle.h"

namespace pseudorigid::testing {
namespace {

PrmOracle oracle_of_all_entries() {
  PrmOracle::Values defaults;
  scene::Scene scene = scene::default_scene(app::program_catalogue());
  scene::visit_entries(scene, [&](auto& member, const auto& kind, const scene::About& about) {
    defaults[std::string(about.path)] = kind.print(member);
  });
  return PrmOracle(std::move(defaults));
}

bool is_read_differently(const std::string& text) {
  if (text.starts_with("\xEF\xBB\xBF")) return true;
  for (const char* word : {"nclude", "NCLUDE"})
    if (text.find(word) != std::string::npos) return true;
  for (const unsigned char c : text)
    if (std::iscntrl(c) && !std::isspace(c)) return true;
  for (const std::string& line : lines_of(text)) {
    const std::string before_value = line.substr(0, line.find_first_of("=#"));
    if (before_value.find('/') != std::string::npos) return true;
  }
  return false;
}

TEST(Mutants, OfParameterFilesBesideDealII) {
  const std::vector<std::string> seeds = texts_of(PARAMS, ".prm");
  const PrmOracle oracle = oracle_of_all_entries();
  std::mt19937_64 random(14);
  Tally tally{"parameter files compared with deal.II"};
  for (int i = 0; i < n_mutants(); ++i) {
    const std::string text = damaged_text(seeds[i % seeds.size()], prm_words, seeds, random);
    if (is_read_differently(text)) continue;
    ASSERT_TRUE(oracle.agree(text)) << "mutant " << i;
    ++(oracle.by_reader(text) ? tally.n_accepted : tally.n_refused);
  }
  EXPECT_GT(tally.n_refused, n_mutants() / 5);
  EXPECT_GT(tally.n_accepted, n_mutants() / 5);
}

}  // namespace
}  // namespace pseudorigid::testing
