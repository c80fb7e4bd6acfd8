/// Every law that the continuum offers, through the kernels and the graphics: force = −dV by central differences,
/// affine states have the energy, the mean stress and the von Mises stress of the law itself.

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "continuum/output/nodal_fields.h"
#include "materials/eigen_tensor.h"
#include "materials/law_table.h"
#include "support/differences.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

class LawInTheContinuum : public ::testing::TestWithParam<materials::NamedLaw> {
 protected:
  const materials::AnyLaw law = GetParam().make({.shear_modulus = 1.3, .lame_lambda = 0.8, .mooney_fraction = 0.3});
  const ElasticBall ball{whole, 3, 0, law};
  std::mt19937 generator{11};

  double W(const Matrix3d& F) const {
    return std::visit([&](const auto& l) { return l.energy(materials::to_tensor(F)); }, law);
  }
  Matrix3d P(const Matrix3d& F) const {
    return std::visit([&](const auto& l) { return materials::to_matrix(l.stress(materials::to_tensor(F))); }, law);
  }
  Vector force(const Vector& x) const {
    Vector f = ball.make_vector();
    EXPECT_GT(ball.kernels().force(x, f), 0);
    return f;
  }
};

TEST_P(LawInTheContinuum, ForceIsMinusTheDerivativeOfTheEnergy) {
  // Noise of the size of the distance between nodes, so that gradients are of the order of 1.
  const Vector noise = random_field(ball.make_vector(), generator);
  Vector v = random_field(ball.make_vector(), generator);
  v *= 0.03;
  v.add(1.0, ball.affine_field(diagonal(0.3, -0.2, 0.1)));
  Vector x = ball.affine_field(Matrix3d::Identity() + 0.2 * random_matrix(generator));
  x.add(0.005, noise);
  const double slope = first_difference(
      [&](int k) {
        Vector moved = x;
        moved.add(1e-3 * k, v);
        return ball.kernels().integrals(moved, v).elastic;
      },
      1e-3);
  const double power = force(x) * v;
  ASSERT_GT(std::abs(power), 1e-2);
  EXPECT_NEAR(slope, -power, 1e-8 * std::abs(power));
}

/// ∫W = Vol W(Q), Σ f_n X_nᵀ = −∫P = −Vol P(Q): X and QX lie in the isoparametric space.
TEST_P(LawInTheContinuum, AffineStatesHaveTheEnergyAndTheStressOfTheLaw) {
  for (int i = 0; i < 5; ++i) {
    const Matrix3d Q = Matrix3d::Identity() + 0.3 * random_matrix(generator);
    const Vector x = ball.affine_field(Q);
    EXPECT_NEAR(ball.kernels().integrals(x, x).elastic, ball.volume() * W(Q), 1e-12 * (1 + std::abs(W(Q))));
    Vector a = ball.make_vector();
    ball.apply_inverse_mass(force(x), a);
    const Matrix3d moment = ball.nodal_moment(a, ball.space().reference_positions());
    EXPECT_LT((moment + ball.volume() * P(Q)).norm(), 1e-12 * (1 + P(Q).norm()));
  }
}

TEST_P(LawInTheContinuum, VonMisesStressOfAffineStatesIsThatOfTheLaw) {
  const Matrix3d Q = Matrix3d::Identity() + 0.3 * random_matrix(generator);
  auto workspace = ball.make_workspace();
  mechanics::BodyFields fields;
  const auto status = nodal_fields(ball, affine_state(ball, Q, Matrix3d::Zero()), workspace, fields);
  ASSERT_TRUE(status) << status.reason();
  const auto von_mises = [](const Matrix3d& sigma) {
    return std::sqrt(1.5) * (sigma - sigma.trace() / 3 * Matrix3d::Identity()).norm();
  };
  const double expected = von_mises(P(Q) * Q.transpose() / Q.determinant());  // a pressure has no deviator
  ASSERT_GT(expected, 0.1);
  for (std::size_t i = 0; i < fields.n_points(); ++i)  // symmetric: rows are columns
    ASSERT_NEAR(von_mises(Eigen::Map<const Matrix3d>(fields.stress.data() + 9 * i)), expected, 1e-11);
}

std::vector<materials::NamedLaw> offered_laws() {
  std::vector<materials::NamedLaw> laws;
  for (const auto& law : materials::law_table)
    if (law.name != "none") laws.push_back(law);
  return laws;
}
INSTANTIATE_TEST_SUITE_P(Table, LawInTheContinuum, ::testing::ValuesIn(offered_laws()), [](const auto& info) {
  std::string name(info.param.name);
  std::erase_if(name, [](char c) { return c == '(' || c == ')'; });
  for (char& c : name) c = c == '-' || c == ' ' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace pseudorigid::testing
