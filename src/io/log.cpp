#include "io/log.h"

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <cerrno>
#include <string_view>
#include <vector>

#include "io/files.h"
#include "io/progress.h"

namespace pseudorigid::io {

namespace {

/// Formats the prefix of a message on stderr: "warning: " for warnings and "error: " for errors. Other messages do not
/// have a prefix.
class SeverityPrefix : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string_view prefix = message.level >= spdlog::level::err    ? "error: "
                                    : message.level == spdlog::level::warn ? "warning: "
                                                                           : "";
    out.append(prefix.data(), prefix.data() + prefix.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<SeverityPrefix>(); }
};

spdlog::level::level_enum terminal_level(Verbosity verbosity) {
  switch (verbosity) {
    case Verbosity::silent:
      return spdlog::level::off;
    case Verbosity::quiet:
      return spdlog::level::warn;
    case Verbosity::normal:
      return spdlog::level::info;
    case Verbosity::verbose:
      return spdlog::level::debug;
  }
  return spdlog::level::info;
}

spdlog::sink_ptr terminal_sink(Verbosity verbosity) {
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  sink->set_level(terminal_level(verbosity));
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  // On a terminal, the progress line is deleted before a message is written.
  formatter->add_flag<SeverityPrefix>('*').set_pattern(Progress::stderr_is_terminal() ? "\r\033[K%*%v" : "%*%v");
  sink->set_formatter(std::move(formatter));
  return sink;
}

spdlog::sink_ptr file_sink(const std::filesystem::path& path, bool append) try {
  auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path.native(), !append);
  sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %-7l %v");
  return sink;
} catch (const spdlog::spdlog_ex&) {
  throw WriteError(path, errno);
}

spdlog::level::level_enum level_of(Logger::Level level) {
  switch (level) {
    case Logger::Level::debug:
      return spdlog::level::debug;
    case Logger::Level::info:
      return spdlog::level::info;
    case Logger::Level::warning:
      return spdlog::level::warn;
    case Logger::Level::error:
      return spdlog::level::err;
  }
  return spdlog::level::err;
}

}  // namespace

void Logger::write(Level level, fmt::string_view text, fmt::format_args values) {
  if (logger_->should_log(level_of(level))) write(level, fmt::vformat(text, values));
}

void Logger::write(Level level, std::string_view message) { logger_->log(level_of(level), message); }

std::shared_ptr<Logger> make_logger(Verbosity verbosity, const std::optional<std::filesystem::path>& log_file,
                                    bool append) {
  std::vector<spdlog::sink_ptr> sinks;
  if (verbosity != Verbosity::silent) sinks.push_back(terminal_sink(verbosity));
  if (log_file) sinks.push_back(file_sink(*log_file, append));
  auto logger = std::make_shared<spdlog::logger>("pseudorigid", sinks.begin(), sinks.end());
  logger->set_level(sinks.empty() ? spdlog::level::off : spdlog::level::debug);
  logger->flush_on(spdlog::level::info);
  // A failed write to the log must not end a run. If the disk is full, the failed write of a result ends the run.
  logger->set_error_handler([](const std::string&) {});
  return std::make_shared<Logger>(std::move(logger));
}

}  // namespace pseudorigid::io
