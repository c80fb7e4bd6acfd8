#pragma once
/// Writes the Love numbers of a ball (gravity/love_numbers.h) into love-<run>.csv and into a table for the terminal.
/// Both also have Love numbers of the exact homogeneous incompressible sphere: h, l and k in the file, h and l on the
/// terminal.

#include <string>
#include <string_view>
#include <vector>

#include "app/run/run_context.h"
#include "gravity/love_numbers.h"

namespace pseudorigid::app {

/// Love numbers of one degree, and bounds of the errors of h and l that the discretisation causes. Here h and l are the
/// Love numbers of the radial and of the tangential displacement. Both bounds are 0 for the pseudo-rigid body.
struct LoveRow {
  gravity::LoveNumbers numbers;
  double h_error = 0, l_error = 0;
};

/// Rows with bounds of their errors. `other` has the numbers of another discretisation, for the same degrees in the
/// same order. The bound for h is 2|h − h_other| + round_off |h|, and the bound for l has the same form. `round_off` is
/// the relative round-off of the solver.
std::vector<LoveRow> with_errors(const std::vector<gravity::LoveNumbers>& numbers,
                                 const std::vector<gravity::LoveNumbers>& other, double round_off);

/// The name of the CSV file for the run `run`, without ".csv". An example is "love-reduced" for the run "reduced".
std::string love_file(std::string_view run);

/// The columns of love-<run>.csv with their units and texts.
std::vector<scene::Column> love_columns();

/// Writes love-<run>.csv and adds the table for the terminal to the results of `outcome`. The title of the table
/// contains the adjective `ball`, for example "elastic". The scene gives the ratio γ of gravity to elasticity for the
/// exact numbers.
void write_love_table(const std::vector<LoveRow>& rows, std::string_view run, std::string_view ball,
                      const RunContext& context, ModelOutcome& outcome);

/// Writes love-reduced.csv and the table for the terminal, for the pseudo-rigid ball. Its Love numbers are known in
/// closed form, so the run cannot fail.
ModelOutcome run_reduced_love_numbers(const RunContext& context);

}  // namespace pseudorigid::app
