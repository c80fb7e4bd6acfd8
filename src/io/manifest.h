#pragma once
/// The file manifest.json, which describes scene, program, machine, duration and end of a run.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "entries/units.h"
#include "io/build_info.h"
#include "mechanics/core/outcome.h"
#include "scene/catalogue.h"
#include "scene/print_scene.h"

namespace pseudorigid::io {

/// A run of a model of the ball, with its data for the manifest.
struct BallRun {
  scene::ModelRun run;
  bool discretized = false;
  bool affine = false;  ///< its motion is x = QX with a matrix Q
};

struct Manifest {
  struct Model {
    std::map<std::string, double> counters{}, timers{};  ///< counts of events; times in seconds
    std::string method{};     ///< name of the method of integration; empty without integration in time
    bool symplectic = false;  ///< whether the method is symplectic
  };
  BuildInfo build;                                            ///< result of build_info()
  std::vector<std::string> command;                           ///< arguments of the program (argv)
  std::string title;                                          ///< title of the scene
  std::string scene;                                          ///< the scene in one line
  std::vector<scene::UsedValue> entries;                      ///< entries of the scene
  std::vector<std::string> needed, skipped, warnings;         ///< lines of text for the user
  std::string system;                                         ///< name of the system's CSV file; empty for the ball
  std::map<std::string, std::vector<scene::Column>> columns;  ///< columns of each file, without the time
  std::optional<Units> units;                                 ///< scales of a ball, by which files convert its numbers
  std::map<std::string, std::string> libraries;               ///< name → version
  std::string instructions;                                   ///< instruction set of the kernels; empty without kernels
  std::vector<BallRun> ball;                                  ///< runs of models of the ball, in their order
  std::map<std::string, Model> models;                        ///< results of the models or of the system, by name
};

/// Keeps manifest.json up to date. The constructor writes the state "running" and `finish` the final state. Without a
/// call of `finish`, the destructor writes the state "failed", for example after an exception.
class ManifestFile {
 public:
  ManifestFile(std::filesystem::path path, Manifest content);
  ~ManifestFile();
  ManifestFile(const ManifestFile&) = delete;
  ManifestFile& operator=(const ManifestFile&) = delete;

  Manifest& content() { return content_; }
  const Manifest& content() const { return content_; }
  /// Writes the state "done", "interrupted" or "failed". `message` is the sentence that the user saw, if any. If the
  /// disk is full, the state "failed" replaces "running" in the old file, and the WriteError is rethrown.
  void finish(mechanics::Outcome outcome, int exit_code, const std::string& message = {});

 private:
  struct End {
    mechanics::Outcome outcome;
    std::optional<int> exit_code{};
    std::string message{};
  };
  /// `end` is empty while the run is in progress.
  void write(const std::optional<End>& end);
  std::filesystem::path path_;
  Manifest content_;
  std::chrono::system_clock::time_point start_;
  bool finished_ = false;
};

/// Writes the state "failed". A rank calls this function if it aborts the run but does not own the ManifestFile. It
/// ignores errors.
void note_failure(const std::filesystem::path& manifest, int exit_code, const std::string& message) noexcept;

/// Names of the trajectories in the manifest of a run: of the system, or of the models of the ball. UserError if the
/// file is not a manifest of this program, or if an earlier version did not record the entries for a report.
std::vector<std::string> movers_in(const std::filesystem::path& manifest);
/// Names of the models of the ball with the motion x = QX, Q a matrix. Empty if the file is not a manifest.
std::vector<std::string> affine_movers_in(const std::filesystem::path& manifest);

/// The name of the processor in /proc/cpuinfo, or "unknown".
std::string cpu_model();
/// The largest memory of this process so far (peak resident set size) in bytes, or 0 if the system does not state it.
std::int64_t peak_memory();

}  // namespace pseudorigid::io
