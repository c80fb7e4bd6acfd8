/// Problem (ii).

#include "job_list.h"

namespace pseudorigid::benchmarks {

std::vector<Job> rigid_body_jobs() {
  JobList list("rigid_body");
  add_constrained(list, rigid_body_form());
  add_gauss(list, euler_form());
  add_explicit(list, euler_form());
  return list.jobs;
}

}  // namespace pseudorigid::benchmarks
