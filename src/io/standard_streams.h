#pragma once
/// Standard input, output and error as a shell may leave them: closed, full, or a pipe whose reader is gone.

#include <string_view>

namespace pseudorigid::io {

/// Opens those that are closed on /dev/null. Otherwise the next file that is opened takes the place of standard output,
/// and output to the terminal is written into it. To be called before any file is opened.
void open_standard_descriptors();

/// To standard output, at once. WriteError if it cannot be written, unless it is a pipe that its reader has closed.
void print(std::string_view text);

}  // namespace pseudorigid::io
