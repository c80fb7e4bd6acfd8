#include "app/commands/report_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string>
#include <vector>

#include "io/files.h"
#include "io/manifest.h"
#include "io/report.h"
#include "io/run_directory.h"
#include "io/standard_streams.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

/// Names of the models or of the system of the run, from its manifest. Throws UserError if the directory has no
/// readable manifest.
std::vector<std::string> movers_of_run(const io::RunDirectory& directory) try {
  return io::movers_in(directory.manifest());
} catch (const UserError& error) {
  throw UserError(std::string("DIR: expected the directory of a run; ") + error.what());
}

/// True if the path of the page causes the error. False if the machine causes it, for example by a full disk.
bool is_of_the_place(const io::WriteError& error) {
  constexpr int numbers[] = {ENOENT, ENOTDIR, EISDIR, EACCES, EPERM, EROFS, ENAMETOOLONG, ELOOP, EEXIST, ENXIO};
  return std::ranges::find(numbers, error.error_number) != std::end(numbers);
}

/// The text of a write error. ENXIO means that the path is a pipe that no process reads.
std::string in_words(const io::WriteError& error) {
  return error.error_number == ENXIO ? fmt::format("nobody reads from '{}'", error.path.native()) : error.what();
}

}  // namespace

void report_run(const Options& options) {
  const io::RunDirectory directory(options.run_directory);
  const std::string page = io::report_of(directory, movers_of_run(directory));
  const std::filesystem::path path = options.output.value_or(directory.report());
  try {
    io::write_file_atomically(path, {page});
  } catch (const io::WriteError& error) {
    if (!is_of_the_place(error)) throw;
    throw UserError(fmt::format("{}: {}", options.output ? "--output" : "DIR", in_words(error)));
  }
  // The output may be a pipe or a device. Its path is then not printed, because the page is not stored there.
  if (io::kind_unless_file(path).empty()) io::print(path.native() + "\n");
}

}  // namespace pseudorigid::app
