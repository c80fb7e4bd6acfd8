#include "continuum/modes/largest_eigenpairs.h"

#include <algorithm>
#include <random>
#include <string>

#include <slepceps.h>

#include "continuum/parallel/petsc_session.h"

namespace pseudorigid::continuum {
namespace {

/// The operator and the status of its products. Functions that PETSc calls cannot return a Status. After a failure, the
/// products are 0, and the iteration ends at its next check.
struct Product {
  const SymmetricOperator& apply;
  mechanics::Status status{};
};

PetscErrorCode multiply(Mat matrix, Vec in, Vec out) {
  void* context;
  PetscCall(MatShellGetContext(matrix, &context));
  const PetscScalar* x;
  PetscScalar* y;
  PetscInt n;
  PetscCall(VecGetLocalSize(in, &n));
  PetscCall(VecGetArrayRead(in, &x));
  PetscCall(VecGetArray(out, &y));
  auto& [apply, status] = *static_cast<Product*>(context);
  const std::span<double> product{y, static_cast<std::size_t>(n)};
  if (status) status = apply({x, static_cast<std::size_t>(n)}, product);
  if (!status) std::ranges::fill(product, 0.0);
  PetscCall(VecRestoreArrayRead(in, &x));
  PetscCall(VecRestoreArray(out, &y));
  return 0;
}

/// The objects of PETSc and SLEPc that one run of the iteration allocates.
struct Run {
  Mat matrix = nullptr;
  EPS solver = nullptr;
  std::vector<Vec> known;
  Vec start = nullptr;
  ~Run() {
    for (Vec& v : known) VecDestroy(&v);
    VecDestroy(&start);
    EPSDestroy(&solver);
    MatDestroy(&matrix);
  }
};

/// SLEPc's test for the end of the iteration. It also ends the iteration if a product has failed.
PetscErrorCode look(EPS solver, PetscInt n_iterations, PetscInt max_iterations, PetscInt n_converged, PetscInt n_wanted,
                    EPSConvergedReason* reason, void* context) {
  PetscCall(EPSStoppingBasic(solver, n_iterations, max_iterations, n_converged, n_wanted, reason, nullptr));
  if (!static_cast<const Product*>(context)->status) *reason = EPS_CONVERGED_USER;
  return 0;
}

PetscErrorCode set_up(Run& run, Product& product, PetscInt n, PetscInt n_wanted, double tolerance,
                      const std::vector<EigenPair>& known) {
  PetscCall(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, &product, &run.matrix));
  PetscCall(MatShellSetOperation(run.matrix, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  PetscCall(EPSCreate(PETSC_COMM_SELF, &run.solver));
  PetscCall(EPSSetOperators(run.solver, run.matrix, nullptr));
  PetscCall(EPSSetProblemType(run.solver, EPS_HEP));
  PetscCall(EPSSetWhichEigenpairs(run.solver, EPS_LARGEST_REAL));
  const PetscInt room = n - static_cast<PetscInt>(known.size());
  PetscCall(EPSSetDimensions(run.solver, n_wanted, std::min(room, 2 * n_wanted + 8), PETSC_DEFAULT));
  PetscCall(EPSSetTolerances(run.solver, tolerance, 200));
  PetscCall(EPSSetStoppingTestFunction(run.solver, look, &product, nullptr));
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

mechanics::Status append_largest_eigenpairs(const SymmetricOperator& apply, std::size_t size, int n_wanted,
                                            double tolerance, std::vector<EigenPair>& known) {
  start_petsc();
  const auto n = static_cast<PetscInt>(size);
  const PetscInt wanted = std::min<PetscInt>(n_wanted, n - static_cast<PetscInt>(known.size()));
  if (wanted <= 0) return {};
  Product product{apply};
  Run run;
  std::vector<EigenPair> found;
  const bool fine = set_up(run, product, n, wanted, tolerance, known) == 0 && EPSSolve(run.solver) == 0 &&
                    take(run.solver, n, found) == 0;
  if (!product.status) return product.status;
  if (!fine) return mechanics::Status::failure("SLEPc reports an error");
  if (static_cast<PetscInt>(found.size()) < wanted)
    return mechanics::Status::failure("the iteration for the eigenvectors does not converge");
  known.insert(known.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
  return {};
}

}  // namespace pseudorigid::continuum
