#pragma once
/// Columns and rows of the file equilibria-polynomial.csv.

#include <variant>
#include <vector>

#include "app/figures/figure_families.h"
#include "polynomial/body_figure_finder.h"
#include "polynomial/incompressible_body.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// The columns of the file with their units and texts.
std::vector<scene::Column> polynomial_equilibria_columns();

/// Makes the rows for the figures of one polynomial body, with the columns of polynomial_equilibria_columns.
class EquilibriumRows {
 public:
  /// The object refers to `spectrum`, which must exist as long as the object.
  EquilibriumRows(const polynomial::FigureSetup& setup, const polynomial::FigureSpectrum& spectrum);

  /// Sets `row` to one row of the table. All columns are in internal units except the parameter, which has the unit of
  /// its family. `special` is the special point whose figure is `member`; null for an ordinary member of the family.
  /// Fails if the observables of the figure cannot be computed.
  mechanics::Status row(int index, const polynomial::FigureMember& member, const polynomial::SpecialFigure* special,
                        std::vector<double>& row) const;

 private:
  using Body = std::variant<polynomial::IncompressibleBody, polynomial::CompressibleBody>;

  mechanics::Status observe(const mechanics::EquilibriumFigure& figure,
                            mechanics::ContinuumObservables& observables) const;

  Body body_;  ///< the whole body, for the observables
  mechanics::Drive drive_;
  const polynomial::FigureSpectrum& spectrum_;  ///< extends the positions of a figure to the whole body
};

}  // namespace pseudorigid::app
