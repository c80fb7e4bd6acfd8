#include "app/commands/open_continuum.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "app/commands/blas_kernels.h"
#include "app/commands/needed_libraries.h"

namespace pseudorigid::app {
namespace {

/// Throws std::system_error if the limit of the address space (ulimit -v) is too low. Does nothing if there is no
/// limit, or if the limit cannot be read. Without this check, the libraries would fail later at various places and with
/// various messages.
void require_address_space() {
  constexpr double needed = 0.67e9;  // bytes; measured: the loader fails below 0.5e9, and MPI hangs below 0.65e9
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

const ContinuumModule* open_continuum() {
  namespace fs = std::filesystem;
  const fs::path library =
      (fs::read_symlink("/proc/self/exe").parent_path() / PSEUDORIGID_CONTINUUM_LIBRARY).lexically_normal();
  if (!fs::exists(library)) throw NoContinuum(fmt::format("there is no {}", library.string()));
  require_address_space();
  choose_blas_kernels();
  open_needed_libraries(library);
  // RTLD_GLOBAL makes the symbols visible to all libraries, because MPI and PETSc open further libraries that need
  // them.
  void* const module = dlopen(library.c_str(), RTLD_LAZY | RTLD_GLOBAL);
  void* const found = module ? dlsym(module, "pseudorigid_continuum") : nullptr;
  if (!found) throw NoContinuum(fmt::format("its library cannot be opened: {}", dlerror()));
  return reinterpret_cast<decltype(&pseudorigid_continuum)>(found)();
}

}  // namespace pseudorigid::app
