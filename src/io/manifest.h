#pragma once
/// manifest.json: scene, program, machine, duration and end of a run.

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

/// A run of a model of the ball, as readers of the manifest want to know it.
struct BallRun {
  scene::ModelRun run;
  bool discretized = false;
  bool affine = false;  ///< it moves as x = QX
};

struct Manifest {
  struct Model {
    std::map<std::string, double> counters{}, timers{};  ///< counts; seconds
    std::string method{};                                ///< of integration in time; empty if there is none
    bool symplectic = false;                             ///< whether the method is
  };
  BuildInfo build;                                            ///< build_info(), from the executable
  std::vector<std::string> command;                           ///< argv
  std::string title;                                          ///< of the scene
  std::string scene;                                          ///< in one line
  std::vector<scene::UsedValue> entries;                      ///< of the scene
  std::vector<std::string> needed, skipped, warnings;         ///< lines for people
  std::string system;                                         ///< name of its CSV file; empty for the ball
  std::map<std::string, std::vector<scene::Column>> columns;  ///< by file, without the time
  std::optional<Units> units;                                 ///< scales of a ball: the scene's own units in the files
  std::map<std::string, std::string> libraries;               ///< name → version
  std::string instructions;                                   ///< instructions of the kernels; empty without kernels
  std::vector<BallRun> ball;                                  ///< the runs of models of the ball, in their order
  std::map<std::string, Model> models;                        ///< the models or the system of the run, by name
};

/// Keeps manifest.json true: written when the run starts (state "running"), by finish, and, without a call of finish,
/// by the destructor (state "failed"), so that a thrown exception leaves a manifest too.
class ManifestFile {
 public:
  ManifestFile(std::filesystem::path path, Manifest content);
  ~ManifestFile();
  ManifestFile(const ManifestFile&) = delete;
  ManifestFile& operator=(const ManifestFile&) = delete;

  Manifest& content() { return content_; }
  const Manifest& content() const { return content_; }
  /// The state becomes "done", "interrupted" or "failed"; `message` is the sentence that the user saw, if any. If the
  /// disk has no room for a new file, the old file says "failed" in place of "running", and the WriteError is rethrown.
  void finish(mechanics::Outcome outcome, int exit_code, const std::string& message = {});

 private:
  struct End {
    mechanics::Outcome outcome;
    std::optional<int> exit_code{};
    std::string message{};
  };
  /// Without an end, the run is in progress.
  void write(const std::optional<End>& end);
  std::filesystem::path path_;
  Manifest content_;
  std::chrono::system_clock::time_point start_;
  bool finished_ = false;
};

/// Called by a rank that aborts the run but does not keep the manifest. Errors are ignored.
void note_failure(const std::filesystem::path& manifest, int exit_code, const std::string& message) noexcept;

/// Names of the trajectories listed in a run's manifest: of the system, or of the models of the ball.
/// UserError if the file is not a manifest of this program, or if its version did not record the data that a report
/// needs.
std::vector<std::string> movers_in(const std::filesystem::path& manifest);
/// The models among them that move as x = QX. Empty if the file is not a manifest.
std::vector<std::string> affine_movers_in(const std::filesystem::path& manifest);

/// The processor's name from /proc/cpuinfo, "unknown" without one.
std::string cpu_model();
/// Largest resident set of this process so far, in bytes; 0 if the system does not say.
std::int64_t peak_memory();

}  // namespace pseudorigid::io
