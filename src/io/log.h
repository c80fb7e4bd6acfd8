#pragma once
/// Messages of a run. The file log.txt contains all of them with the time; --quiet and --verbose select those on
/// stderr.

#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace spdlog {
class logger;
}

namespace pseudorigid::io {

/// Selection of the messages on the terminal. `silent` is for the other ranks of a parallel run.
enum class Verbosity { silent, quiet, normal, verbose };

/// Writes messages. Values replace the places {…} of a message. Only log.cpp formats messages, because a source that
/// formats through spdlog compiles all of its formatting again.
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

/// Makes a new logger that is not registered globally. Without `log_file`, it writes to the terminal only, as for the
/// command `check`. `append` continues the file of a resumed run. WriteError if the file cannot be opened.
std::shared_ptr<Logger> make_logger(Verbosity verbosity, const std::optional<std::filesystem::path>& log_file,
                                    bool append = false);

}  // namespace pseudorigid::io
