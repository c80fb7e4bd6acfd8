#include "job_list.h"

namespace pseudorigid::benchmarks {

std::vector<Job> gravitating_jobs() {
  static const auto form = gravitating_form();  // the field refers to it
  JobList list("gravitating");
  add_constrained(list, form);
  add_gauss(list, form);
  add_explicit(list, form.with(mechanics::ExplicitMultiplier(form.system)));
  return list.jobs;
}

}  // namespace pseudorigid::benchmarks
