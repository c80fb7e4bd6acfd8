#pragma once
/// Messages of a run. The file log.txt contains all messages, each with its time. The options --quiet and --verbose
/// select the messages that also appear on stderr.

#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace spdlog {
class logger;
}

namespace pseudorigid::io {

/// Selection of the messages on stderr. With `silent` there are no messages. `quiet` selects warnings and errors,
/// `normal` also information, and `verbose` all messages. Ranks other than rank 0 of a parallel run have the value
/// `silent`.
enum class Verbosity { silent, quiet, normal, verbose };

/// Writes messages to stderr and to the log file. The arguments after the text replace the placeholders {…} of fmt in
/// the text. Only log.cpp formats messages, so that other source files need not compile the formatting of spdlog.
class Logger {
 public:
  enum class Level { debug, info, warning, error };

  explicit Logger(std::shared_ptr<spdlog::logger> logger) : logger_(std::move(logger)) {}

  template <class First, class... Rest>
  void debug(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
    write(Level::debug, text, fmt::make_format_args(first, rest...));
  }
  template <class First, class... Rest>
  void info(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
    write(Level::info, text, fmt::make_format_args(first, rest...));
  }
  template <class First, class... Rest>
  void warn(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
    write(Level::warning, text, fmt::make_format_args(first, rest...));
  }
  template <class First, class... Rest>
  void error(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
    write(Level::error, text, fmt::make_format_args(first, rest...));
  }
  void debug(std::string_view message) { write(Level::debug, message); }
  void info(std::string_view message) { write(Level::info, message); }
  void warn(std::string_view message) { write(Level::warning, message); }
  void error(std::string_view message) { write(Level::error, message); }

 private:
  void write(Level level, fmt::string_view text, fmt::format_args values);
  void write(Level level, std::string_view message);

  std::shared_ptr<spdlog::logger> logger_;
};

/// Makes a logger that spdlog does not register globally. Without `log_file`, the logger writes only to stderr, for
/// example for the command `check`. With Verbosity::silent, the logger does not write to stderr. If `append` is true,
/// the logger continues the file of a resumed run. Otherwise it replaces an old file. Throws WriteError if the file
/// cannot be opened. Later failures of writing to the log are ignored.
std::shared_ptr<Logger> make_logger(Verbosity verbosity, const std::optional<std::filesystem::path>& log_file,
                                    bool append = false);

}  // namespace pseudorigid::io
