#pragma once
/// The columns of equilibria-continuum.csv. The program needs them without the finite-element library.

#include <vector>

#include "app/figures/figure_families.h"

namespace pseudorigid::app {

inline constexpr std::size_t n_error_columns = 5;

/// The columns of figure_columns, and then n_error_columns columns with the estimated errors of the discretisation.
inline std::vector<scene::Column> continuum_figure_columns() {
  std::vector<scene::Column> columns =
      figure_columns("degree of the elements",
                     "of the same motions: 0 if even under the half turn about axis 3, otherwise 1; -1 if none grows");
  columns.insert(
      columns.end(),
      {{"parameter_error", "", "twice the difference of the parameter from that on the companion mesh; 0 for members"},
       {"omega3_error", "1/time", "twice the difference of omega3 from that on the companion mesh"},
       {"axes_error", "length", "twice the largest difference of a semi-axis from that on the companion mesh"},
       {"surface_error", "length",
        "twice the largest difference of surface1, surface2 or surface3 from that on the companion mesh"},
       {"rates_error", "1/time",
        "twice the largest difference of the rates in the row from those on the companion mesh, plus that from a "
        "smaller basis"}});
  return columns;
}

}  // namespace pseudorigid::app
