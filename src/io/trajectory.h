#pragma once
/// The columns of reduced.csv and continuum.csv, and their rows.
///
/// Which columns exist, their order and their values stand in one place (trajectory.cpp), so that a header and its
/// rows cannot disagree.

#include <string>
#include <vector>

#include "io/csv.h"
#include "io/units.h"
#include "mechanics/body_observables.h"
#include "scene/scene.h"

namespace pseudorigid::io {

/// The columns that `quantities` asks for, `time` first (docs/output.md).
std::vector<std::string> reduced_columns(const scene::Quantities& quantities);
std::vector<std::string> continuum_columns(const scene::Quantities& quantities);

/// The row of a sample, in the order of the columns; observables in internal units, the time in the user's (it is
/// known exactly there). `row` is overwritten and its memory reused.
void reduced_row(double physical_time, const mechanics::ReducedObservables& internal, const Units& units,
                 const scene::Quantities& quantities, std::vector<double>& row);
void continuum_row(double physical_time, const mechanics::ContinuumObservables& internal, const Units& units,
                   const scene::Quantities& quantities, std::vector<double>& row);

}  // namespace pseudorigid::io
