#include "io/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "io/files.h"

namespace pseudorigid::io {

void open_standard_descriptors() {
  // open() returns the lowest free number. This number is `descriptor`, because all lower numbers are in use.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) ::open("/dev/null", O_RDWR);
}

void print(std::string_view text) try {
  write_fully(STDOUT_FILENO, text, "standard output");
} catch (const WriteError& error) {
  if (error.error_number != EPIPE) throw;
}

}  // namespace pseudorigid::io
