/// The block Lanczos method against known eigenvalues, and against SLEPc's iteration in a parity sector.

#include <gtest/gtest.h>
#include <slepceps.h>

#include <limits>
#include <vector>

#include "continuum/balls.h"
#include "continuum/modes/block_lanczos.h"
#include "continuum/modes/parity_sector.h"
#include "continuum/modes/rest_problem.h"
#include "continuum/parallel/petsc_session.h"
#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::testing {
namespace {

using continuum::BlockLanczos;

continuum::BlockOperator product_with(const Eigen::MatrixXd& A) {
  return [&A](const Eigen::MatrixXd& y, Eigen::MatrixXd& z) -> mechanics::Status {
    z = A * y;
    return {};
  };
}

/// A symmetric matrix with these eigenvalues, whose eigenvectors are random.
struct SymmetricMatrix {
  explicit SymmetricMatrix(const Eigen::VectorXd& values)
      : vectors(mechanics::span_of(Eigen::MatrixXd::Random(values.size(), values.size()), 0)),
        A(vectors * values.asDiagonal() * vectors.transpose()) {}
  Eigen::MatrixXd vectors, A;
};

/// Eigenvalues 1/(1 + i), each of them `n_copies` times.
Eigen::VectorXd multiple(Eigen::Index size, Eigen::Index n_copies) {
  return Eigen::VectorXd::NullaryExpr(size,
                                      [=](Eigen::Index i) { return 1.0 / (1.0 + static_cast<double>(i / n_copies)); });
}

void expect_pairs(const Eigen::MatrixXd& A, const BlockLanczos& lanczos, const Eigen::VectorXd& values) {
  ASSERT_EQ(lanczos.n_found(), values.size());
  EXPECT_LT((lanczos.values() - values).norm(), 1e-12);
  const Eigen::MatrixXd v = lanczos.vectors();
  EXPECT_LT((A * v - v * lanczos.values().asDiagonal()).norm(), 1e-6);
  EXPECT_LT((v.transpose() * v - Eigen::MatrixXd::Identity(v.cols(), v.cols())).norm(), 1e-12);
}

TEST(BlockLanczos, FindsAllCopiesOfMultipleEigenvalues) {
  for (const Eigen::Index n_copies : {1, 3, 5, 7}) {
    const Eigen::VectorXd values = multiple(300, n_copies);
    const SymmetricMatrix matrix(values);
    BlockLanczos lanczos(product_with(matrix.A), 300);
    for (const Eigen::Index n : {9, 14, 25}) {  // each call goes on from the one before
      ASSERT_TRUE(lanczos.find(n, 1e-7));
      expect_pairs(matrix.A, lanczos, values.head(n));
    }
    EXPECT_LT(lanczos.n_products(), 300);
  }
}

TEST(BlockLanczos, StaysOrthogonalToExcludedVectors) {
  const Eigen::VectorXd values = multiple(200, 2);
  const SymmetricMatrix matrix(values);
  BlockLanczos lanczos(product_with(matrix.A), 200, matrix.vectors.leftCols(3));
  ASSERT_TRUE(lanczos.find(10, 1e-7));
  expect_pairs(matrix.A, lanczos, values.segment(3, 10));
  EXPECT_LT((matrix.vectors.leftCols(3).transpose() * lanczos.vectors()).norm(), 1e-12);
}

TEST(BlockLanczos, FindsAllPairsOfSmallOperators) {
  for (const Eigen::Index size : {1, 3, 8, 11, 20}) {
    const Eigen::VectorXd values = multiple(size, 4);
    const SymmetricMatrix matrix(values);
    BlockLanczos lanczos(product_with(matrix.A), size);
    ASSERT_TRUE(lanczos.find(50, 1e-7));
    expect_pairs(matrix.A, lanczos, values);
  }
  // The Krylov space of the identity is the first block.
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(30, 30);
  BlockLanczos lanczos(product_with(identity), 30);
  ASSERT_TRUE(lanczos.find(30, 1e-7));
  expect_pairs(identity, lanczos, Eigen::VectorXd::Ones(30));
}

TEST(BlockLanczos, ReturnsTheFailureOfAProduct) {
  int n_calls = 0;
  BlockLanczos lanczos(
      [&](const Eigen::MatrixXd& y, Eigen::MatrixXd& z) -> mechanics::Status {
        z = y;
        return ++n_calls < 2 ? mechanics::Status() : mechanics::Status::failure("no product");
      },
      50);
  const auto status = lanczos.find(20, 1e-7);
  EXPECT_FALSE(status);
  EXPECT_EQ(status.reason(), "no product");
  EXPECT_EQ(lanczos.n_found(), 0);
}

TEST(BlockLanczos, ProductsThatAreNotNumbersAreAFailure) {
  BlockLanczos lanczos(
      [&](const Eigen::MatrixXd& y, Eigen::MatrixXd& z) -> mechanics::Status {
        z = y * std::numeric_limits<double>::quiet_NaN();
        return {};
      },
      50);
  EXPECT_FALSE(lanczos.find(3, 1e-7));
}

/// The n largest eigenvalues of ParitySector::apply by SLEPc's Krylov–Schur iteration.
std::vector<double> eigenvalues_by_slepc(const continuum::ParitySector& sector, int n) {
  const auto size = static_cast<PetscInt>(sector.n_unknowns());
  Mat A;
  MatCreateShell(PETSC_COMM_SELF, size, size, size, size, const_cast<continuum::ParitySector*>(&sector), &A);
  const auto multiply = +[](Mat matrix, Vec in, Vec out) -> PetscErrorCode {
    void* context;
    MatShellGetContext(matrix, &context);
    const auto& of = *static_cast<const continuum::ParitySector*>(context);
    const auto n_unknowns = static_cast<Eigen::Index>(of.n_unknowns());
    const PetscScalar* y;
    VecGetArrayRead(in, &y);
    Eigen::MatrixXd z;
    const auto status = of.apply(Eigen::Map<const Eigen::VectorXd>(y, n_unknowns), z);
    VecRestoreArrayRead(in, &y);
    PetscScalar* values;
    VecGetArrayWrite(out, &values);
    Eigen::Map<Eigen::VectorXd>(values, n_unknowns) = z;
    VecRestoreArrayWrite(out, &values);
    return status ? 0 : 1;
  };
  MatShellSetOperation(A, MATOP_MULT, reinterpret_cast<void (*)()>(multiply));
  EPS solver;
  EPSCreate(PETSC_COMM_SELF, &solver);
  EPSSetOperators(solver, A, nullptr);
  EPSSetProblemType(solver, EPS_HEP);
  EPSSetWhichEigenpairs(solver, EPS_LARGEST_REAL);
  EPSSetDimensions(solver, n, PETSC_DEFAULT, PETSC_DEFAULT);
  EPSSetTolerances(solver, 1e-10, 1000);
  EPSSolve(solver);
  std::vector<double> values(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) EPSGetEigenvalue(solver, i, &values[static_cast<std::size_t>(i)], nullptr);
  EPSDestroy(&solver);
  MatDestroy(&A);
  return values;
}

TEST(BlockLanczos, AgreesWithSlepcInAParitySector) {
  continuum::start_petsc();
  SlepcInitialize(nullptr, nullptr, nullptr, nullptr);
  const continuum::BallSpace space(continuum::BallMesh(octant, 0), 4);
  const auto kernels = continuum::make_cell_kernels(space, neo_hookean);
  const continuum::RestProblem problem(space, *kernels, neo_hookean, true);
  continuum::ParitySector sector(problem, continuum::parity_of_sector(1));
  ASSERT_TRUE(sector.factorize());
  BlockLanczos lanczos([&](const auto& y, auto& z) { return sector.apply(y, z); },
                       static_cast<Eigen::Index>(sector.n_unknowns()));
  ASSERT_TRUE(lanczos.find(12, 1e-8));
  const std::vector<double> reference = eigenvalues_by_slepc(sector, 12);
  for (Eigen::Index i = 0; i < 12; ++i)
    EXPECT_NEAR(lanczos.values()[i] / reference[static_cast<std::size_t>(i)], 1, 1e-11) << i;
  SlepcFinalize();
}

}  // namespace
}  // namespace pseudorigid::testing
