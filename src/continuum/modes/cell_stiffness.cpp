#include "continuum/modes/cell_stiffness.h"

#include <Eigen/Dense>
#include <variant>

#include "continuum/mesh/tensor_product.h"
#include "materials/volumetric_energy.h"

namespace pseudorigid::continuum {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::MatrixXd table(const std::vector<double>& row_major, int n) {
  return Eigen::Map<const RowMajor>(row_major.data(), n, n);
}

/// Returns the tangent with the entries C_iJkL = C(H)_iJ for the gradient H whose only nonzero entry is H_kL = 1. The
/// function `of` returns C(H).
template <class Of>
Tangent columns(const Of& of) {
  Tangent tangent;
  for (int k = 0; k < 3; ++k)
    for (int L = 0; L < 3; ++L) {
      materials::Tensor<double> H{};
      H(k, L) = 1;
      const materials::Tensor<double> C = of(H);
      for (int i = 0; i < 3; ++i)
        for (int J = 0; J < 3; ++J) tangent.entries[27 * i + 9 * J + 3 * k + L] = C(i, J);
    }
  return tangent;
}

}  // namespace

Tangent tangent_at(const StoredEnergy& stored, const materials::Tensor<double>& F, double lambda) {
  const materials::Tensor<double> cof = materials::cofactor(F);
  const double J = materials::determinant(F, cof), kappa = stored.volumetric_stiffness;
  const double curvature = materials::volumetric_curvature(kappa, J);
  Tangent tangent = columns([&](const materials::Tensor<double>& H) {
    const double of_volume = curvature * materials::dot(cof, H);
    return materials::entrywise([&](double of_law, double c) { return of_law + of_volume * c; },
                                std::visit([&](const auto& known) { return known.tangent(F, H); }, stored.law), cof);
  });
  if (kappa != 0) tangent.add(materials::volumetric_pressure(kappa, J), tangent_of_pressure(F));
  return lambda == 0 ? tangent : tangent.add(lambda, tangent_of_constraint(F));
}

Tangent tangent_of_constraint(const materials::Tensor<double>& F) {
  const materials::Tensor<double> cof = materials::cofactor(F);
  const double J = materials::determinant(F, cof);
  return columns([&](const materials::Tensor<double>& H) {  // −D(F⁻ᵀ)[H] with F⁻ᵀ = cof F/J
    const double rate_of_J = materials::dot(cof, H);
    return materials::entrywise([&](double c, double rate) { return (c * rate_of_J / J - rate) / J; }, cof,
                                materials::cofactor_derivative(F, H));
  });
}

Tangent tangent_of_pressure(const materials::Tensor<double>& F) {
  return columns([&](const materials::Tensor<double>& H) { return materials::cofactor_derivative(F, H); });
}

RestElasticity::RestElasticity(const StoredEnergy& stored, bool incompressible)
    : tangent(tangent_at(stored, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                         incompressible ? materials::pressure_at_rest(stored.law) : 0)),
      moduli(materials::moduli_at_rest(stored.law, incompressible)) {
  moduli.lame += stored.volumetric_stiffness;
}

CellStiffness::CellStiffness(const BallSpace& space) : space_(space), n_(space.reference_cell().n) {
  const ReferenceCell& ref = space.reference_cell();
  values_ = table(ref.interpolate, n_);
  derivatives_ = table(ref.differentiate, n_) * values_;
  for (int p = 0; p < 4; ++p) {
    const Eigen::MatrixXd &first = p / 2 ? derivatives_ : values_, &second = p % 2 ? derivatives_ : values_;
    products_[p].resize(n_, n_ * n_);
    for (int b = 0; b < n_; ++b)
      for (int a = 0; a < n_; ++a) products_[p].col(b * n_ + a) = first.col(a).cwiseProduct(second.col(b));
  }
}

CellStiffness::Gradients CellStiffness::by_reference(unsigned int cell, const Vector& x) const {
  const auto& nodes = space_.cell_nodes(cell);
  Gradients result(static_cast<Eigen::Index>(nodes.size()), 9);
  Eigen::VectorXd component(result.rows());
  for (unsigned int i = 0; i < 3; ++i) {
    for (Eigen::Index a = 0; a < component.size(); ++a)
      component[a] = x.local_element(3 * nodes[static_cast<std::size_t>(a)] + i);
    for (int d = 0; d < 3; ++d) {
      const auto along = [&](int t) -> const Eigen::MatrixXd& { return t == d ? derivatives_ : values_; };
      result.col(3 * static_cast<int>(i) + d) = tensor_product(along(0), along(1), along(2), component);
    }
  }
  return result;
}

PointCoefficients CellStiffness::coefficients(unsigned int cell, const Vector& x, const TangentOfPoint& tangent) const {
  const ReferenceCell& ref = space_.reference_cell();
  const Gradients of_X = by_reference(cell, space_.reference_positions()), of_x = by_reference(cell, x);
  const auto matrix = [](const Eigen::Matrix<double, 1, 9>& row) -> Eigen::Matrix3d {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row.data());
  };
  PointCoefficients c(of_X.rows(), StiffnessTangent::n_entries);
  for (int q = 0; q < of_X.rows(); ++q) {
    const Eigen::Matrix3d jacobian = matrix(of_X.row(q));
    const Eigen::Matrix3d inverse = jacobian.inverse();  // entry (d, J) is ∂ξ_d/∂X_J
    const Eigen::Matrix3d gradient = matrix(of_x.row(q)) * inverse;
    materials::Tensor<double> F;
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J) F(i, J) = gradient(i, J);
    const Tangent C_of_point = tangent(q, F);
    const double weight = jacobian.determinant() * ref.weight_of_point(q);
    for (int i = 0; i < 3; ++i)
      for (int k = i; k < 3; ++k) {
        Eigen::Matrix3d C;
        for (int J = 0; J < 3; ++J)
          for (int L = 0; L < 3; ++L) C(J, L) = C_of_point(i, J, k, L);
        const Eigen::Matrix3d pulled_back = weight * inverse * C * inverse.transpose();
        for (int d = 0; d < 3; ++d)
          for (int e = i == k ? d : 0; e < 3; ++e) c(q, entry_of_c(3 * i + d, 3 * k + e)) = pulled_back(d, e);
      }
  }
  return c;
}

/// In direction t, the nodes a and b and the point q have the indices a_t, b_t and q_t.
Eigen::MatrixXd CellStiffness::contract(const PointCoefficients& c, int i, int k) const {
  const int n = n_, n2 = n * n;
  // Returns the index in products_ for one direction. The index has the summand 2 if ∂_d differentiates in this
  // direction, and the summand 1 if ∂_e does.
  const auto pattern = [](int de, int direction) { return 2 * (de / 3 == direction) + (de % 3 == direction); };
  std::array<Eigen::MatrixXd, 4> plane;  // [pattern in direction 2], rows (a₀b₀ a₁b₁), columns q₂
  for (auto& m : plane) m.setZero(n2 * n2, n);
  for (int de = 0; de < 9; ++de) {
    const Eigen::MatrixXd line =  // rows (a₀b₀), columns (q₁ q₂)
        products_[pattern(de, 0)].transpose() *
        Eigen::Map<const Eigen::MatrixXd>(c.col(entry_of_c(3 * i + de / 3, 3 * k + de % 3)).data(), n, n2);
    for (int q = 0; q < n; ++q)
      Eigen::Map<Eigen::MatrixXd>(plane[pattern(de, 2)].col(q).data(), n2, n2).noalias() +=
          line.middleCols(q * n, n) * products_[pattern(de, 1)];
  }
  Eigen::MatrixXd all(n2 * n2, n2);  // rows (a₀b₀ a₁b₁), columns (a₂b₂)
  all.noalias() = plane[0] * products_[0];
  for (int p = 1; p < 4; ++p) all.noalias() += plane[p] * products_[p];

  Eigen::MatrixXd result(n * n2, n * n2);
  for (int b2 = 0; b2 < n; ++b2)
    for (int a2 = 0; a2 < n; ++a2)
      for (int b1 = 0; b1 < n; ++b1)
        for (int a1 = 0; a1 < n; ++a1)
          for (int b0 = 0; b0 < n; ++b0)
            for (int a0 = 0; a0 < n; ++a0)
              result((a2 * n + a1) * n + a0, (b2 * n + b1) * n + b0) =
                  all(((b1 * n + a1) * n + b0) * n + a0, b2 * n + a2);
  return result;
}

Eigen::MatrixXd CellStiffness::cell_matrix(const PointCoefficients& c) const {
  const int n_nodes = n_ * n_ * n_;
  Eigen::MatrixXd K(3 * n_nodes, 3 * n_nodes);
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k) {
      const Eigen::MatrixXd block = contract(c, i, k);
      for (int b = 0; b < n_nodes; ++b)
        for (int a = 0; a < n_nodes; ++a) {
          K(3 * a + i, 3 * b + k) = block(a, b);
          K(3 * b + k, 3 * a + i) = block(a, b);
        }
    }
  return K;
}

Eigen::VectorXd CellStiffness::diagonal(const PointCoefficients& c) const {
  // products_ for a = b, as maps from the points of one direction to its nodes
  std::array<Eigen::MatrixXd, 4> squares;
  for (std::size_t p = 0; p < 4; ++p) squares[p] = products_[p](Eigen::all, Eigen::seqN(0, n_, n_ + 1)).transpose();
  const int n_nodes = n_ * n_ * n_;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(3 * n_nodes);
  for (int i = 0; i < 3; ++i)
    for (int d = 0; d < 3; ++d)
      for (int e = 0; e < 3; ++e) {
        const auto of = [&](int t) -> const Eigen::MatrixXd& { return squares[2 * (t == d) + (t == e)]; };
        result(Eigen::seqN(i, n_nodes, 3)) +=
            tensor_product(of(0), of(1), of(2), c.col(entry_of_c(3 * i + d, 3 * i + e)));
      }
  return result;
}

}  // namespace pseudorigid::continuum
