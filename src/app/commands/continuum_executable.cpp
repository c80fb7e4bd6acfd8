#include "app/commands/continuum_executable.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "io/files.h"
#include "scene/advice.h"
#include "scene/models.h"
#include "scene/user_error.h"
#include "scene/validate.h"

namespace pseudorigid::app {
namespace {

/// Names the descriptor of a file in memory.
constexpr const char* variable = "PSEUDORIGID_SCENE_TEXT";

std::filesystem::path continuum_executable() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "pseudorigid-continuum";
}

void hand_over(const std::string& text) {
  const int descriptor = memfd_create("scene", 0);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "the scene cannot be handed over");
  io::write_fully(descriptor, text, "the scene in memory");
  ::setenv(variable, std::to_string(descriptor).c_str(), 1);
}

/// The loader of the system would end the process with a code of its own.
void require_address_space() {
  constexpr double needed = 0.67e9;  // measured: with less than 0.5e9 the loader fails, with less than 0.65e9 MPI hangs
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  const auto allowed = static_cast<double>(limit.rlim_cur);
  if (allowed < needed)
    throw std::system_error(
        ENOMEM, std::generic_category(),
        fmt::format("the libraries of the finite elements take {:.2g} GB of addresses, and ulimit -v allows {:.2g} GB",
                    needed / 1e9, allowed / 1e9));
}

}  // namespace

void try_to_become_continuum_executable(char** argv) {
  std::fflush(nullptr);
  execv(continuum_executable().c_str(), argv);
}

void become_continuum_executable(char** argv, const scene::ReadScene& read) {
  require_address_space();
  hand_over(read.text);
  try_to_become_continuum_executable(argv);
  scene::Refusal refusal{"Models",
                         fmt::format("the scene needs the continuum model, but {} cannot be started ({}); build "
                                     "the preset release",
                                     continuum_executable().string(), std::strerror(errno))};
  for (const auto name : scene::names_where(read.scene, [](const auto& model) { return !model.discretized; }))
    refusal.remedies.push_back({{refusal.path, std::string(name)}});
  throw UserError(scene::sentence_with_advice(
      refusal, read.scene, [&](scene::Scene trial) { return is_accepted(std::move(trial), read.origins); }));
}

std::optional<std::string> scene_text_handed_over() {
  const char* value = std::getenv(variable);
  if (value == nullptr) return {};
  const std::string file = std::string("/proc/self/fd/") + value;
  const int descriptor = std::atoi(value);
  ::unsetenv(variable);
  std::string text = io::read_file(file);
  ::close(descriptor);
  return text;
}

}  // namespace pseudorigid::app
