#pragma once
/// A binary file of named values that contains the state of a run. A new file replaces an old file atomically. The
/// format of the file is
///
///   header   magic "PSRGCKPT" | endianness tag u32 | version u32 | payload size u64 | FNV-1a of the payload u64
///   payload  a section for each value: type u8 | name length u32 | name | count u64 | count values
///
/// The type is 0 for a list of f64, 1 for one i64 and 2 for a text of chars. All numbers have the byte order of the
/// machine that wrote the file.

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pseudorigid::io {

/// The FNV-1a hash with 64 bits. A change of a single byte always changes the hash.
std::uint64_t checksum(std::string_view bytes);

class Checkpoint {
 public:
  /// Sets the entry `name` to a list of numbers, a text, a number or an integer. A number is stored as a list of
  /// size 1. The new value replaces an old value of this entry.
  void set(const std::string& name, std::span<const double> values);
  void set(const std::string& name, std::vector<double> values);
  void set(const std::string& name, std::string text);
  void set(const std::string& name, double value) { set(name, std::span<const double>(&value, 1)); }
  template <std::integral Integer>
  void set(const std::string& name, Integer value) {
    values_[name] = static_cast<std::int64_t>(value);
  }

  bool has(const std::string& name) const { return values_.contains(name); }
  /// The value of the entry `name`. If the entry is missing, or has another type or another number of values than
  /// expected, throws a UserError that names the file and the entry. The references are valid until the entry is set
  /// again.
  const std::vector<double>& get_doubles(const std::string& name) const;
  const std::vector<double>& get_doubles(const std::string& name, std::size_t expected_size) const;
  double get_double(const std::string& name) const { return get_doubles(name, 1)[0]; }
  std::int64_t get_integer(const std::string& name) const;
  const std::string& get_string(const std::string& name) const;

  /// Writes the file. Throws WriteError if the file cannot be written.
  void save(const std::filesystem::path& path) const;
  /// Reads a file, and verifies the sizes and the checksum. Throws UserError if the file cannot be read, is truncated
  /// or altered, or is of another kind, format version or byte order.
  static Checkpoint load(const std::filesystem::path& path);

 private:
  using Value = std::variant<std::vector<double>, std::int64_t, std::string>;
  template <class T>
  const T& get(const std::string& name, const char* type) const;
  std::map<std::string, Value> values_;
  std::filesystem::path path_;  ///< path of the loaded file, for messages; empty without `load`
};

}  // namespace pseudorigid::io
