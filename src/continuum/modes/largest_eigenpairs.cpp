#include "continuum/modes/largest_eigenpairs.h"

#include <algorithm>
#include <random>
#include <string>

#include <slepceps.h>

namespace pseudorigid::continuum {
namespace {

/// The objects of PETSc and SLEPc that one run of the iteration allocates.
struct Run {
  EPS solver = nullptr;
  std::vector<Vec> known;
  Vec start = nullptr;
  ~Run() {
    for (Vec& v : known) VecDestroy(&v);
    VecDestroy(&start);
    EPSDestroy(&solver);
  }
};

/// The stopping test of the iteration, which SLEPc calls. In addition to the usual test, this test ends the iteration
/// if a product with the operator has failed.
PetscErrorCode look(EPS solver, PetscInt n_iterations, PetscInt max_iterations, PetscInt n_converged, PetscInt n_wanted,
                    EPSConvergedReason* reason, void* context) {
  PetscCall(EPSStoppingBasic(solver, n_iterations, max_iterations, n_converged, n_wanted, reason, nullptr));
  if (!static_cast<const ShellOperator*>(context)->status()) *reason = EPS_CONVERGED_USER;
  return 0;
}

PetscErrorCode set_up(Run& run, ShellOperator& shell, PetscInt n, PetscInt n_wanted, double tolerance,
                      const std::vector<EigenPair>& known) {
  PetscCall(EPSCreate(PETSC_COMM_SELF, &run.solver));
  PetscCall(EPSSetOperators(run.solver, shell.matrix(), nullptr));
  PetscCall(EPSSetProblemType(run.solver, EPS_HEP));
  PetscCall(EPSSetWhichEigenpairs(run.solver, EPS_LARGEST_REAL));
  const PetscInt room = n - static_cast<PetscInt>(known.size());
  PetscCall(EPSSetDimensions(run.solver, n_wanted, std::min(room, 2 * n_wanted + 8), PETSC_DEFAULT));
  PetscCall(EPSSetTolerances(run.solver, tolerance, 200));
  PetscCall(EPSSetStoppingTestFunction(run.solver, look, &shell, nullptr));
  for (const EigenPair& pair : known) {
    Vec& v = run.known.emplace_back(nullptr);
    PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, pair.vector.data(), &v));
  }
  PetscCall(EPSSetDeflationSpace(run.solver, static_cast<PetscInt>(run.known.size()), run.known.data()));
  // The starting vector depends only on the size and on the number of known vectors. The results are therefore
  // reproducible.
  std::mt19937 generator(static_cast<unsigned int>(known.size()));
  std::uniform_real_distribution<double> uniform(-1, 1);
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &run.start));
  PetscScalar* values;
  PetscCall(VecGetArray(run.start, &values));
  for (PetscInt i = 0; i < n; ++i) values[i] = uniform(generator);
  PetscCall(VecRestoreArray(run.start, &values));
  PetscCall(EPSSetInitialSpace(run.solver, 1, &run.start));
  return 0;
}

PetscErrorCode take(EPS solver, PetscInt n, std::vector<EigenPair>& found) {
  PetscInt n_converged;
  PetscCall(EPSGetConverged(solver, &n_converged));
  for (PetscInt i = 0; i < n_converged; ++i) {
    EigenPair pair{0, std::vector<double>(static_cast<std::size_t>(n))};
    Vec v;
    PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, pair.vector.data(), &v));
    PetscCall(EPSGetEigenpair(solver, i, &pair.value, nullptr, v, nullptr));
    PetscCall(VecDestroy(&v));
    found.push_back(std::move(pair));
  }
  return 0;
}

}  // namespace

mechanics::Status append_largest_eigenpairs(const LinearOperator& apply, std::size_t size, int n_wanted,
                                            double tolerance, std::vector<EigenPair>& known) {
  const auto n = static_cast<PetscInt>(size);
  const PetscInt wanted = std::min<PetscInt>(n_wanted, n - static_cast<PetscInt>(known.size()));
  if (wanted <= 0) return {};
  ShellOperator shell(apply, size);
  Run run;
  std::vector<EigenPair> found;
  const bool fine = shell.status() && set_up(run, shell, n, wanted, tolerance, known) == 0 &&
                    EPSSolve(run.solver) == 0 && take(run.solver, n, found) == 0;
  if (!shell.status()) return shell.status();
  if (!fine) return mechanics::Status::failure("SLEPc reports an error");
  if (static_cast<PetscInt>(found.size()) < wanted)
    return mechanics::Status::failure("the iteration for the eigenvectors does not converge");
  known.insert(known.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
  return {};
}

}  // namespace pseudorigid::continuum
