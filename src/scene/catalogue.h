#pragma once
/// Content of parameter files that other layers define: the names of the methods, the models of the ball, and the
/// systems other than the ball with their entries and columns. The program hands the catalogue to read_scene
/// (app/models/catalogue.h). The scene layer itself defines only the ball.

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

/// A kind of values (entry_kinds.h) without the type of its values: the scene keeps the text itself in its canonical
/// form.
class AnyKind {
 public:
  /// The kind, for members of type Value.
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

struct SystemEntry {
  About about;
  AnyKind kind;
  std::string default_text;
};

/// A column of a system's CSV file; `time` comes first in every file and is not listed.
struct Column {
  std::string name;
  Unit unit;
  std::string_view documentation;
};

struct Scene;

/// An entry and the text to give it.
struct Setting {
  std::string path, value;
};

/// The reason why a scene cannot be run: the entry, a sentence about it, and possible changes. scene/advice.h completes
/// the sentence by the changes with which the scene would be accepted.
struct Refusal {
  std::string path, sentence;
  std::vector<std::vector<Setting>> remedies{};  ///< each would do
  std::vector<std::string_view>
      models{};  ///< models that accept the refused input: the sentence ends before "offered for"
};

struct SystemDescription {
  std::string_view name;           ///< the value of the entry System
  std::string_view file;           ///< name of its CSV file, without ".csv"
  std::string_view section;        ///< its subsection
  std::string_view documentation;  ///< a sentence for people
  std::vector<SystemEntry> entries;
  std::vector<Column> columns;  ///< of a scene of defaults
  /// The columns for a scene, if their number depends on its values.
  std::function<std::vector<Column>(const Scene&)> columns_of;
  bool has_equilibria = false;  ///< Analysis = equilibrium, manifolds are offered
  bool complete = false;        ///< every motion exists for all time: it may be run backwards
  /// The error in a scene of this system, if there is one, in addition to each entry's own range.
  std::function<std::optional<Refusal>(const Scene&)> refuses;
};

/// The table of relative equilibria that a model writes.
struct EquilibriaTable {
  std::string_view file;  ///< without ".csv"
  std::string_view introduction;
  std::vector<Column> columns;
};

/// One run of a model of the ball.
struct ModelRun {
  std::string name;           ///< of its files
  std::string adjective;      ///< adjective of its ball in sentences: "polynomial N = 3"
  bool finds_degree = false;  ///< the run finds its degree N, its counter `degree`, which belongs to the adjective
};

/// A model of the ball, one word of the entry Models.
struct ModelDescription {
  std::string_view name;           ///< the word; its files are `<name>.csv`, `<name>.pvd`, `checkpoint-<name>.bin`
  std::string_view adjective;      ///< adjective of its ball in sentences: "elastic"
  std::string_view documentation;  ///< a sentence for people
  bool by_default = false;         ///< chosen if the scene does not say
  /// It has elements in space: section Continuum and meshes concern it, it has an error of its discretisation, several
  /// processes may share it, and it runs in the executable that links deal.II.
  Required<bool> discretized;
  /// It moves in other ways than x = QX: sectors and the columns `nonaffine` concern it. A model that does not is the
  /// pseudo-rigid body, whose exact results hold for it.
  Required<bool> has_nonaffine;
  /// Analysis = modes, love numbers, equilibrium are offered.
  bool has_modes = false, has_love_numbers = false, has_equilibria = false;
  EquilibriaTable equilibria{};  ///< if they are offered
  /// Columns of equilibria.csv for equilibria at rest, Equilibrium/Family = static, of a body with so many degrees of
  /// freedom; null if the model does not find them.
  std::vector<Column> (*static_equilibria)(int n_modes) = nullptr;
  std::vector<Column> columns;  ///< of all groups, as documented
  /// Names of further runs of the model that a scene may request, with their own files, by rising number of motions.
  std::vector<std::string> rungs{};
  /// The runs of the model that the scene requests, by rising number of motions; empty: one run with the model's name.
  std::function<std::vector<ModelRun>(const Scene&)> runs{};
  /// The header of its CSV file.
  std::function<std::vector<std::string>(const mechanics::Quantities&)> header;
  /// The discretisation of the run by which its error in space is estimated, in words; none of a scene that leaves the
  /// discretisation to a search. Null for a model that has no such error.
  std::function<std::optional<std::string>(const Scene&)> companion{};
  /// The line for people of a scene that runs it, and of one that does not.
  std::function<std::string(const Scene&)> needed, skipped;
  /// Whether a method can integrate the model. Null if every method can.
  bool (*takes_method)(std::string_view name) = nullptr;
  /// The error in a valid scene for this model, if there is one.
  std::function<std::optional<Refusal>(const Scene&)> refuses;
};

inline bool takes_method(const ModelDescription& model, std::string_view method) {
  return !model.takes_method || model.takes_method(method);
}

inline std::vector<ModelRun> runs_of(const ModelDescription& model, const Scene& scene) {
  if (model.runs) return model.runs(scene);
  return {{std::string(model.name), std::string(model.adjective)}};
}

struct NamedMethod {
  std::string_view name, documentation;
};

struct Catalogue {
  std::vector<NamedMethod> methods;
  /// By rising number of motions: the others are compared with the last model of a scene.
  std::vector<ModelDescription> models{};
  std::vector<SystemDescription> systems{};
  /// Columns of connections.csv.
  std::vector<Column> connections{};
  /// Columns of equilibria.csv, for a system of one degree of freedom and without those of its coordinates.
  std::vector<Column> equilibria{};

  /// Null for the ball.
  const SystemDescription* system(std::string_view name) const {
    for (const SystemDescription& system : systems)
      if (system.name == name) return &system;
    return nullptr;
  }
};

inline const Catalogue empty_catalogue;

}  // namespace pseudorigid::scene
