#include "continuum/statics/figure_stability.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "continuum/kernels/node_gradients.h"
#include "continuum/modes/largest_eigenpairs.h"
#include "continuum/statics/turned.h"
#include "mechanics/equilibria/small_motion.h"

namespace pseudorigid::continuum {
namespace {

/// Relative residual of eigenvectors. The eigenvalues of the projected problem have errors of the order of its square.
constexpr double eigenvector_tolerance = 1e-6;
/// A vector is not added to a basis if the part of the vector that is orthogonal to the basis is shorter than this
/// fraction of the vector.
constexpr double dependent = 1e-8;

/// The displacement F(ê×X) due to a rotation of the undeformed ball about the axis ê. At each node the result is the
/// mean over the cells of the node, because F has jumps between cells.
Vector turned_within(const BallSpace& space, int axis, const Vector& x) {
  const Vector turned_X = turned(space, axis, space.reference_positions());
  Vector result = space.make_vector(), n_cells = space.make_vector();
  for (unsigned int cell = 0; cell < space.n_cells(); ++cell) {
    const Eigen::Matrix3Xd X_of_cell = nodal_values(space, space.reference_positions(), cell),
                           x_of_cell = nodal_values(space, x, cell), turn = nodal_values(space, turned_X, cell);
    const auto& nodes = space.cell_nodes(cell);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto i = static_cast<int>(a);
      const Eigen::Matrix3d F = reference_gradient(space.reference_cell(), x_of_cell, i) *
                                reference_gradient(space.reference_cell(), X_of_cell, i).inverse();
      const Eigen::Vector3d u = F * turn.col(i);
      for (unsigned int c = 0; c < 3; ++c) {
        result.local_element(3 * nodes[a] + c) += u[c];
        n_cells.local_element(3 * nodes[a] + c) += 1;
      }
    }
  }
  for (unsigned int i = 0; i < 3 * space.n_nodes(); ++i) result.local_element(i) /= n_cells.local_element(i);
  return result;
}

/// A basis of displacements u of one parity. The vectors of the basis satisfy G u = 0, and are orthonormal in the inner
/// product of the mass. They span eigenvectors, responses and other displacements, which are added in this order.
class SectorBasis {
 public:
  SectorBasis(const TangentProblem& problem, int number) : sector_(problem, parity_of_sector(number)) {}

  /// Adds the eigenvectors of K for the n lowest eigenvalues, without uniform translations. Must be called before
  /// add_response and add_projected, because this function factorises the operator of the sector.
  mechanics::Status add_eigenvectors(int n) {
    if (auto status = sector_.factorize(); !status) return status;
    std::vector<EigenPair> known = uniform_motions();
    const std::size_t n_uniform = known.size();
    const auto apply = [&](std::span<const double> y, std::span<double> z) { return sector_.apply(y, z); };
    if (auto status = append_largest_eigenpairs(apply, sector_.n_unknowns(), n, eigenvector_tolerance, known); !status)
      return status;
    known.resize(std::min(known.size(), n_uniform + static_cast<std::size_t>(n)));
    for (std::size_t i = n_uniform; i < known.size(); ++i) {
      ParitySector::Mode mode;
      if (auto status = sector_.mode_of(known[i].vector, mode); !status) return status;
      eigenvectors_.push_back(sector_.entries_of(mode.u));
    }
    return {};
  }
  std::size_t n_eigenvectors() const { return eigenvectors_.size(); }
  Vector eigenvector(std::size_t i) const { return sector_.field_of(eigenvectors_[i]); }
  /// Adds the static response to a force, which follows from the next eigenvector of the other basis of the class.
  mechanics::Status add_response(const Vector& force) {
    Vector u;
    if (auto status = sector_.respond(force, u); !status) return status;
    responses_.push_back(sector_.entries_of(u));
    return {};
  }
  /// Adds a displacement near u that satisfies G u = 0.
  void add_projected(const Vector& u) { others_.push_back(sector_.without_volume(sector_.entries_of(u))); }
  /// Makes the basis of the first n eigenvectors, the first n responses and all other displacements.
  void span(std::size_t n) {
    basis_.clear();
    for (const auto* vectors : {&eigenvectors_, &responses_})
      for (std::size_t i = 0; i < std::min(n, vectors->size()); ++i) append((*vectors)[i]);
    for (const Eigen::VectorXd& u : others_) append(u);
  }

  const ParitySector& sector() const { return sector_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(basis_.size()); }
  const Eigen::VectorXd& operator[](Eigen::Index i) const { return basis_[static_cast<std::size_t>(i)]; }
  Vector field(Eigen::Index i) const { return sector_.field_of((*this)[i]); }
  /// The sum of the vectors of the basis with the coefficients z.
  Vector combination(const Eigen::VectorXd& z) const {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(sector_.n_unknowns()));
    for (Eigen::Index i = 0; i < size(); ++i) u += z[i] * (*this)[i];
    return sector_.field_of(u);
  }
  /// The coordinates uᵀM b of a field u in the basis, for each vector b of the basis.
  Eigen::VectorXd coordinates(const Vector& u) const {
    const Eigen::VectorXd M_u = sector_.mass().cwiseProduct(sector_.entries_of(u));
    Eigen::VectorXd result(size());
    for (Eigen::Index i = 0; i < size(); ++i) result[i] = M_u.dot((*this)[i]);
    return result;
  }
  /// The matrix with the entries bᵀK b' for the vectors b and b' of the basis. `shift` is the shift s of the problem.
  /// The operator of the sector is K + s M, so the function subtracts s from the diagonal.
  Eigen::MatrixXd stiffness(double shift) const {
    Eigen::MatrixXd K(size(), size());
    for (Eigen::Index j = 0; j < size(); ++j) {
      const Eigen::VectorXd K_b = sector_.product((*this)[j]);
      for (Eigen::Index i = 0; i < size(); ++i) K(i, j) = (*this)[i].dot(K_b);
      K(j, j) -= shift;
    }
    return (K + K.transpose()) / 2;
  }

 private:
  /// The uniform translation u in the sector as the vector M^½ u of length 1, which is an argument of
  /// ParitySector::apply. The result is empty if the sector does not contain a translation.
  std::vector<EigenPair> uniform_motions() const {
    const auto& sign = sector_.parity().sign;
    if (std::ranges::count(sign, -1) != 1) return {};
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(std::ranges::find(sign, -1) - sign.begin());
    Vector u = sector_.space().make_vector();
    for (unsigned int i = 0; i < 3 * sector_.space().n_nodes(); ++i) u.local_element(i) = axis[i % 3];
    const Eigen::VectorXd y = sector_.entries_of(u).cwiseProduct(sector_.mass().cwiseSqrt()).normalized();
    return {{0, {y.begin(), y.end()}}};
  }
  /// Appends the part of u that is orthogonal to the basis, divided by its length. Omits this part if it is short
  /// (`dependent`).
  void append(Eigen::VectorXd u) {
    const double before = std::sqrt(u.dot(sector_.mass().cwiseProduct(u)));
    for (int repetition = 0; repetition < 2; ++repetition)
      for (const Eigen::VectorXd& b : basis_) u -= b.dot(sector_.mass().cwiseProduct(u)) * b;
    const double length = std::sqrt(u.dot(sector_.mass().cwiseProduct(u)));
    if (length > dependent * before) basis_.push_back(u / length);
  }

  ParitySector sector_;
  std::vector<Eigen::VectorXd> eigenvectors_, responses_, others_;
  std::vector<Eigen::VectorXd> basis_;
};

/// The largest absolute value of a negative stiffness per mass of a uniform translation, due to the rotation or to a
/// quadratic potential; 0 if no such stiffness is negative. The shift s of with_shift must be larger than this value.
/// The basis does not contain translations, but K + s M must be positive definite on the whole parity sector.
double softening(const BallFigures& figures, double drive) {
  if (figures.drive() == Drive::rotation) return std::max(drive, 0.0);
  return std::max(0.0, -drive * figures.forcing().quadratic.diagonal().minCoeff());
}

/// The number of the parity that contains the rotations about an axis (parity_of_sector).
int parity_of_rotation(int axis) { return 7 ^ (1 << axis); }

/// The numbers of the two parities of each class (parity_of_sector). Bit 0 of a number is set for motions that are odd
/// in x, and bit 2 for motions that are odd in z.
constexpr std::array<std::array<int, 2>, 4> parities_of_classes{{{0, 3}, {1, 2}, {4, 7}, {5, 6}}};

/// The bases of the two parities of a class. `numbers` has the numbers of the parities.
struct ClassBasis {
  ClassBasis(const TangentProblem& problem, std::size_t of_class)
      : numbers(parities_of_classes[of_class]),
        parts{SectorBasis(problem, numbers[0]), SectorBasis(problem, numbers[1])} {}

  bool contains(int number) const { return number == numbers[0] || number == numbers[1]; }
  void span(int n_eigenvectors) {
    for (SectorBasis& part : parts) part.span(static_cast<std::size_t>(n_eigenvectors));
  }
  Eigen::Index size() const { return parts[0].size() + parts[1].size(); }
  /// The coordinates of the field u in both bases. `number` is the parity of u, one of the two parities of the class.
  Eigen::VectorXd coordinates(const Vector& u, int number) const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(size());
    if (number == numbers[0])
      result.head(parts[0].size()) = parts[0].coordinates(u);
    else
      result.tail(parts[1].size()) = parts[1].coordinates(u);
    return result;
  }

  std::array<int, 2> numbers;
  std::array<SectorBasis, 2> parts;
};

/// The displacements due to rotations of space and of the undeformed ball about each axis.
struct Rotations {
  std::array<Vector, 3> of_space, of_ball;
};

class StabilityProblem {
 public:
  StabilityProblem(const BallFigures& figures, const mechanics::EquilibriumFigure& figure, double shift)
      : figures_(figures),
        space_(figures.body().space()),
        drive_(figure.drive),
        spin_(figures.drive() == Drive::rotation ? std::sqrt(std::max(figure.drive, 0.0)) : 0),
        x_(figures.positions(figure)),
        lambda_(figures.multiplier(figure)),
        shift_(shift),
        problem_(figures.state(x_, lambda_, figure.drive), shift_) {
    for (int axis = 0; axis < 3; ++axis) {
      rotations_.of_space[axis] = turned(space_, axis, x_);
      rotations_.of_ball[axis] = turned_within(space_, axis, x_);
    }
  }

  mechanics::Status solve(std::size_t number, int n_eigenvectors, mechanics::ClassStability& of_class) const {
    ClassBasis basis(problem_, number);
    if (auto status = fill(n_eigenvectors, basis); !status) return status;
    const auto analyse = [&](int n, mechanics::LinearStability& stability) {
      basis.span(n);
      const auto system = mechanics::reduce(stiffness(basis), coriolis(basis), symmetries(basis), dependent);
      return mechanics::analyse_stability(system, stability);
    };
    // Without the rates in the smaller basis, the error of a rate is the rate itself.
    if (!analyse(3 * n_eigenvectors / 5, of_class.in_smaller_basis)) of_class.in_smaller_basis = {};
    return analyse(n_eigenvectors, of_class.stability);
  }
  mechanics::Status solve(std::size_t of_class, int n_eigenvectors, std::complex<double> rate,
                          SmallMotionOfBall& motion) const {
    ClassBasis basis(problem_, of_class);
    if (auto status = fill(n_eigenvectors, basis); !status) return status;
    basis.span(n_eigenvectors);
    mechanics::SmallMotion found;
    if (auto status = mechanics::motion_near(stiffness(basis), coriolis(basis), rate, found); !status) return status;
    motion.rate = found.rate;
    Eigen::Index first = 0;
    for (std::size_t part = 0; part < 2; ++part) {
      const SectorBasis& of_part = basis.parts[part];
      const Eigen::VectorXcd z = found.shape.segment(first, of_part.size());
      first += of_part.size();
      motion.parts[part] = {of_part.sector().parity(), of_part.combination(z.real()), of_part.combination(z.imag())};
    }
    return {};
  }

 private:
  /// Adds the vectors of both bases: eigenvectors, the static responses to the forces of Coriolis of the eigenvectors
  /// of the other basis, and rotations.
  mechanics::Status fill(int n_eigenvectors, ClassBasis& basis) const {
    for (SectorBasis& part : basis.parts)
      if (auto status = part.add_eigenvectors(n_eigenvectors); !status) return status;
    if (spin_ > 0)
      for (std::size_t part = 0; part < 2; ++part)
        for (std::size_t i = 0; i < basis.parts[1 - part].n_eigenvectors(); ++i) {
          Vector force = turned(space_, 2, basis.parts[1 - part].eigenvector(i));
          for (unsigned int k = 0; k < 3 * space_.n_nodes(); ++k)
            force.local_element(k) *= space_.mass().local_element(k);
          if (auto status = basis.parts[part].add_response(force); !status) return status;
        }
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t part = 0; part < 2; ++part)
        if (basis.numbers[part] == parity_of_rotation(axis)) {
          basis.parts[part].add_projected(rotations_.of_space[axis]);
          basis.parts[part].add_projected(rotations_.of_ball[axis]);
        }
    return {};
  }

  Eigen::MatrixXd stiffness(const ClassBasis& basis) const {
    const Eigen::Index n = basis.size(), n_first = basis.parts[0].size();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    K.topLeftCorner(n_first, n_first) = basis.parts[0].stiffness(shift_);
    K.bottomRightCorner(n - n_first, n - n_first) = basis.parts[1].stiffness(shift_);
    return K;
  }
  /// The matrix with the entries bᵀM(Ω ê₃×b') for the vectors b and b' of both bases. The field ê₃×b' has the other
  /// parity of the class than b'.
  Eigen::MatrixXd coriolis(const ClassBasis& basis) const {
    const Eigen::Index n = basis.size(), n_first = basis.parts[0].size();
    Eigen::MatrixXd coriolis(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const std::size_t part = j < n_first ? 0 : 1;
      const Vector u = basis.parts[part].field(part == 0 ? j : j - n_first);
      coriolis.col(j) = spin_ * basis.coordinates(turned(space_, 2, u), basis.numbers[1 - part]);
    }
    return coriolis;
  }

  /// Directions and rates of the rotations of space and of the ball that belong to the class and do not change the
  /// energy. A rotation of space about a coordinate axis ζ has the direction ζ×x and the rate −Ω(ê₃×ζ)×x. The rotations
  /// of the ball have the rate 0.
  mechanics::SymmetryDirections symmetries(const ClassBasis& basis) const {
    mechanics::SymmetryDirections N;
    const auto append = [&](const Eigen::VectorXd& y, const Eigen::VectorXd& rate) {
      N.y.conservativeResize(basis.size(), N.y.cols() + 1);
      N.rate.conservativeResize(basis.size(), N.rate.cols() + 1);
      N.y.col(N.y.cols() - 1) = y;
      N.rate.col(N.rate.cols() - 1) = rate;
    };
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(basis.size());
    for (int axis = 0; axis < 3; ++axis) {
      const int number = parity_of_rotation(axis);
      if (!basis.contains(number)) continue;
      const auto of_space = [&](int other) {
        return basis.coordinates(rotations_.of_space[other], parity_of_rotation(other));
      };
      Eigen::VectorXd rate = none;
      if (axis == 0) rate = -spin_ * of_space(1);
      if (axis == 1) rate = spin_ * of_space(0);
      if (figures_.permits_rotation_of_space(axis)) append(of_space(axis), rate);
      if (figures_.permits_rotation_of_ball(axis) && !figures_.is_symmetric_about(axis, drive_))
        append(basis.coordinates(rotations_.of_ball[axis], number), none);
    }
    return N;
  }

  const BallFigures& figures_;
  const BallSpace& space_;
  double drive_, spin_;
  Vector x_, lambda_;
  double shift_;
  TangentProblem problem_;
  Rotations rotations_;
};

mechanics::Status all_classes(const StabilityProblem& problem, int n_eigenvectors,
                              std::vector<mechanics::ClassStability>& classes) {
  classes.clear();
  for (std::size_t k = 0; k < parities_of_classes.size(); ++k) {
    const int first = parities_of_classes[k][0];
    mechanics::ClassStability of_class{{(first & 4) != 0, first & 1}, {}};
    if (auto status = problem.solve(k, n_eigenvectors, of_class); !status) return status;
    classes.push_back(std::move(of_class));
  }
  return {};
}

/// Calls `solve` with the problem of a figure. K + s M must be positive definite. A larger shift s permits a more
/// unstable figure, but the iteration for the eigenvectors is then slower. If `solve` fails, the function therefore
/// calls `solve` again, at most twice, each time with a shift 8 times as large. Returns the status of the last call.
template <class Solve>
mechanics::Status with_shift(const BallFigures& figures, const mechanics::EquilibriumFigure& figure, Solve&& solve) {
  double shift = figures.typical_stiffness() + softening(figures, figure.drive);
  constexpr double next = 8;
  mechanics::Status status;
  for (int trial = 0; trial < 3; ++trial, shift *= next) {
    status = solve(StabilityProblem(figures, figure, shift));
    if (status) break;
  }
  return status;
}

}  // namespace

mechanics::Status stability_of(const BallFigures& figures, const mechanics::EquilibriumFigure& figure,
                               int n_eigenvectors, std::vector<mechanics::ClassStability>& classes) {
  return with_shift(figures, figure,
                    [&](const StabilityProblem& problem) { return all_classes(problem, n_eigenvectors, classes); });
}

mechanics::Status small_motion_of(const BallFigures& figures, const mechanics::EquilibriumFigure& figure,
                                  int n_eigenvectors, std::size_t of_class, std::complex<double> rate,
                                  SmallMotionOfBall& motion) {
  return with_shift(figures, figure, [&](const StabilityProblem& problem) {
    return problem.solve(of_class, n_eigenvectors, rate, motion);
  });
}

}  // namespace pseudorigid::continuum
