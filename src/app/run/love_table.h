#pragma once
/// love-<run>.csv, and a table for the terminal: Love numbers of a ball (gravity/love_numbers.h), compared with those
/// of the exact homogeneous sphere.

#include <string_view>
#include <vector>

#include "app/run/run_context.h"
#include "gravity/love_numbers.h"

namespace pseudorigid::app {

/// Numbers of one degree, and bounds of the error that the discretisation makes in h and l.
struct LoveRow {
  gravity::LoveNumbers numbers;
  double h_error = 0, l_error = 0;
};

/// Rows with bounds of their errors, from the numbers of another discretisation: twice the difference, and the relative
/// round-off of the solver.
std::vector<LoveRow> with_errors(const std::vector<gravity::LoveNumbers>& numbers,
                                 const std::vector<gravity::LoveNumbers>& other, double round_off);

/// γ = ρgr/μ of the ball at rest, g = (4/3)πGρr.
double gravity_to_elasticity(const scene::Scene& scene);

std::vector<scene::Column> love_columns();

/// Writes the file of a run, and adds the lines for people to the results.
void write_love_table(const std::vector<LoveRow>& rows, std::string_view run, std::string_view ball,
                      const RunContext& context, ModelOutcome& outcome);

/// The numbers of the pseudo-rigid ball, in closed form.
ModelOutcome run_reduced_love_numbers(const RunContext& context);

}  // namespace pseudorigid::app
