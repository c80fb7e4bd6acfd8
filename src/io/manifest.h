#pragma once
/// The file manifest.json of a run. It describes the scene, the program, the machine, the columns of the CSV files, and
/// the duration, counters and end of the run.

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

/// A run of a model of the ball, with two properties of the model.
struct BallRun {
  scene::ModelRun run;
  bool discretized = false;  ///< true if the model uses a mesh of finite elements
  bool affine = false;       ///< true if the motion is affine: x = QX + x_c with a matrix Q and the centre of mass x_c
};

/// The content of manifest.json that the caller provides. ManifestFile adds the name of the processor, and the state
/// and start of the run. At the end of the run, ManifestFile adds its end, duration and largest memory, and the exit
/// code and the message if they are known.
struct Manifest {
  /// Counters, times and method of a run of a model or a system.
  struct Model {
    std::map<std::string, double> counters{}, timers{};  ///< counts and other numbers, and times in seconds, by name
    std::string method{};     ///< name of the method of integration; empty without integration in time
    bool symplectic = false;  ///< true if the method is symplectic; not written if `method` is empty
  };
  BuildInfo build;                   ///< result of build_info()
  std::vector<std::string> command;  ///< arguments of the program (argv)
  std::string title;                 ///< the entry Title of the scene
  std::string scene;                 ///< result of scene::summary, one line
  /// The paths and values of all entries that concern the system of the scene (scene::used_values).
  std::vector<scene::UsedValue> entries;
  /// Lines for the user: the parts of the program that the scene needs, the skipped parts, and warnings.
  std::vector<std::string> needed, skipped, warnings;
  std::string system;  ///< name of the CSV file of a system, without ".csv"; empty for the ball
  /// The columns of each CSV file, by the name of the file with ".csv". A list for a motion omits the column `time`.
  std::map<std::string, std::vector<scene::Column>> columns;
  /// The internal units of a ball, in the units of the user; empty for other systems.
  std::optional<Units> units;
  std::map<std::string, std::string> libraries;  ///< versions of the libraries in use, by name
  std::string instructions;             ///< instruction set of the compiled kernels in use; empty without kernels
  std::vector<BallRun> ball;            ///< models of the ball in the order of their runs
  std::map<std::string, Model> models;  ///< results of the runs, by the name of their CSV file without ".csv"
};

/// Writes manifest.json. The constructor writes the file with the state "running", and `finish` writes the file with
/// the final state. The constructor and `finish` throw WriteError if the file cannot be written. If `finish` is not
/// called, for example after an exception, the destructor writes the state "failed" and ignores errors.
class ManifestFile {
 public:
  ManifestFile(std::filesystem::path path, Manifest content);
  ~ManifestFile();
  ManifestFile(const ManifestFile&) = delete;
  ManifestFile& operator=(const ManifestFile&) = delete;

  /// The content that `finish` will write. The caller may change it during the run.
  Manifest& content() { return content_; }
  const Manifest& content() const { return content_; }
  /// Writes the file with the state "done", "interrupted" or "failed". `message` is the sentence that the program has
  /// shown to the user about the end of the run. It may be empty. If the new file cannot be written, the state "failed"
  /// replaces "running" in the old file, and the WriteError is rethrown.
  void finish(mechanics::Outcome outcome, int exit_code, const std::string& message = {});

 private:
  struct End {
    mechanics::Outcome outcome;
    std::optional<int> exit_code{};
    std::string message{};
  };
  /// Writes the file. `end` is empty during the run.
  void write(const std::optional<End>& end);
  std::filesystem::path path_;
  Manifest content_;
  std::chrono::system_clock::time_point start_;
  bool finished_ = false;
};

/// Writes the time of the end, the state "failed", the exit code and the message into an existing manifest. A rank that
/// does not have the ManifestFile calls this function if it aborts the run. Errors are ignored.
void note_failure(const std::filesystem::path& manifest, int exit_code, const std::string& message) noexcept;

/// The names of the trajectories in a manifest: the name of the CSV file of a system without ".csv", or the names of
/// the runs of the ball (BallRun). Throws UserError if the file cannot be read, is not a manifest of this program, or
/// contains a name with a slash. Also throws UserError if the manifest lacks the entries of the scene, which a report
/// needs. Earlier versions of the program did not write them.
std::vector<std::string> movers_in(const std::filesystem::path& manifest);
/// The names of the runs of the ball in a manifest whose motion is affine (BallRun::affine). The result is empty if the
/// file does not exist, is not a manifest, or belongs to a system other than the ball. Throws UserError if the file
/// exists but cannot be read.
std::vector<std::string> affine_movers_in(const std::filesystem::path& manifest);

/// The name of the processor in /proc/cpuinfo, or "unknown".
std::string cpu_model();
/// The largest memory that this process has used so far (peak resident set size), in bytes. The result is 0 if the
/// system does not report it.
std::int64_t peak_memory();

}  // namespace pseudorigid::io
