#include "mechanics/core/kernel_builds.h"

#include <cstdlib>

namespace pseudorigid::mechanics {
namespace {

constexpr const char* variable = "PSEUDORIGID_INSTRUCTIONS";

std::string names_of(const std::vector<KernelChoice>& builds) {
  std::string names;
  for (const auto& build : builds) names.append(names.empty() ? "" : ", ").append(build.instructions);
  return names;
}

}  // namespace

std::size_t choose_build(const std::vector<KernelChoice>& builds, std::string_view wanted) {
  for (std::size_t i = 0; i < builds.size(); ++i) {
    if (!wanted.empty() && builds[i].instructions != wanted) continue;
    if (builds[i].runs_here) return i;
    if (!wanted.empty())
      throw NoKernels(std::string("this processor does not have the instructions ").append(wanted) + " that " +
                      variable + " asks for");
  }
  if (wanted.empty())
    throw NoKernels("this processor has none of the instructions that pseudorigid was built for (" + names_of(builds) +
                    ")");
  throw NoKernels(std::string(variable) + " is \"" + std::string(wanted) + "\"; pseudorigid was built for " +
                  names_of(builds));
}

std::string_view wanted_instructions() {
  const char* value = std::getenv(variable);
  return value ? value : "";
}

}  // namespace pseudorigid::mechanics
