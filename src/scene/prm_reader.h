#pragma once
/// A reader for the .prm syntax of deal.II's ParameterHandler that does not need deal.II:
///
///     set Name = value          # a comment; the value may be empty
///     subsection Name … end     (SET, SUBSECTION, END, INCLUDE may be in capitals)
///     include FILE
///     a backslash at the end of a line joins the next line to it, without the leading blanks
///
/// White space around names and values is removed, and tabs count as blanks. The test tests/scene/prm_oracle_test.cpp
/// compares the reader with the installed ParameterHandler. The reader differs from ParameterHandler on purpose in the
/// following points.
///
/// Several blanks inside a name count as one blank. The documentation of deal.II states the same, but its parser
/// preserves several blanks. The file of `include` is searched in the folder of the including file, not in the working
/// directory.
///
/// The reader refuses control characters, which occur in binary files, and a file above 1 MiB. It refuses a file that
/// includes itself, more than 100 included files, and a name that contains `/`. The character `/` joins subsection and
/// entry in messages and in `--set`. The reader refuses a statement on a line that a backslash joins to the line
/// before, because the statement would have no effect. `include` accepts regular files only, because a pipe cannot be
/// read twice. A UTF-8 byte order mark at the start of a file is skipped.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace pseudorigid::scene {

/// A `set` line or a `subsection` line.
struct Statement {
  std::string path;                  ///< "Section/Entry", or "Section" if a subsection begins
  std::optional<std::string> value;  ///< text after "="; empty if a subsection begins
  std::string file;
  int line = 0;  ///< 0 if the statement is not from a file; `file` is then the origin, for example "--set"

  /// The origin of the statement, for example "scene.prm:12".
  std::string where() const;
};

using StatementHandler = std::function<void(const Statement&)>;

/// The text of a file. Throws UserError if the file cannot be read or is larger than 1 MiB.
std::string text_of_prm(const std::filesystem::path& file);

/// Calls `handle` for each statement of the text and of the included files, in order. An exception of `handle` ends the
/// reading and reaches the caller. `name` is the file name of the text in messages, and the paths of included files are
/// relative to the folder of `name`. Throws UserError for errors of syntax and if an included file cannot be read. The
/// message begins with "file:line", or with "file" if an included file closes a subsection that it did not open.
void read_prm_text(std::string_view text, const std::filesystem::path& name, const StatementHandler& handle);

/// The form of a name for comparisons: trimmed, and with one blank for each sequence of blanks and tabs.
std::string normalised_name(std::string_view name);

}  // namespace pseudorigid::scene
