#include "polynomial/figure_spectrum.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <variant>

#include "materials/fluid.h"
#include "mechanics/core/dense_algebra.h"
#include "polynomial/constraint.h"
#include "polynomial/gram_solver.h"
#include "polynomial/octant_quadrature.h"
#include "polynomial/parity_parts.h"

namespace pseudorigid::polynomial {
namespace {

constexpr Parity half_turn = 3;  // the bits of x and y, in which the two parities of the motions of a class differ

/// A singular value of the constraint matrix G, or of the matrix of the symmetries, counts as zero if it is less than
/// this fraction of the largest singular value.
constexpr double dependent = 1e-8;

/// Indices of the coefficients of each parity, without uniform motions.
std::array<std::vector<int>, n_parities> coefficients_by_parity(const PolynomialSpace& space) {
  auto places = unknowns_by_parity(space);
  for (int i = 0; i < 3; ++i)
    for (auto& of_parity : places) std::erase(of_parity, space.place(i, 0));  // the first function is the constant
  return places;
}

Eigen::MatrixXd columns(const Eigen::MatrixXd& A, const std::vector<Eigen::Index>& kept) { return A(Eigen::all, kept); }

/// The rows of A with a norm greater than `round_off`. The row of a constraint that does not have the symmetry of a
/// class has only round-off.
Eigen::MatrixXd rows_beyond(double round_off, const Eigen::MatrixXd& A) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    if (A.row(i).norm() > round_off) kept.push_back(i);
  return A(kept, Eigen::all);
}

}  // namespace

FigureSpectrum::FigureSpectrum(const FigureSetup& setup)
    : incompressible_(setup.incompressible),
      is_fluid_(std::holds_alternative<materials::Fluid>(setup.body.law)),
      forces_(setup, {}),
      octant_(std::make_shared<PolynomialSpace>(setup.body.degree, std::array<bool, 3>{true, true, true},
                                                setup.body.semi_axes)),
      turns_(std::make_shared<const Turns>(space())) {
  if (setup.drive == Drive::loads) forcing_ = loads::constant_forcing(acting_setup(setup).loads);
  for (const bool odd_in_z : {false, true})
    for (const bool odd_under_half_turn : {false, true}) add_parts(odd_in_z, odd_under_half_turn, setup.figure);
}

/// Adds the class with these symmetries to parts_. On a spheroid, the function divides the class into parts, one for
/// each azimuthal number m. The joint rotation of a field about axis 3, u ↦ ê₃×u − ∂_φ u, has the square −m² on such a
/// part.
void FigureSpectrum::add_parts(bool odd_in_z, bool odd_under_half_turn, Figure figure) {
  const auto by_parity = coefficients_by_parity(space());
  const Parity first = (odd_in_z ? 4U : 0U) | (odd_under_half_turn ? 1U : 0U);
  std::vector<int> places = by_parity[first];
  places.insert(places.end(), by_parity[first ^ half_turn].begin(), by_parity[first ^ half_turn].end());
  const auto n = static_cast<Eigen::Index>(places.size());
  if (n == 0) return;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(space().n_unknowns(), n);
  for (Eigen::Index k = 0; k < n; ++k) all(places[k], k) = 1;
  std::map<int, std::vector<Eigen::Index>> of_m;
  if (figure == Figure::spheroid) {
    Eigen::MatrixXd turn(space().n_unknowns(), n);
    for (Eigen::Index k = 0; k < n; ++k) turn.col(k) = turns_->of_space(2, all.col(k)) - turns_->of_ball(2, all.col(k));
    const auto squares = mechanics::symmetric_spectrum(turn.transpose() * turn);
    for (Eigen::Index k = 0; k < n; ++k)
      of_m[static_cast<int>(std::lround(std::sqrt(std::max(squares.values[k], 0.0))))].push_back(k);
    all = all * squares.vectors;
  } else {
    for (Eigen::Index k = 0; k < n; ++k) of_m[odd_under_half_turn ? 1 : 0].push_back(k);
  }
  for (const auto& [m, members] : of_m) {
    Part part{{odd_in_z, m}, columns(all, members), {}};
    part.exchanges = exchanges(part.fields);
    parts_.push_back(std::move(part));
  }
}

/// A basis of the fields w in the span of `fields` that have no divergence in the ball and no normal component on its
/// surface. Each column has the coefficients of a field. For a solid, the result has no columns.
Eigen::MatrixXd FigureSpectrum::exchanges(const Eigen::MatrixXd& fields) const {
  if (!is_fluid_) return Eigen::MatrixXd(fields.rows(), 0);
  const Eigen::VectorXd X = forces_.body().affine(Eigen::Matrix3d::Identity());
  const Eigen::MatrixXd divergence = constraint_matrix(space(), X) * fields;
  Eigen::MatrixXd squares = divergence.transpose() * divergence;
  for (const SurfacePoint& point : octant_surface_points(space().degree() + 2))  // exact for degree 2N + 2
    for (int image = 0; image < n_parities; ++image) {
      std::array<double, 3> xi = point.xi;
      for (int i = 0; i < 3; ++i)
        if (image >> i & 1) xi[i] = -xi[i];
      const std::vector<Jet> functions = space().functions_at(xi);
      Eigen::RowVectorXd normal(fields.rows());
      for (int i = 0; i < 3; ++i)
        for (int a = 0; a < space().n_functions(); ++a) normal[space().place(i, a)] = xi[i] * functions[a].value;
      const Eigen::RowVectorXd of_fields = normal * fields;
      squares += point.weight * of_fields.transpose() * of_fields;
    }
  const auto spectrum = mechanics::symmetric_spectrum(squares);
  constexpr double none = 1e-10;  // other eigenvalues are of order 1
  return fields * spectrum.vectors.leftCols((spectrum.values.array() < none).count());
}

Eigen::VectorXd FigureSpectrum::whole(const Eigen::VectorXd& x) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(space().n_unknowns());
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < space().n_functions(); ++a)
      if (const int at = octant_->place(i, a); at >= 0) all[space().place(i, a)] = x[at];
  return all;
}

Eigen::VectorXd FigureSpectrum::whole_multiplier(const Eigen::VectorXd& lambda) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(space().n_pressures());
  for (int b = 0; b < space().n_functions(); ++b)
    if (const int at = octant_->pressure_place(b); at >= 0) all[space().pressure_place(b)] = lambda[at];
  return all;
}

double FigureSpectrum::spin(const EquilibriumFigure& figure) const {
  return forces_.drive() == Drive::rotation ? std::sqrt(std::max(figure.drive, 0.0)) : 0;
}

/// Directions and rates of the rotations of space and of the ball about the three axes. A rotation that changes the
/// energy of the loads has the direction 0. A rotation of space about a coordinate axis ζ has the direction ζ×x and the
/// rate −(ω×ζ)×x with ω = Ω ê₃ and the spin Ω. The rotations of the ball have the rate 0.
mechanics::SymmetryDirections FigureSpectrum::turns(const Eigen::VectorXd& x, double spin) const {
  mechanics::SymmetryDirections N{Eigen::MatrixXd::Zero(x.size(), 6), Eigen::MatrixXd::Zero(x.size(), 6)};
  for (int axis = 0; axis < 3; ++axis) {
    if (loads::permits_rotation_of_space(forcing_, axis)) N.y.col(axis) = turns_->of_space(axis, x);
    if (loads::permits_rotation_of_body(forcing_, axis)) N.y.col(3 + axis) = turns_->of_ball(axis, x);
  }
  N.rate.col(0) = -spin * turns_->of_space(1, x);
  N.rate.col(1) = spin * turns_->of_space(0, x);
  return N;
}

Eigen::MatrixXd FigureSpectrum::stiffness(const EquilibriumFigure& figure) const {
  const Eigen::VectorXd x = whole(figure.x), lambda = whole_multiplier(figure.lambda);
  return stiffness_by_parity(space(), [&](const Eigen::VectorXd& u) {
    Eigen::VectorXd rate = forces_.rate(x, figure.drive, u);
    if (incompressible_) add_reaction_rate(space(), x, u, lambda, rate);
    return rate;
  });
}

/// The symmetries of a class: the rotations that have a component in the class, and the motions A w of a fluid
/// (figure_spectrum.h). The columns of T are a basis of the motions of the class. The result has the directions and
/// rates of the symmetries in this basis. `turns` has the directions and rates of the rotations for the whole body.
mechanics::SymmetryDirections FigureSpectrum::symmetries(const Part& part, const Eigen::MatrixXd& T,
                                                         const Eigen::Matrix3d& A,
                                                         const mechanics::SymmetryDirections& turns) const {
  constexpr double absent = 1e-6;  // relative bound for the round-off of a rotation in other classes
  const Eigen::MatrixXd y = T.transpose() * turns.y;
  std::vector<Eigen::Index> present;
  for (Eigen::Index k = 0; k < y.cols(); ++k)
    if (y.col(k).norm() > absent * turns.y.col(k).norm()) present.push_back(k);
  Eigen::MatrixXd exchanged = part.exchanges;  // the motions A w
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < space().n_functions(); ++a) exchanged.row(space().place(i, a)) *= A(i, i);
  const auto n_turns = static_cast<Eigen::Index>(present.size());
  mechanics::SymmetryDirections N{Eigen::MatrixXd::Zero(T.cols(), n_turns + exchanged.cols()),
                                  Eigen::MatrixXd::Zero(T.cols(), n_turns + exchanged.cols())};
  N.y.leftCols(n_turns) = columns(y, present);
  N.rate.leftCols(n_turns) = T.transpose() * columns(turns.rate, present);
  N.y.rightCols(exchanged.cols()) = T.transpose() * exchanged;
  return N;
}

Eigen::MatrixXd FigureSpectrum::constraint_at(const EquilibriumFigure& figure) const {
  return incompressible_ ? constraint_matrix(space(), whole(figure.x)) : Eigen::MatrixXd();
}

FigureSpectrum::ClassEquation FigureSpectrum::equation(const Part& part, const EquilibriumFigure& figure,
                                                       const Eigen::MatrixXd& K, const Eigen::MatrixXd& G) const {
  Eigen::MatrixXd T = part.fields;
  if (incompressible_) T = T * mechanics::null_space(rows_beyond(dependent * G.norm(), G * T), dependent);
  Eigen::MatrixXd coriolis(T.rows(), T.cols());
  for (Eigen::Index k = 0; k < T.cols(); ++k) coriolis.col(k) = spin(figure) * turns_->of_space(2, T.col(k));
  return {T, T.transpose() * K * T, T.transpose() * coriolis};
}

mechanics::Status FigureSpectrum::analyse(const EquilibriumFigure& figure, std::optional<std::size_t> only,
                                          std::vector<ClassStability>& classes) const {
  const Eigen::VectorXd x = whole(figure.x);
  const mechanics::SymmetryDirections of_body = turns(x, spin(figure));
  const Eigen::MatrixXd K = stiffness(figure), G = constraint_at(figure);
  classes.clear();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    classes.push_back({parts_[k].motions, {}});
    if (only && k != *only) continue;
    const ClassEquation of = equation(parts_[k], figure, K, G);
    if (of.T.cols() == 0) continue;
    const auto system = mechanics::reduce(of.stiffness, of.coriolis,
                                          symmetries(parts_[k], of.T, space().affine_part(x), of_body), dependent);
    if (auto status = mechanics::analyse_stability(system, classes.back().stability); !status) return status;
  }
  return {};
}

mechanics::Status FigureSpectrum::motion(const EquilibriumFigure& figure, std::size_t of_class,
                                         std::complex<double> rate, mechanics::SmallMotion& motion) const {
  const ClassEquation of = equation(parts_.at(of_class), figure, stiffness(figure), constraint_at(figure));
  auto status = mechanics::motion_near(of.stiffness, of.coriolis, rate, motion);
  motion.shape = of.T * motion.shape;
  return status;
}

}  // namespace pseudorigid::polynomial
