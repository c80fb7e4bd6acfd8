#include "app/commands/needed_libraries.h"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace pseudorigid::app {
namespace {

namespace fs = std::filesystem;

/// The directories in which the dynamic linker searches for the libraries of the program. Empty if the linker does not
/// give the list.
std::vector<fs::path> search_path() {
  void* const program = dlopen(nullptr, RTLD_LAZY);
  Dl_serinfo size{};
  if (!program || dlinfo(program, RTLD_DI_SERINFOSIZE, &size) != 0) return {};
  std::vector<std::max_align_t> memory(size.dls_size / sizeof(std::max_align_t) + 1);
  auto& info = *reinterpret_cast<Dl_serinfo*>(memory.data());
  if (dlinfo(program, RTLD_DI_SERINFOSIZE, &info) != 0 || dlinfo(program, RTLD_DI_SERINFO, &info) != 0) return {};
  std::vector<fs::path> directories;
  for (unsigned i = 0; i < info.dls_cnt; ++i) directories.emplace_back(info.dls_serpath[i].dls_name);
  return directories;
}

/// Reads a record at a position of the file, in bytes. Returns false if the file is too short.
template <class Record>
bool read(std::ifstream& file, std::uint64_t position, Record& record) {
  return static_cast<bool>(
      file.seekg(static_cast<std::streamoff>(position)).read(reinterpret_cast<char*>(&record), sizeof record));
}

/// The names of the libraries that a library needs, from its ELF file; empty if the file is not an ELF file. The code
/// uses the address of the string table as its offset in the file, because linkers make both equal.
std::vector<std::string> needed_by(const fs::path& library) {
  std::ifstream file(library, std::ios::binary);
  ElfW(Ehdr) header;
  if (!read(file, 0, header) || std::string_view(reinterpret_cast<const char*>(header.e_ident), SELFMAG) != ELFMAG)
    return {};
  std::vector<std::uint64_t> places;
  std::uint64_t names = 0;
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    ElfW(Phdr) segment;
    if (!read(file, header.e_phoff + i * sizeof segment, segment) || segment.p_type != PT_DYNAMIC) continue;
    ElfW(Dyn) entry;
    for (std::uint64_t at = segment.p_offset; read(file, at, entry) && entry.d_tag != DT_NULL; at += sizeof entry) {
      if (entry.d_tag == DT_NEEDED) places.push_back(entry.d_un.d_val);
      if (entry.d_tag == DT_STRTAB) names = entry.d_un.d_ptr;
    }
  }
  std::vector<std::string> needed;
  for (const std::uint64_t place : places)
    std::getline(file.seekg(static_cast<std::streamoff>(names + place)), needed.emplace_back(), '\0');
  return needed;
}

/// Opens libraries in depth-first order: each library once, after the libraries that it needs.
class Opener {
 public:
  /// Opens the libraries that `library` needs, unless the process has them already.
  void open_needed(const fs::path& library) {
    for (const std::string& name : needed_by(library))
      if (seen_.insert(name).second && !dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD)) open(name);
  }

 private:
  /// Opens the first library of this name in the search path, after the libraries that it needs. Ignores a failure,
  /// because the linker opens the library again together with the finite-element library.
  void open(const std::string& name) {
    for (const fs::path& directory : directories_)
      if (const fs::path library = directory / name; fs::exists(library)) {
        open_needed(library);
        dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL);
        return;
      }
  }

  std::vector<fs::path> directories_ = search_path();
  std::set<std::string> seen_;  ///< names of the libraries that need no further attempt
};

}  // namespace

void open_needed_libraries(const fs::path& library) { Opener().open_needed(library); }

}  // namespace pseudorigid::app
