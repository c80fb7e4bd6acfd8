#pragma once
/// The catalogue: the methods, the models of the ball, and the other systems with their entries and columns. Code
/// outside src/scene defines them, and parameter files contain their names. The program passes the catalogue
/// (app/models/catalogue.h) to read_scene. The code in src/scene defines only the system `ball`.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "entries/about.h"
#include "entries/entry_kinds.h"
#include "entries/unit.h"
#include "mechanics/core/by_name.h"
#include "observables/quantities.h"

namespace pseudorigid::scene {

/// A kind of values (entry_kinds.h) whose C++ type is not known here. The scene stores a value of this kind as text in
/// its canonical form, which is the text that the function `print` of the kind returns.
class AnyKind {
 public:
  /// Makes an AnyKind from a kind whose values have the type Value.
  template <class Value, class Kind>
  static AnyKind of(const Kind& kind) {
    AnyKind any;
    any.type = kind.type;
    any.expected_ = kind.expected();
    any.words_ = kind.words();
    any.read_ = [kind](std::string_view text, std::string& canonical) -> Problem {
      Value value{};
      if (Problem problem = kind.read(text, value)) return problem;
      canonical = kind.print(value);
      return std::nullopt;
    };
    return any;
  }

  std::string_view type;
  Problem read(std::string_view text, std::string& canonical) const { return read_(text, canonical); }
  std::string print(const std::string& canonical) const { return canonical; }
  std::string expected() const { return expected_; }
  std::vector<std::string_view> words() const { return words_; }

 private:
  std::function<Problem(std::string_view, std::string&)> read_;
  std::string expected_;
  std::vector<std::string_view> words_;
};

/// An entry of a system other than the ball, and its default value as text.
struct SystemEntry {
  About about;
  AnyKind kind;
  std::string default_text;
};

/// A column of a CSV file. The lists of the columns of a motion omit the first column, which is `time`.
struct Column {
  std::string name;
  Unit unit;
  std::string_view documentation;
};

struct Scene;

/// The path of an entry, and a text that can be read as its value.
struct Setting {
  std::string path, value;
};

/// The reason why a scene is not valid: the entry, a sentence about it, and possible changes of the scene. The
/// functions of scene/advice.h try the changes, and append the successful changes to the sentence.
struct Refusal {
  std::string path, sentence;
  std::vector<std::vector<Setting>> remedies{};  ///< alternative changes; each change sets one or several entries
  /// Models that accept the input. If the list is not empty, `sentence` is incomplete, for example "a sweep is".
  /// scene/advice.h then appends "offered for" and the names of the models.
  std::vector<std::string_view> models{};
};

/// A system other than the ball, as parameter files and the documentation describe it.
struct SystemDescription {
  std::string_view name;           ///< the value of the entry System
  std::string_view file;           ///< name of its CSV file without ".csv"
  std::string_view section;        ///< its subsection in parameter files
  std::string_view documentation;  ///< one sentence for the user about the system
  std::vector<SystemEntry> entries;
  std::vector<Column> columns;  ///< columns for a scene in which the entries have their default values
  /// Returns the columns for a scene. Their number may depend on the values of the entries.
  std::function<std::vector<Column>(const Scene&)> columns_of;
  bool has_equilibria = false;  ///< whether Analysis = equilibrium and manifolds are offered
  bool complete = false;  ///< whether every motion exists for all times; runs backwards in time then exist as well
  /// Returns the error in a scene of this system, or nothing. The range of each single entry has been checked before.
  std::function<std::optional<Refusal>(const Scene&)> refuses;
};

/// A table of equilibria of a model.
struct EquilibriaTable {
  std::string_view file;          ///< name of the CSV file without ".csv"
  std::string_view introduction;  ///< text before the table of columns in the documentation
  std::vector<Column> columns;
};

/// One run of a model of the ball.
struct ModelRun {
  std::string name;           ///< name of its files, without ending and without a prefix such as "love-"
  std::string adjective;      ///< adjective of its ball in sentences, for example "polynomial N = 3"
  bool finds_degree = false;  ///< whether the run finds its degree N; the adjective is then without N
};

/// A model of the ball. Its name is a value of the entry Models.
struct ModelDescription {
  std::string_view name;           ///< its files are `<name>.csv`, `<name>.pvd` and `checkpoint-<name>.bin`
  std::string_view adjective;      ///< adjective of its ball in sentences, for example "elastic"
  std::string_view documentation;  ///< one sentence for the user about the model
  bool by_default = false;         ///< whether a scene without the entry Models uses it
  /// Whether the model has finite elements. Such a model uses the section Continuum and meshes, and has an error of its
  /// discretisation. Several processes may share its computation. The model needs the finite-element library
  /// (app/run/continuum_module.h).
  Required<bool> discretized;
  /// Whether the model has motions that are not affine. An affine motion is x = QX + x_c with a matrix Q and the centre
  /// of mass x_c. Sectors and the columns `nonaffine` are for models with non-affine motions. A model that has only
  /// affine motions is the pseudo-rigid body, and the exact results for this body apply.
  Required<bool> has_nonaffine;
  /// Whether the model offers Analysis = modes, love numbers and equilibrium.
  bool has_modes = false, has_love_numbers = false, has_equilibria = false;
  EquilibriaTable equilibria{};  ///< table of the relative equilibria; used if has_equilibria
  /// Returns the table of the equilibria at rest (Equilibrium/Family = static). `n_modes` is the number of degrees of
  /// freedom of the pseudo-rigid body. The pointer is null if the model does not compute these equilibria.
  EquilibriaTable (*static_equilibria)(int n_modes) = nullptr;
  std::vector<Column> columns;  ///< columns of all groups, for the documentation
  /// All names that a run of the model can have in addition to `name`, for example "polynomial-3". They are ordered by
  /// increasing number of degrees of freedom. The function `runs` selects the runs of a scene. Each run has its own
  /// files.
  std::vector<std::string> rungs{};
  /// Returns the runs of the model in a scene, by increasing number of degrees of freedom. The function is null for a
  /// model with one run, which has the name of the model.
  std::function<std::vector<ModelRun>(const Scene&)> runs{};
  /// Returns the names of the columns of the model's CSV file for the selected groups. The first name is `time`.
  std::function<std::vector<std::string>(const mechanics::Quantities&)> header;
  /// Returns a text about the discretisation of the companion run. The program estimates the error in space of a run
  /// from its difference from the companion run. The result is empty if a search chooses the discretisation. The
  /// function is null for a model without an error in space.
  std::function<std::optional<std::string>(const Scene&)> companion{};
  /// Return the line about the model in the output of `pseudorigid check`: `needed` if the scene runs the model,
  /// otherwise `skipped`.
  std::function<std::string(const Scene&)> needed, skipped;
  /// Returns whether the model can use a method. The pointer is null if the model can use every method.
  bool (*takes_method)(std::string_view name) = nullptr;
  /// Returns the error of the scene for this model, or nothing. The general checks of scene/validate.cpp have accepted
  /// the scene before.
  std::function<std::optional<Refusal>(const Scene&)> refuses;
};

inline bool takes_method(const ModelDescription& model, std::string_view method) {
  return !model.takes_method || model.takes_method(method);
}

/// The runs of the model in a scene: those of `runs`, or one run with the name of the model.
inline std::vector<ModelRun> runs_of(const ModelDescription& model, const Scene& scene) {
  if (model.runs) return model.runs(scene);
  return {{std::string(model.name), std::string(model.adjective)}};
}

/// A method of integration in time. Its name is a value of the entry Time/Method.
struct NamedMethod {
  std::string_view name, documentation;
};

struct Catalogue {
  std::vector<NamedMethod> methods;
  /// The models by increasing number of degrees of freedom. The last model of a scene is the reference of comparisons.
  std::vector<ModelDescription> models{};
  std::vector<SystemDescription> systems{};
  /// The columns of connections.csv, which Analysis = manifolds writes for systems other than the ball.
  std::vector<Column> connections{};
  /// The columns of equilibria.csv for a system with one degree of freedom, for the documentation. The list does not
  /// contain the coordinates of the system.
  std::vector<Column> equilibria{};

  /// The system of this name. The result is null for the ball and for an unknown name.
  const SystemDescription* system(std::string_view name) const {
    for (const SystemDescription& system : systems)
      if (system.name == name) return &system;
    return nullptr;
  }
};

inline const Catalogue empty_catalogue;

}  // namespace pseudorigid::scene
