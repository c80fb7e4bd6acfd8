#pragma once
/// Standard input, output and error, which a shell may close, direct to a full disk or connect to a pipe without a
/// reader.

#include <string_view>

namespace pseudorigid::io {

/// Opens /dev/null for each closed standard descriptor. Otherwise a file that is opened later would get the number of
/// standard output, and terminal output would be written into it. Call this function before any file is opened.
void open_standard_descriptors();

/// Writes to standard output without a buffer. WriteError if this fails, except for a pipe that its reader has closed.
void print(std::string_view text);

}  // namespace pseudorigid::io
