#include "app/commands/row_processes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/signals.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

/// Kind of an answer of the child process: a row, or the kind of the exception that the task has thrown.
enum class Answer : std::int64_t { row, wrong_input, no_memory, failure };

/// The first part of an answer: its kind, the outcome `end` of the run, and the sizes of the parts that follow. The row
/// has n_row values, the samples have n_columns columns and n_values values, and the message has n_letters letters.
struct Header {
  Answer answer;
  std::int64_t end, n_row, n_columns, n_values, n_letters;
};

/// Writes all bytes to a file descriptor. Returns false if this is not possible, for example if the reader has ended.
bool write_all(int file, const void* data, std::size_t size) {
  const char* p = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::write(file, p, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    p += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

/// Writes the header, the row, the values of the samples and the message. The names of the columns of the samples
/// follow, each after its length. Returns false if a part cannot be written.
bool write_answer(int file, Answer answer, const FinishedRun& run) {
  const Header header{answer,
                      static_cast<std::int64_t>(run.end),
                      static_cast<std::int64_t>(run.row.size()),
                      static_cast<std::int64_t>(run.samples.columns.size()),
                      static_cast<std::int64_t>(run.samples.values.size()),
                      static_cast<std::int64_t>(run.message.size())};
  bool written = write_all(file, &header, sizeof(header)) &&
                 write_all(file, run.row.data(), run.row.size() * sizeof(double)) &&
                 write_all(file, run.samples.values.data(), run.samples.values.size() * sizeof(double)) &&
                 write_all(file, run.message.data(), run.message.size());
  for (const std::string& column : run.samples.columns) {
    const auto size = static_cast<std::int64_t>(column.size());
    written = written && write_all(file, &size, sizeof(size)) && write_all(file, column.data(), column.size());
  }
  return written;
}

/// Computes run k. If the task throws an exception, the answer has the kind of the exception, and the FinishedRun has
/// only the message of the exception. For std::bad_alloc the message is empty.
std::pair<Answer, FinishedRun> answer_of(const SweepTask& task, int k) {
  try {
    return {Answer::row, task.run(k)};
  } catch (const UserError& error) {
    return {Answer::wrong_input, {.row = {}, .samples = {}, .message = error.what()}};
  } catch (const std::bad_alloc&) {
    return {Answer::no_memory, {}};
  } catch (const std::exception& error) {
    return {Answer::failure, {.row = {}, .samples = {}, .message = error.what()}};
  }
}

std::array<int, 2> make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "no pipe to a process of the sweep");
  return ends;
}

}  // namespace

RowProcess::RowProcess(const SweepTask& task) {
  const auto [request_out, request_in] = make_pipe();
  const auto [answer_out, answer_in] = make_pipe();
  std::fflush(nullptr);  // otherwise the child process would write buffered text again
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) std::_Exit(0);
    ::close(request_in);
    ::close(answer_out);
    serve(task, request_out, answer_in);
  }
  const int problem = errno;
  ::close(request_out);
  ::close(answer_in);
  to_ = request_in;
  from_ = answer_out;
  if (process_ < 0) {
    ::close(to_);
    ::close(from_);
    throw std::system_error(problem, std::generic_category(), "no process for the sweep");
  }
}

RowProcess::~RowProcess() {
  ::close(to_);
  ::close(from_);
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);  // the process does not have data that must be saved
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
}

void RowProcess::serve(const SweepTask& task, int requests, int answers) {
  for (int k = 0;;) {
    const ssize_t n = ::read(requests, &k, sizeof(k));
    if (n < 0 && errno == EINTR) continue;
    if (n != sizeof(k)) std::_Exit(0);
    const auto [answer, run] = answer_of(task, k);
    if (!write_answer(answers, answer, run)) std::_Exit(0);
  }
}

bool RowProcess::receive(void* data, std::size_t size) {
  char* p = static_cast<char*>(data);
  constexpr int patience = 100;  // ms between checks for an interruption
  bool has_told = false;
  while (size > 0) {
    pollfd ready{from_, POLLIN, 0};
    if (::poll(&ready, 1, patience) <= 0) {
      if (io::interrupt_requested() && !std::exchange(has_told, true)) ::kill(process_, SIGTERM);
      continue;
    }
    const ssize_t n = ::read(from_, p, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    p += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

void RowProcess::report_end(int k) {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  process_ = -1;
  throw std::runtime_error(
      WIFSIGNALED(status) ? fmt::format("the process of run {} was ended by the signal {}", k + 1, WTERMSIG(status))
                          : fmt::format("the process of run {} ended without an answer", k + 1));
}

FinishedRun RowProcess::run(int k) {
  if (process_ < 0 || !write_all(to_, &k, sizeof(k))) report_end(k);
  Header header{};
  if (!receive(&header, sizeof(header))) report_end(k);
  FinishedRun run{.row = std::vector<double>(static_cast<std::size_t>(header.n_row)),
                  .samples = {},
                  .end = static_cast<mechanics::Outcome>(header.end),
                  .message = std::string(static_cast<std::size_t>(header.n_letters), ' ')};
  run.samples.columns.resize(static_cast<std::size_t>(header.n_columns));
  run.samples.values.resize(static_cast<std::size_t>(header.n_values));
  bool received = receive(run.row.data(), run.row.size() * sizeof(double)) &&
                  receive(run.samples.values.data(), run.samples.values.size() * sizeof(double)) &&
                  receive(run.message.data(), run.message.size());
  for (std::string& column : run.samples.columns) {
    std::int64_t size = 0;
    received = received && receive(&size, sizeof(size));
    column.resize(static_cast<std::size_t>(size));
    received = received && receive(column.data(), column.size());
  }
  if (!received) report_end(k);
  switch (header.answer) {
    case Answer::wrong_input:
      throw UserError(run.message);
    case Answer::no_memory:
      throw std::bad_alloc();
    case Answer::failure:
      throw std::runtime_error(run.message);
    case Answer::row:
      break;
  }
  return run;
}

TaskInProcesses::TaskInProcesses(const SweepTask& task, int n_processes) : task_(task) {
  for (int i = 0; i < n_processes; ++i) idle_.push_back(std::make_unique<RowProcess>(task));
}

FinishedRun TaskInProcesses::run(int k) const {
  std::unique_ptr<RowProcess> process;
  {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) throw std::logic_error("more threads than processes");
    process = std::move(idle_.back());
    idle_.pop_back();
  }
  // The process returns to the list after an exception as well. If the process has ended, the next run in it also
  // fails.
  struct Return {
    const TaskInProcesses& owner;
    std::unique_ptr<RowProcess>& process;
    ~Return() {
      const std::lock_guard lock(owner.mutex_);
      owner.idle_.push_back(std::move(process));
    }
  } const back{*this, process};
  return process->run(k);
}

}  // namespace pseudorigid::app
