/// Problem (i).

#include "job_list.h"

namespace pseudorigid::benchmarks {

std::vector<Job> sl3_jobs() {
  static const auto form = sl3_form();  // the field refers to it
  JobList list("sl3");
  add_constrained(list, form);
  add_gauss(list, form);
  add_explicit(list, form.with(mechanics::ExplicitMultiplier(form.system)));
  return list.jobs;
}

}  // namespace pseudorigid::benchmarks
