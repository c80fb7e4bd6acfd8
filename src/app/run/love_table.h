#pragma once
/// Writes the Love numbers of a ball (gravity/love_numbers.h) into love-<run>.csv and into a table for the terminal.
/// The file and the table also have the Love numbers of the exact homogeneous incompressible sphere.

#include <string>
#include <string_view>
#include <vector>

#include "app/run/run_context.h"
#include "gravity/love_numbers.h"

namespace pseudorigid::app {

/// Love numbers of one degree, and bounds of the errors of h and l that the discretisation causes. Here h and l are the
/// Love numbers of the radial and of the tangential displacement. The bounds are 0 for the pseudo-rigid body.
struct LoveRow {
  gravity::LoveNumbers numbers;
  double h_error = 0, l_error = 0;
};

/// Rows with bounds of their errors. `other` has the numbers of another discretisation for the same degrees. The bound
/// for a number is twice its difference from the other discretisation, plus the number times `round_off`, the relative
/// round-off of the solver.
std::vector<LoveRow> with_errors(const std::vector<gravity::LoveNumbers>& numbers,
                                 const std::vector<gravity::LoveNumbers>& other, double round_off);

/// The name of the CSV file of a run, without ".csv". `run` is the name of the files of the run.
std::string love_file(std::string_view run);

/// The columns of love-<run>.csv with their units and texts.
std::vector<scene::Column> love_columns();

/// Writes love-<run>.csv and adds the table for the terminal to the results of `outcome`. The title of the table
/// contains the adjective `ball`.
void write_love_table(const std::vector<LoveRow>& rows, std::string_view run, std::string_view ball,
                      const RunContext& context, ModelOutcome& outcome);

/// Writes love-reduced.csv and the table for the terminal, for the pseudo-rigid ball. Its Love numbers are known in
/// closed form, so the run cannot fail.
ModelOutcome run_reduced_love_numbers(const RunContext& context);

}  // namespace pseudorigid::app
