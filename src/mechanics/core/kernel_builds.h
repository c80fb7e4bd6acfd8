#pragma once
/// Kernels that are compiled several times, for different instruction sets of the processor (cmake/Kernels.cmake). A
/// build of the kernels is a table of functions for one instruction set. Each process uses the first build in the list
/// that its processor can run, unless the environment variable PSEUDORIGID_INSTRUCTIONS names a build.

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pseudorigid::mechanics {

template <class Table>
struct KernelBuild {
  std::string_view instructions;  ///< for example "x86-64-v3", or "native" for those of the compiling machine
  bool (*runs_here)();            ///< returns true if this processor has the instructions
  const Table* table;
};

/// Thrown if no build can be chosen; what() is one sentence for the user.
struct NoKernels : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The instruction set of a build. `runs_here` is true if this processor has these instructions.
struct KernelChoice {
  std::string_view instructions;
  bool runs_here;
};

/// Returns the index of the build for the instruction set `wanted`. Throws NoKernels if there is no such build, or if
/// this processor cannot run it. If `wanted` is empty, returns the index of the first build that this processor can
/// run, and throws NoKernels if there is none.
std::size_t choose_build(const std::vector<KernelChoice>& builds, std::string_view wanted);

/// Returns the value of the environment variable PSEUDORIGID_INSTRUCTIONS, or an empty text if the variable is not set.
std::string_view wanted_instructions();

/// Returns the build that this process uses. Throws NoKernels if the processor cannot run any build, or cannot run the
/// build that the environment variable names.
template <class Table>
const KernelBuild<Table>& choose_build(std::span<const KernelBuild<Table>> builds) {
  std::vector<KernelChoice> choices;
  for (const auto& build : builds) choices.push_back({build.instructions, build.runs_here()});
  return builds[choose_build(choices, wanted_instructions())];
}

}  // namespace pseudorigid::mechanics
