#include "io/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <fstream>
#include <limits>
#include <type_traits>
#include <utility>

#include "io/files.h"
#include "scene/user_error.h"

namespace pseudorigid::io {

static_assert(sizeof(double) == 8 && std::numeric_limits<double>::is_iec559);

namespace {

struct Header {
  char magic[8] = {'P', 'S', 'R', 'G', 'C', 'K', 'P', 'T'};
  std::uint32_t endianness = 0x01020304;
  std::uint32_t version = 1;
  std::uint64_t payload_size = 0, payload_checksum = 0;
};
static_assert(sizeof(Header) == 32);

/// The type of a value in the file. The enumerators have the order of the types in the variant Checkpoint::Value,
/// because save() writes the index of the type in this variant.
enum class SectionType : std::uint8_t { doubles, integer, text };

template <class T>
std::string_view bytes_of(const T* values, std::size_t n = 1) {
  return {reinterpret_cast<const char*>(values), n * sizeof(T)};
}

/// Returns the FNV-1a hash of a text that consists of bytes with the hash `hash`, followed by `bytes`. With this
/// function, save() hashes the parts of a file one after the other.
std::uint64_t hash_on(std::uint64_t hash, std::string_view bytes) {
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3u;
  return hash;
}
constexpr std::uint64_t hash_of_nothing = 0xcbf29ce484222325u;

/// Reads values from a payload, one after the other. Throws std::out_of_range if not enough bytes remain for a value.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}
  bool at_end() const { return rest_.empty(); }

  template <class T>
  void take(T* values, std::size_t n) {
    if (n > rest_.size() / sizeof(T)) throw std::out_of_range("a section is longer than the file");
    // If n = 0, the pointers may be null. This is permitted for copy_n, but not for memcpy.
    std::copy_n(rest_.data(), n * sizeof(T), reinterpret_cast<char*>(values));
    rest_.remove_prefix(n * sizeof(T));
  }
  template <class T>
  T take_one() {
    T value;
    take(&value, 1);
    return value;
  }
  std::string take_text(std::size_t n) {
    if (n > rest_.size()) throw std::out_of_range("a section is longer than the file");
    std::string text(rest_.substr(0, n));
    rest_.remove_prefix(n);
    return text;
  }
  std::vector<double> take_doubles(std::size_t n) {
    if (n > rest_.size() / sizeof(double)) throw std::out_of_range("a section is longer than the file");
    std::vector<double> values(n);
    take(values.data(), n);
    return values;
  }

 private:
  std::string_view rest_;
};

UserError unusable(const std::filesystem::path& path, const std::string& reason) {
  return UserError(fmt::format("the checkpoint '{}' cannot be used: {}", path.native(), reason));
}

/// The payload of a checkpoint file, as bytes. Throws UserError if the file cannot be read, or if its header, size or
/// checksum is wrong.
std::string read_payload(const std::filesystem::path& path) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) throw unusable(path, error.message());
  std::ifstream file(path, std::ios::binary);
  const Header expected;
  Header header;
  if (size < sizeof header || !file.read(reinterpret_cast<char*>(&header), sizeof header))
    throw unusable(path, "it is too short");
  if (std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0)
    throw unusable(path, "it is another kind of file");
  if (header.endianness != expected.endianness) throw unusable(path, "it comes from a machine with another byte order");
  if (header.version != expected.version)
    throw unusable(path,
                   fmt::format("it has format version {}, this program reads {}", header.version, expected.version));
  if (header.payload_size != size - sizeof header) throw unusable(path, "it is incomplete or has been extended");
  std::string payload(header.payload_size, '\0');
  if (!file.read(payload.data(), static_cast<std::streamsize>(payload.size())))
    throw unusable(path, "it cannot be read");
  if (checksum(payload) != header.payload_checksum) throw unusable(path, "it is damaged (wrong checksum)");
  return payload;
}

}  // namespace

std::uint64_t checksum(std::string_view bytes) { return hash_on(hash_of_nothing, bytes); }

void Checkpoint::set(const std::string& name, std::span<const double> values) {
  set(name, std::vector<double>(values.begin(), values.end()));
}
void Checkpoint::set(const std::string& name, std::vector<double> values) { values_[name] = std::move(values); }
void Checkpoint::set(const std::string& name, std::string text) { values_[name] = std::move(text); }

template <class T>
const T& Checkpoint::get(const std::string& name, const char* type) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw unusable(path_, fmt::format("it has no entry '{}'", name));
  const T* value = std::get_if<T>(&found->second);
  if (value == nullptr) throw unusable(path_, fmt::format("its entry '{}' is not {}", name, type));
  return *value;
}

const std::vector<double>& Checkpoint::get_doubles(const std::string& name) const {
  return get<std::vector<double>>(name, "a list of numbers");
}

const std::vector<double>& Checkpoint::get_doubles(const std::string& name, std::size_t expected_size) const {
  const auto& values = get_doubles(name);
  if (values.size() != expected_size)
    throw unusable(path_,
                   fmt::format("its entry '{}' has {} numbers, expected {}", name, values.size(), expected_size));
  return values;
}

std::int64_t Checkpoint::get_integer(const std::string& name) const { return get<std::int64_t>(name, "an integer"); }
const std::string& Checkpoint::get_string(const std::string& name) const { return get<std::string>(name, "a text"); }

/// The function does not copy the values, because a copy of a large state may not fit into memory.
void Checkpoint::save(const std::filesystem::path& path) const {
  std::deque<std::string> heads;  // a deque does not move its elements, to which `parts` refers
  std::vector<std::string_view> parts(1);
  for (const auto& [name, value] : values_) {
    const auto [n, bytes] = std::visit(
        []<class V>(const V& v) -> std::pair<std::uint64_t, std::string_view> {
          if constexpr (std::is_same_v<V, std::int64_t>)
            return {1, bytes_of(&v)};
          else
            return {v.size(), bytes_of(v.data(), v.size())};
        },
        value);
    const auto type = static_cast<char>(value.index());
    const auto name_length = static_cast<std::uint32_t>(name.size());
    heads.push_back(fmt::format("{}{}{}{}", type, bytes_of(&name_length), name, bytes_of(&n)));
    parts.insert(parts.end(), {heads.back(), bytes});
  }
  Header header;
  header.payload_checksum = hash_of_nothing;
  for (const std::string_view part : parts) {
    header.payload_size += part.size();
    header.payload_checksum = hash_on(header.payload_checksum, part);
  }
  parts.front() = bytes_of(&header);
  write_file_atomically(path, parts);
}

Checkpoint Checkpoint::load(const std::filesystem::path& path) {
  const std::string payload = read_payload(path);
  Checkpoint checkpoint;
  checkpoint.path_ = path;
  try {
    for (Cursor cursor(payload); !cursor.at_end();) {
      const auto type = cursor.take_one<SectionType>();
      std::string name = cursor.take_text(cursor.take_one<std::uint32_t>());
      const auto n = cursor.take_one<std::uint64_t>();
      Value value;
      switch (type) {
        case SectionType::doubles:
          value = cursor.take_doubles(n);
          break;
        case SectionType::text:
          value = cursor.take_text(n);
          break;
        case SectionType::integer:
          if (n != 1) throw std::out_of_range("an integer entry is a list");
          value = cursor.take_one<std::int64_t>();
          break;
        default:
          throw std::out_of_range("it has an entry of unknown type");
      }
      checkpoint.values_[std::move(name)] = std::move(value);
    }
  } catch (const std::out_of_range& error) {
    throw unusable(path, error.what());
  }
  return checkpoint;
}

}  // namespace pseudorigid::io
