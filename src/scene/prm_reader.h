#pragma once
/// Reader of the .prm syntax of deal.II's ParameterHandler, without deal.II:
///
///     set Name = value          # a comment; the value may be empty
///     subsection Name … end     (SET, SUBSECTION, END, INCLUDE in capitals are as good)
///     include FILE
///     a backslash at the end of a line continues it with the next one, whose leading blanks are dropped
///
/// White space around names and values is dropped; tabs count as blanks. A test compares the reader with the installed
/// ParameterHandler. Deliberate differences:
/// - several blanks inside a name count as one (deal.II documents this, but its parser looks the name up as written);
/// - the file of `include` is sought beside the including file, not in the working directory, and a file that includes
///   itself is refused (deal.II would not return);
/// - a name that contains `/` is refused, as `/` joins subsection and entry in messages and in `--set`;
/// - a UTF-8 byte order mark at the start of a file is skipped; control characters (binary data) are refused;
/// - a file over 1 MiB, or more than 100 included files, are refused: they are a mistake;
/// - a statement on a line that a backslash joins to the one before is refused: it would be lost, unseen;
/// - `include` takes files alone: a pipe could not be read a second time.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace pseudorigid::scene {

/// One `set` or one `subsection` line.
struct Statement {
  std::string path;                  ///< "Section/Entry", or "Section" if a subsection begins
  std::optional<std::string> value;  ///< empty if a subsection begins
  std::string file;
  int line = 0;  ///< 0: not from a file, `file` then says where from

  /// "scene.prm:12".
  std::string where() const;
};

using StatementHandler = std::function<void(const Statement&)>;

/// Everything in the file. Throws UserError for one that cannot be read.
std::string text_of_prm(const std::filesystem::path& file);

/// Calls `handle` for each statement of the text and of the files that it includes, in order. A handler that throws
/// ends the reading. `name` stands for the text in messages and is the base of `include`. Throws UserError
/// ("file:line: …") for a file that cannot be read and for errors of syntax.
void read_prm_text(std::string_view text, const std::filesystem::path& name, const StatementHandler& handle);

/// A name as it is compared: trimmed, tabs as blanks, several blanks as one.
std::string normalised_name(std::string_view name);

}  // namespace pseudorigid::scene
