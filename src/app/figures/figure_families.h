#pragma once
/// Families of figures of equilibrium of polynomial bodies and finite elements (mechanics/equilibria/figure_family.h).
/// The file has the family that a scene requests, and the table of its members.

#include <complex>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/figures/family_checkpoint.h"
#include "app/run/run_context.h"
#include "io/column_table.h"
#include "io/progress.h"
#include "mechanics/equilibria/figure_family.h"
#include "observables/body_observables.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// True if the analysis computes figures of the model, or if a motion starts from such a figure.
bool needs_own_figures(const scene::Scene& scene);

/// The refusal if the scene requests a family that is not in `offered`, otherwise empty. The family is that of the
/// analysis or, for a motion, that of the initial state. `model` is the subject of the message.
/// Its remedy is the pseudo-rigid model.
std::optional<scene::Refusal> refuses_family(const scene::Scene& scene, std::string_view model,
                                             const std::vector<scene::Family>& offered);

/// The names of the models with only affine motions that could run the scene.
std::vector<std::string_view> affine_models(const scene::Scene& scene);

/// The refusal of dissipation in an analysis of equilibria with small motions and, for equilibria at rest, of loads
/// without the symmetry planes of the octant; otherwise empty. Figures are computed on one octant, whose planes exclude
/// rigid motions of the body. `model` is the name of the models in messages. The remedy for loads is the pseudo-rigid
/// model.
std::optional<scene::Refusal> refuses_loads_at_rest(const scene::Scene& scene, std::string_view model);

/// Name of a class of motions. Examples are "even in z, m = 2" for a spheroid, and "odd in z, even under the half turn"
/// for an ellipsoid. The half turn is the rotation by π about axis 3.
std::string name_of(const mechanics::MotionClass& motions, mechanics::Figure figure);

/// A family of figures. Its `condition` maps a value of the parameter to the condition that determines the figure. If
/// the parameter is a spin, the value has the user's unit; the other parameters are dimensionless. For Jacobi's family,
/// the pseudo-rigid figure is the initial guess. The scene must exist as long as the result.
mechanics::FamilyOfFigures family_of_figures(const scene::Scene& scene, scene::Family family);

/// The values of the parameter that the scene requests, in the unit of the family.
std::vector<double> parameters_of(const scene::Scene::Equilibria& asked);

/// The class of small motions that contains the fastest growing motion; null if no motion grows.
const mechanics::ClassStability* fastest_growing(const mechanics::FigureMember& member);

/// True if the table of the scene has the column with this name. Columns about small motions are absent if
/// Equilibrium/Small motions is false. Columns with errors are absent if Continuum/Error estimate is none.
bool has_figure_column(const scene::Scene& scene, std::string_view name);

/// The number of rates in a row of the table.
inline constexpr std::size_t n_slowest_rates = 10;

/// A rate s of small motions exp(st), and the index of its class in FigureMember::classes.
struct RateOfClass {
  std::complex<double> s;
  std::size_t of_class;
};
/// All rates of a figure in the order of slowest_rates.
std::vector<RateOfClass> rates_by_frequency(const mechanics::FigureMember& member);
/// The ten rates s of lowest frequency |Im s| among all classes of small motions exp(st), by increasing frequency, in
/// internal units. A rate with Im s > 0 is followed by its complex conjugate, which is a rate as well. If there are
/// fewer than ten rates, the list is filled with 0.
std::vector<std::complex<double>> slowest_rates(const mechanics::FigureMember& member);

/// The columns of the table with their units and texts. `degree` and `m` are the texts of the columns with these names.
/// They must be string literals, because a column does not copy its text.
std::vector<scene::Column> figure_columns(std::string_view degree, std::string_view m);

/// The numbers of a row in internal units that the member itself does not contain.
struct FigureNumbers {
  int degree;               ///< degree of the body or of the elements
  double spin;              ///< spin Ω about axis 3
  Eigen::Vector3d axes;     ///< semi-axes of the ellipsoid x = QX that is nearest to the figure
  Eigen::Vector3d surface;  ///< distances from the centre at which the surface cuts the three axes
  mechanics::ContinuumObservables observables;
};

/// A row with the columns of figure_columns in internal units. Only a parameter that is a spin has the user's unit.
/// `special` is the special point whose figure is `member`; null for an ordinary member of the family.
std::vector<double> figure_row(int index, const mechanics::FigureMember& member,
                               const mechanics::SpecialFigure* special, const FigureNumbers& numbers);

/// Name of a class of motions, for example "even in z, m = 2".
using NameOfClass = std::function<std::string(const mechanics::MotionClass& motions)>;

/// The table and the results of a run that computes one family of figures for each degree of a model.
class FigureRun {
 public:
  /// A function that sets `row` to the row of a figure, and fails if it cannot compute the row. The row has a number
  /// for each column of the constructor. `special` is null for an ordinary member.
  using RowOf = std::function<mechanics::Status(int index, const mechanics::FigureMember& member,
                                                const mechanics::SpecialFigure* special, std::vector<double>& row)>;

  /// `file` is the name of the table without ".csv". The table has those of `columns` that has_figure_column admits.
  /// The object refers to `context`.
  /// `n_families` is the number of families that the run computes.
  FigureRun(const RunContext& context, std::string_view file, const std::vector<scene::Column>& columns,
            std::size_t n_families);

  /// Computes the next family with the parameters of the scene: the result of find(parameters, give_up, watch, known),
  /// where `find` has the arguments of mechanics::FigureFinder::family. Shows the progress of the run, and writes
  /// checkpoints. In a resumed run, `known` is the part of the family that the checkpoint contains.
  template <class Find>
  mechanics::FigureFamily next_family(const Find& find) {
    const std::size_t k = n_families_done_++;
    const mechanics::FamilyWatch watch = [this, k](double fraction, const mechanics::FigureFamily& known) {
      progress_.step((static_cast<double>(k) + fraction) / n_families_);
      checkpoint_.save_if_old(k, known);
    };
    mechanics::FigureFamily family = find(
        parameters_of(context_.scene.equilibria), [this] { return context_.interrupted(); }, watch,
        checkpoint_.known(k));
    checkpoint_.save(k, family);
    return family;
  }

  /// Writes the members and the special points of the family of one degree by increasing parameter. A run of a sweep
  /// writes nothing if a figure is missing. Adds a line with the number of members, and a line for each special point,
  /// to the results. The first line and the warnings begin with the text `of_degree`. Warns of each parameter without a
  /// figure, and of each member before which a special point was not located. Sets the outcome to `interrupted` if an
  /// interrupt left the family incomplete, and to `failed` if a row cannot be computed.
  void add(const std::string& of_degree, const mechanics::FigureFamily& family, const NameOfClass& name_of,
           const RowOf& row_of);
  /// True if the outcome is `finished` so far.
  bool goes_on() const { return outcome_.end == mechanics::Outcome::finished; }
  /// Sets the outcome and the message of the run.
  void end(mechanics::Outcome how, std::string message);
  ModelOutcome& outcome() { return outcome_; }
  /// Completes the table and the statistics after the last call of `add`, and returns the outcome. The outcome is
  /// `failed` if no figure was found. A run of a sweep has one parameter of the family. Its outcome is `failed` if a
  /// figure is missing for one of the degrees. The same holds for equilibria at rest.
  ModelOutcome finish();

 private:
  /// Appends the rows of the family to the table, or sets the outcome to `failed` at the first row that cannot be
  /// computed.
  void write(const mechanics::FigureFamily& family, const RowOf& row_of);
  std::string missing_in_words(const mechanics::FigureFamily& family, const mechanics::NoFigure& missing) const;

  const RunContext& context_;
  std::string file_, parameter_;  ///< name of the table without ".csv"; name of the family's parameter for messages
  bool is_row_;                   ///< true if the run gives a row of a sweep
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double n_families_;
  std::size_t n_families_done_ = 0;
  io::Progress progress_;
  FamilyCheckpoint checkpoint_;
  std::vector<std::size_t> kept_;         ///< indices of the columns that the table has
  std::optional<io::ColumnTable> table_;  ///< has a value after the construction
  ModelOutcome outcome_;
  std::string reason_;  ///< sentence about the first missing member; empty if no member is missing
  int index_ = 0;
  double n_members_ = 0, n_special_ = 0;
};

}  // namespace pseudorigid::app
