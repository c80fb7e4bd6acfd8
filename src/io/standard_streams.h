#pragma once
/// Safe use of the standard streams (standard input, output and error). A shell may close a stream, direct its output
/// to a full disk, or connect it to a pipe without a reader.

#include <string_view>

namespace pseudorigid::io {

/// Opens /dev/null for each closed standard stream. Otherwise a file that is opened later could get the descriptor
/// number of standard output, and text for standard output would be written into this file. Call this function before
/// any file is opened.
void open_standard_descriptors();

/// Writes the text to standard output without a buffer. Throws WriteError if this fails. If standard output is a pipe
/// without a reader and SIGPIPE is ignored (signals.h), the function discards the text and does not throw. If SIGPIPE
/// is not ignored, the signal ends the program.
void print(std::string_view text);

}  // namespace pseudorigid::io
