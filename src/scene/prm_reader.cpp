#include "scene/prm_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <vector>

#include "entries/wording.h"
#include "scene/user_error.h"

namespace pseudorigid::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_file = 1 << 20;
constexpr int most_includes = 100;

/// Returns true for control characters other than white space, which occur in binary files.
bool is_binary(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::iscntrl(byte) && !std::isspace(byte);
}

/// Returns `; did you mean "…"?` with a similar name among the .prm files in the folder of the missing file `file`. If
/// `file` exists or no name is similar, the result is empty.
std::string scene_meant(const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = file.parent_path();
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder, ignored))
    if (entry.path().extension() == ".prm") found.push_back((folder / entry.path().filename()).string());
  std::sort(found.begin(), found.end());
  return fs::exists(file, ignored) ? "" : did_you_mean(file.string(), {found.begin(), found.end()});
}

/// Reads a text file. Throws UserError if this fails or if the file is larger than 1 MiB. The message begins with
/// `blame`.
std::string text_of(const fs::path& file, const std::string& blame) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored))
    throw UserError(fmt::format("{}: expected a parameter file, but {} is a directory", blame, quote(file.string())));
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw UserError(
        fmt::format("{}: cannot open the parameter file {}{}", blame, quote(file.string()), scene_meant(file)));
  std::string text(largest_file + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) throw UserError(fmt::format("{}: cannot read the file {}", blame, quote(file.string())));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > largest_file)
    throw UserError(
        fmt::format("{}: {} is larger than 1 MiB, which no parameter file is", blame, quote(file.string())));
  return text;
}

/// If `line` begins with one of the two spellings of a keyword, removes the keyword and returns true.
bool take_keyword(std::string_view& line, std::string_view small, std::string_view capital) {
  if (!line.starts_with(small) && !line.starts_with(capital)) return false;
  line.remove_prefix(small.size());
  return true;
}

/// Returns true if the line alone, without the lines to which it is joined, is a statement.
bool is_statement(std::string_view line) {
  std::string text(trimmed(line.substr(0, line.find('#'))));
  std::replace(text.begin(), text.end(), '\t', ' ');
  std::string_view rest = text;
  if (take_keyword(rest, "set ", "SET ")) return rest.find('=') != rest.npos;
  return text == "end" || text == "END" || take_keyword(rest, "subsection ", "SUBSECTION ") ||
         take_keyword(rest, "include ", "INCLUDE ");
}

class PrmReader {
 public:
  explicit PrmReader(const StatementHandler& handle) : handle_(handle) {}

  /// Joins continued lines and handles each statement. Throws UserError for errors of syntax, or if an included file
  /// cannot be read. Also throws UserError if the subsections that the text opens and closes do not match.
  void read_text(std::string_view text, const fs::path& file) {
    std::error_code ignored;
    files_.push_back({file, fs::weakly_canonical(file, ignored), 0});
    const std::vector<Subsection> subsections_before = subsections_;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    std::string joined;
    bool continued = false;
    for (int line = 1; !text.empty(); ++line) {
      if (!continued) files_.back().line = line;
      const auto end = std::min(text.find('\n'), text.size());
      std::string_view piece = trimmed(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (continued && !joined.empty() && is_statement(piece)) {
        files_.back().line = line - 1;
        refuse(fmt::format("the backslash at the end of this line joins the next one to it, {}; remove the backslash",
                           quote(piece)));
      }
      continued = piece.ends_with('\\');
      if (continued) piece.remove_suffix(1);
      joined += piece;
      if (continued && !text.empty()) continue;
      scan_line(joined);
      joined.clear();
    }
    check_balance(subsections_before);
    files_.pop_back();
  }

 private:
  struct Subsection {
    std::string name, where;
    bool operator==(const Subsection& other) const { return name == other.name; }
  };
  struct OpenFile {
    fs::path name, canonical;
    int line;
  };

  std::string where() const { return fmt::format("{}:{}", files_.back().name.string(), files_.back().line); }

  [[noreturn]] void refuse(const std::string& sentence) const { throw UserError(where() + ": " + sentence); }

  std::string path_of(const std::string& name) const {
    std::string path;
    for (const Subsection& subsection : subsections_) path += subsection.name + "/";
    return path + name;
  }

  std::string checked_name(std::string_view text, std::string_view what) const {
    std::string name = normalised_name(text);
    if (name.empty()) refuse(fmt::format("the name of the {} is missing", what));
    if (name.find('/') != std::string::npos)
      refuse(
          fmt::format("a name holds no \"/\", got {}; an entry of a subsection is written "
                      "\"subsection Body\", \"set Radius = 1\", \"end\" on three lines",
                      quote(name)));
    return name;
  }

  void emit(std::string path, std::optional<std::string> value) const {
    handle_(Statement{std::move(path), std::move(value), files_.back().name.string(), files_.back().line});
  }

  void scan_line(std::string& text) {
    if (std::any_of(text.begin(), text.end(), is_binary))
      refuse("expected text, got control characters; this is not a parameter file");
    text.resize(std::min(text.find('#'), text.size()));
    std::replace(text.begin(), text.end(), '\t', ' ');
    std::string_view line = trimmed(text);
    if (line.empty()) return;
    if (take_keyword(line, "subsection ", "SUBSECTION ")) {
      enter(line);
    } else if (take_keyword(line, "end", "END")) {
      leave(line);
    } else if (take_keyword(line, "set ", "SET ")) {
      set(line);
    } else if (take_keyword(line, "include ", "INCLUDE ")) {
      include(trimmed(line));
    } else {
      refuse(fmt::format("expected \"set Name = value\", \"subsection Name\", \"end\" or \"include FILE\", got {}",
                         quote(line)));
    }
  }

  void enter(std::string_view rest) {
    std::string name = checked_name(rest, "subsection");
    emit(path_of(name), std::nullopt);
    subsections_.push_back({std::move(name), where()});
  }

  void leave(std::string_view rest) {
    if (!trimmed(rest).empty()) refuse(fmt::format("expected \"end\" alone, got {}", quote("end" + std::string(rest))));
    if (subsections_.empty()) refuse("this \"end\" closes no subsection");
    subsections_.pop_back();
  }

  void set(std::string_view rest) {
    const auto equals = rest.find('=');
    if (equals == std::string_view::npos)
      refuse(fmt::format("expected \"set Name = value\", but there is no \"=\" in {}", quote(rest)));
    const std::string name = checked_name(rest.substr(0, equals), "entry");
    emit(path_of(name), std::string(trimmed(rest.substr(equals + 1))));
  }

  void include(const fs::path& name) {
    const fs::path file = files_.back().name.parent_path() / name;
    std::error_code ignored;
    const fs::path canonical = fs::weakly_canonical(file, ignored);
    if (std::any_of(files_.begin(), files_.end(), [&](const OpenFile& open) { return open.canonical == canonical; }))
      refuse(fmt::format("the file {} includes itself", quote(file.string())));
    if (++n_includes_ > most_includes)
      refuse(fmt::format("more than {} files are included, which must be a mistake", most_includes));
    if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored) && !fs::is_directory(file, ignored))
      refuse(fmt::format("expected a file to include, but {} is none", quote(file.string())));
    read_text(text_of(file, where()), file);
  }

  void check_balance(const std::vector<Subsection>& before) const {
    if (subsections_ == before) return;
    if (subsections_.size() > before.size())
      throw UserError(fmt::format("{}: the subsection {} is not closed by an \"end\"", subsections_.back().where,
                                  quote(subsections_.back().name)));
    throw UserError(
        fmt::format("{}: this included file closes a subsection that it did not open", files_.back().name.string()));
  }

  const StatementHandler& handle_;
  std::vector<OpenFile> files_;  ///< the open files; each one includes the next, and the last one is being read
  std::vector<Subsection> subsections_;
  int n_includes_ = 0;
};

}  // namespace

std::string Statement::where() const { return line > 0 ? fmt::format("{}:{}", file, line) : file; }

std::string text_of_prm(const fs::path& file) { return text_of(file, file.string()); }

void read_prm_text(std::string_view text, const fs::path& name, const StatementHandler& handle) {
  PrmReader(handle).read_text(text, name);
}

std::string normalised_name(std::string_view name) {
  std::string result;
  for (const char c : trimmed(name)) {
    const char blank_or_letter = c == '\t' ? ' ' : c;
    if (blank_or_letter != ' ' || result.back() != ' ') result += blank_or_letter;
  }
  return result;
}

}  // namespace pseudorigid::scene
