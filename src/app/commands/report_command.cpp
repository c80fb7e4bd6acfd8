#include "app/commands/report_command.h"

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

std::vector<std::string> movers_of_run(const io::RunDirectory& directory) try {
  return io::movers_in(directory.manifest());
} catch (const UserError& error) {
  throw UserError(std::string("DIR: expected the directory of a run; ") + error.what());
}

/// The place that was named is at fault, and not the machine.
bool is_of_the_place(const io::WriteError& error) {
  constexpr int numbers[] = {ENOENT, ENOTDIR, EISDIR, EACCES, EPERM, EROFS, ENAMETOOLONG, ELOOP};
  return std::ranges::find(numbers, error.error_number) != std::end(numbers);
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
    throw UserError(std::string(options.output ? "--output: " : "DIR: ") + error.what());
  }
  io::print(path.native() + "\n");
}

}  // namespace pseudorigid::app
