/// Problem (iii), in multiplier form and, for the methods that take it, in angles.

#include "job_list.h"
#include "mechanics/core/chart_field.h"
#include "systems/double_pendulum_chart.h"

namespace pseudorigid::benchmarks {

std::vector<Job> double_pendulum_jobs() {
  static const auto form = pendulum_form();  // the field refers to it
  JobList list("double_pendulum");
  add_constrained(list, form);
  add_gauss(list, form);
  add_explicit(list, form.with(mechanics::ExplicitMultiplier(form.system)));
  add_gauss(list, lagrange_form().with(mechanics::ChartField(systems::DoublePendulumChart{})));
  add_explicit(list, lagrange_form());
  return list.jobs;
}

}  // namespace pseudorigid::benchmarks
