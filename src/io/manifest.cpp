#include "io/manifest.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/files.h"
#include "scene/user_error.h"

namespace pseudorigid::io {

namespace {

using Json = nlohmann::ordered_json;
using SystemClock = std::chrono::system_clock;

std::string utc(SystemClock::time_point time) {
  const std::time_t seconds = SystemClock::to_time_t(time);
  std::tm parts;
  gmtime_r(&seconds, &parts);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

/// A number in JSON. Integers of absolute value below 9e15 are written without ".0". They are exact, because a double
/// represents all integers below 2⁵³ > 9e15.
Json number(double value) {
  const bool is_count = std::abs(value) < 9e15 && value == std::floor(value);
  return is_count ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

Json numbers(const std::map<std::string, double>& values) {
  Json object = Json::object();
  for (const auto& [name, value] : values) object[name] = number(value);
  return object;
}

/// The list of the columns in JSON. With `units`, each column has a factor, its internal unit expressed in the unit of
/// the user. A value in the CSV file divided by this factor is in internal units.
Json to_json(const std::vector<scene::Column>& columns, const std::optional<Units>& units) {
  Json list = Json::array();
  for (const scene::Column& column : columns) {
    Json& json = list.emplace_back(
        Json{{"name", column.name}, {"unit", std::string_view(column.unit)}, {"meaning", column.documentation}});
    if (units) json["factor"] = units->to_physical(1, column.unit);
  }
  return list;
}

Json to_json(const Manifest& content) {
  Json json;
  json["program"] = "pseudorigid";
  json["version"] = content.build.version;
  json["git_hash"] = content.build.git_hash;
  json["compiler"] = content.build.compiler;
  json["flags"] = content.build.flags;
  json["build_type"] = content.build.build_type;
  json["libraries"] = content.libraries;
  json["cpu"] = cpu_model();
  if (!content.instructions.empty()) json["instructions"] = content.instructions;
  json["command"] = content.command;
  json["title"] = content.title;
  json["scene"] = content.scene;
  json["entries"] = Json::object();
  for (const auto& [path, value] : content.entries) json["entries"][path] = value;
  if (!content.system.empty()) json["system"] = content.system;
  json["needed"] = content.needed;
  json["skipped"] = content.skipped;
  json["warnings"] = content.warnings;
  for (const auto& [file, columns] : content.columns) json["columns"][file] = to_json(columns, content.units);
  if (content.units) json["unit_of_time"] = content.units->time;
  for (const auto& [run, discretized, affine] : content.ball) {
    json["ball"].push_back(
        {{"name", run.name}, {"adjective", run.adjective}, {"discretized", discretized}, {"affine", affine}});
    if (run.finds_degree) json["ball"].back()["finds_degree"] = true;
  }
  json["models"] = Json::object();
  for (const auto& [name, model] : content.models) {
    Json& entry = json["models"][name] = {{"counters", numbers(model.counters)}, {"timers", numbers(model.timers)}};
    if (model.method.empty()) continue;
    entry["method"] = model.method;
    entry["symplectic"] = model.symplectic;
  }
  return json;
}

std::string to_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string_view state_word(mechanics::Outcome outcome) {
  switch (outcome) {
    case mechanics::Outcome::finished:
      return "done";
    case mechanics::Outcome::interrupted:
      return "interrupted";
    case mechanics::Outcome::failed:
      return "failed";
  }
  return "failed";
}

/// Overwrites the state "running" in the file with "failed". A space gives both texts the same length, so that the file
/// does not need additional space on the disk. Errors are ignored.
void replace_running_by_failed(const std::filesystem::path& path) noexcept try {
  constexpr std::string_view running = "\"state\": \"running\"", failed = "\"state\": \"failed\" ";
  static_assert(running.size() == failed.size());
  const std::size_t at = read_file(path).find(running);
  const int file = at == std::string::npos ? -1 : ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  [[maybe_unused]] const auto n_written = ::pwrite(file, failed.data(), failed.size(), static_cast<off_t>(at));
  ::close(file);
} catch (const std::exception&) {
}

}  // namespace

void note_failure(const std::filesystem::path& manifest, int exit_code, const std::string& message) noexcept try {
  Json json = Json::parse(read_file(manifest));
  json["end"] = utc(SystemClock::now());
  json["state"] = state_word(mechanics::Outcome::failed);
  json["exit_code"] = exit_code;
  json["message"] = message;
  write_file_atomically(manifest, {to_text(json)});
} catch (const std::exception&) {
}

std::vector<std::string> movers_in(const std::filesystem::path& manifest) {
  constexpr bool throws = false;
  const Json json = Json::parse(read_file(manifest), nullptr, throws);
  const auto text = [](const Json& object, const char* name) {
    const auto found = object.find(name);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  std::vector<std::string> movers;
  bool sound = json.is_object() && text(json, "program") == "pseudorigid";
  if (sound && json.contains("system")) movers.push_back(text(json, "system"));
  if (sound && json.contains("ball"))
    for (const Json& model : json["ball"]) movers.push_back(text(model, "name"));
  // The report reads files with these names in the run directory, so a slash is not permitted.
  for (const std::string& name : movers) sound = sound && name.find('/') == name.npos;
  if (!sound) throw UserError(fmt::format("'{}' is not the manifest of a run of pseudorigid", manifest.native()));
  if (!json.contains("entries"))
    throw UserError(
        fmt::format("'{}' is of an earlier version, which did not record the values of the entries; run the scene "
                    "again, as used.prm in its folder has it",
                    manifest.native()));
  return movers;
}

std::vector<std::string> affine_movers_in(const std::filesystem::path& manifest) {
  constexpr bool throws = false;
  if (!is_there(manifest)) return {};
  const Json json = Json::parse(read_file(manifest), nullptr, throws);
  std::vector<std::string> movers;
  if (!json.is_object() || !json.contains("ball")) return {};
  for (const Json& model : json["ball"])
    if (model.is_object() && model.contains("name") && model["name"].is_string() && model.contains("affine") &&
        model["affine"] == true)
      movers.push_back(model["name"]);
  return movers;
}

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != line.npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::int64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string name; status >> name;)
    if (std::int64_t kilobytes = 0; name == "VmHWM:" && status >> kilobytes) return 1024 * kilobytes;
  return 0;
}

ManifestFile::ManifestFile(std::filesystem::path path, Manifest content)
    : path_(std::move(path)), content_(std::move(content)), start_(SystemClock::now()) {
  write(std::nullopt);
}

ManifestFile::~ManifestFile() {
  if (finished_) return;
  try {
    write(End{mechanics::Outcome::failed});
  } catch (const std::exception&) {
  }
}

void ManifestFile::finish(mechanics::Outcome outcome, int exit_code, const std::string& message) {
  finished_ = true;
  write(End{outcome, exit_code, message});
}

void ManifestFile::write(const std::optional<End>& end) {
  Json json = to_json(content_);
  json["start"] = utc(start_);
  json["state"] = "running";
  if (end) {
    const auto now = SystemClock::now();
    json["end"] = utc(now);
    json["wall_seconds"] = std::chrono::duration<double>(now - start_).count();
    json["peak_memory_bytes"] = peak_memory();
    json["state"] = state_word(end->outcome);
    if (end->exit_code) json["exit_code"] = *end->exit_code;
    if (!end->message.empty()) json["message"] = end->message;
  }
  try {
    write_file_atomically(path_, {to_text(json)});
  } catch (const WriteError&) {
    if (end) replace_running_by_failed(path_);
    throw;
  }
}

}  // namespace pseudorigid::io
