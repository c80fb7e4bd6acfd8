#pragma once
/// What the run says: to log.txt with timestamps (everything), and to stderr as --quiet and --verbose want it.

#include <spdlog/logger.h>

#include <filesystem>
#include <memory>
#include <optional>

namespace pseudorigid::io {

/// What reaches the terminal; `silent` is for the ranks of a parallel run that have nothing to say.
enum class Verbosity { silent, quiet, normal, verbose };

/// A logger that is the caller's own (no registry, no global). `log_file` empty: terminal only, as for `check`.
/// `append` continues the file of a resumed run. WriteError if the file cannot be opened.
std::shared_ptr<spdlog::logger> make_logger(Verbosity verbosity, const std::optional<std::filesystem::path>& log_file,
                                            bool append = false);

}  // namespace pseudorigid::io
