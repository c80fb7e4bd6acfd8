#pragma once
/// Safe use of standard input, output and error. A shell may close them, direct them to a full disk, or connect them to
/// a pipe without a reader.

#include <string_view>

namespace pseudorigid::io {

/// Opens /dev/null for each closed standard descriptor. Otherwise a file that is opened later could get the number of
/// standard output, and terminal output would be written into this file. Call this function before any file is opened.
void open_standard_descriptors();

/// Writes the text to standard output without a buffer. Throws WriteError if this fails. A pipe without a reader is not
/// an error.
void print(std::string_view text);

}  // namespace pseudorigid::io
