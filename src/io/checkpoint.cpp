#include "io/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>

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

enum class SectionType : std::uint8_t { doubles, integer, text };  // in the order of the variant's alternatives

template <class T>
void append_bytes(std::string& out, const T* values, std::size_t n) {
  out.append(reinterpret_cast<const char*>(values), n * sizeof(T));
}

/// Takes values from the front of a payload; asks for the size before it believes a count.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}
  bool at_end() const { return rest_.empty(); }

  template <class T>
  void take(T* values, std::size_t n) {
    if (n > rest_.size() / sizeof(T)) throw std::out_of_range("a section is longer than the file");
    // Not memcpy, which takes no null pointer even for n = 0.
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

/// The payload of a file whose header, size and checksum agree.
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

std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3u;
  return hash;
}

void Checkpoint::set(const std::string& name, std::span<const double> values) {
  values_[name] = std::vector<double>(values.begin(), values.end());
}
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

void Checkpoint::save(const std::filesystem::path& path) const {
  std::string payload;
  const auto count = [&](std::uint64_t n) { append_bytes(payload, &n, 1); };
  for (const auto& [name, value] : values_) {
    payload += static_cast<char>(value.index());
    const auto name_length = static_cast<std::uint32_t>(name.size());
    append_bytes(payload, &name_length, 1);
    payload += name;
    if (const auto* doubles = std::get_if<std::vector<double>>(&value)) {
      count(doubles->size());
      append_bytes(payload, doubles->data(), doubles->size());
    } else if (const auto* integer = std::get_if<std::int64_t>(&value)) {
      count(1);
      append_bytes(payload, integer, 1);
    } else {
      const auto& text = std::get<std::string>(value);
      count(text.size());
      payload += text;
    }
  }
  Header header;
  header.payload_size = payload.size();
  header.payload_checksum = checksum(payload);
  write_file_atomically(path, {{reinterpret_cast<const char*>(&header), sizeof header}, payload});
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
