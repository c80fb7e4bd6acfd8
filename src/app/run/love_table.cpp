#include "app/run/love_table.h"

#include <fmt/format.h>

#include <cmath>

#include "app/run/scene_to_model.h"
#include "scene/models.h"

namespace pseudorigid::app {

std::vector<LoveRow> with_errors(const std::vector<gravity::LoveNumbers>& numbers,
                                 const std::vector<gravity::LoveNumbers>& other, double round_off) {
  constexpr double factor = 2;  // the difference counts twice in a bound (love_table.h)
  std::vector<LoveRow> rows;
  const auto bound = [=](double value, double other_value) {
    return factor * std::abs(value - other_value) + round_off * std::abs(value);
  };
  for (std::size_t i = 0; i < numbers.size(); ++i)
    rows.push_back({numbers[i], bound(numbers[i].h, other[i].h), bound(numbers[i].l, other[i].l)});
  return rows;
}

std::string love_file(std::string_view run) { return fmt::format("love-{}", run); }

std::vector<scene::Column> love_columns() {
  return {{"degree", "", "degree n of the tide"},
          {"h", "", "radial displacement of the surface, in V/g of the tidal potential V there, g = (4/3) pi G rho r"},
          {"l", "", "tangential displacement, in r grad V/g"},
          {"k", "", "potential that the displaced mass adds at the surface, in V"},
          {"h_load", "", "h', as h for a mass on the surface that has the potential V"},
          {"l_load", "", "l', as l for this mass"},
          {"k_load", "", "k', as k for this mass"},
          {"h_error", "",
           "bound of the error of h that the discretisation makes: twice the difference to another degree; "
           "for finite elements with the spread over the harmonics, and relatively at least that of lower degrees; the "
           "errors of k, h' and k' are in proportion; 0 for the "
           "pseudo-rigid body, which has no discretisation"},
          {"l_error", "", "the same for l, and in proportion l'"},
          {"h_exact", "", "h of the homogeneous incompressible sphere"},
          {"l_exact", "", "l of this sphere"},
          {"k_exact", "", "k of this sphere"}};
}

void write_love_table(const std::vector<LoveRow>& rows, std::string_view run, std::string_view ball,
                      const RunContext& context, ModelOutcome& outcome) {
  io::ColumnTable table = table_of(context, love_file(run), love_columns());
  const double gamma = gravity_to_elasticity(context.scene);
  add_result(outcome, context, fmt::format("Love numbers of the {} ball, gamma = rho g r/mu = {:.6g}", ball, gamma));
  add_result(outcome, context,
             fmt::format("{:>3} {:>16} {:>9} {:>14} {:>10} {:>14} {:>14} {:>14} {:>14} {:>14} {:>14}", "n", "h", "+-",
                         "exact h", "difference", "l", "exact l", "k", "h'", "l'", "k'"));
  for (const auto& [numbers, h_error, l_error] : rows) {
    const auto& [n, h, l] = numbers;
    const double k = numbers.k();
    const auto of_load = [&](double number) { return numbers.load_factor() * number + 0.0; };  // no negative zero
    const gravity::LoveNumbers exact = gravity::exact_love_numbers(n, gamma);
    table.append({static_cast<double>(n), h, l, k, of_load(h), of_load(l), of_load(k), h_error, l_error, exact.h,
                  exact.l, exact.k()});
    add_result(outcome, context,
               fmt::format("{:>3} {:>16.10g} {:>9} {:>14.9g} {:>10.1e} {:>14.9g} {:>14.9g} {:>14.9g} {:>14.9g} "
                           "{:>14.9g} {:>14.9g}",
                           n, h, h_error > 0 ? fmt::format("{:.1e}", h_error) : "", exact.h, h / exact.h - 1, l,
                           exact.l, k, of_load(h), of_load(l), of_load(k)));
  }
  table.flush();
}

ModelOutcome run_reduced_love_numbers(const RunContext& context) {
  std::vector<LoveRow> rows;
  const double gamma = gravity_to_elasticity(context.scene);
  for (const int n : scene::love_degrees(context.scene)) rows.push_back({gravity::pseudo_rigid_love_numbers(n, gamma)});
  ModelOutcome outcome;
  write_love_table(rows, "reduced", "pseudo-rigid", context, outcome);
  return outcome;
}

}  // namespace pseudorigid::app
