#include "continuum/statics/figure_stability.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "continuum/kernels/node_gradients.h"
#include "continuum/statics/sector_basis.h"
#include "continuum/statics/turned.h"
#include "mechanics/equilibria/small_motion.h"

namespace pseudorigid::continuum {
namespace {

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
  ClassBasis(const TangentProblem& problem, std::size_t of_class, const SectorRanks& ranks)
      : numbers(parities_of_classes[of_class]),
        parts{SectorBasis(problem, numbers[0], ranks, ranks.owns(2 * of_class)),
              SectorBasis(problem, numbers[1], ranks, ranks.owns(2 * of_class + 1))} {}

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

  /// Sets the stability of `classes` in the classes with these indices. The bases of the classes exist at the same
  /// time.
  mechanics::Status solve(const std::vector<std::size_t>& indices, int n_eigenvectors,
                          std::vector<mechanics::ClassStability>& classes) const {
    std::deque<ClassBasis> bases;  // a deque does not move its elements
    for (const std::size_t of_class : indices) bases.emplace_back(problem_, of_class, figures_.ranks());
    if (auto status = fill(n_eigenvectors, bases); !status) return status;
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (auto status = analyse(bases[i], n_eigenvectors, classes[indices[i]]); !status) return status;
    return {};
  }
  mechanics::Status solve(std::size_t of_class, int n_eigenvectors, std::complex<double> rate,
                          SmallMotionOfBall& motion) const {
    std::deque<ClassBasis> bases;
    ClassBasis& basis = bases.emplace_back(problem_, of_class, figures_.ranks());
    if (auto status = fill(n_eigenvectors, bases); !status) return status;
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
  mechanics::Status analyse(ClassBasis& basis, int n_eigenvectors, mechanics::ClassStability& of_class) const {
    const auto analyse = [&](int n, mechanics::LinearStability& stability) {
      basis.span(n);
      const auto system =
          mechanics::reduce(stiffness(basis), coriolis(basis), symmetries(basis), SectorBasis::dependent);
      return mechanics::analyse_stability(system, stability);
    };
    // Without the rates in the smaller basis, the error of a rate is the rate itself.
    if (!analyse(3 * n_eigenvectors / 5, of_class.in_smaller_basis)) of_class.in_smaller_basis = {};
    return analyse(n_eigenvectors, of_class.stability);
  }

  /// Calls `work(basis, part)` for the parts of the bases that this rank owns, until the first failure. Returns the
  /// failure of any rank on all ranks. Collective.
  template <class Work>
  mechanics::Status for_own_parts(std::deque<ClassBasis>& bases, Work&& work) const {
    mechanics::Status status;
    for (ClassBasis& basis : bases)
      for (std::size_t part = 0; part < 2; ++part)
        if (status && basis.parts[part].is_mine()) status = work(basis, part);
    return figures_.ranks().of_all(status);
  }

  /// Adds the vectors of the bases: eigenvectors, the static responses to the forces of Coriolis of the eigenvectors
  /// of the other basis of the class, and rotations. Collective.
  mechanics::Status fill(int n_eigenvectors, std::deque<ClassBasis>& bases) const {
    auto status = for_own_parts(
        bases, [&](ClassBasis& basis, std::size_t part) { return basis.parts[part].add_eigenvectors(n_eigenvectors); });
    if (!status) return status;
    for (ClassBasis& basis : bases)
      for (SectorBasis& part : basis.parts) part.share_eigenvectors();
    status = for_own_parts(bases, [&](ClassBasis& basis, std::size_t part) { return add_others(basis, part); });
    if (!status) return status;
    for (ClassBasis& basis : bases)
      for (SectorBasis& part : basis.parts) part.share_others();
    return {};
  }
  /// Adds the vectors of a part that are not eigenvectors.
  mechanics::Status add_others(ClassBasis& basis, std::size_t part) const {
    const SectorBasis& other = basis.parts[1 - part];
    for (std::size_t i = 0; spin_ > 0 && i < other.n_eigenvectors(); ++i) {
      Vector force = turned(space_, 2, other.eigenvector(i));
      for (unsigned int k = 0; k < 3 * space_.n_nodes(); ++k) force.local_element(k) *= space_.mass().local_element(k);
      if (auto status = basis.parts[part].add_response(force); !status) return status;
    }
    for (int axis = 0; axis < 3; ++axis)
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

/// Solves the classes one after the other, or several at a time if there are more ranks than the two parities of one
/// class.
mechanics::Status solve_classes(const StabilityProblem& problem, std::size_t n_ranks, int n_eigenvectors,
                                std::optional<std::size_t> only, std::vector<mechanics::ClassStability>& classes) {
  classes.clear();
  for (const auto& parities : parities_of_classes) classes.push_back({{(parities[0] & 4) != 0, parities[0] & 1}, {}});
  if (only) return problem.solve({*only}, n_eigenvectors, classes);
  const std::size_t n_at_a_time = std::clamp<std::size_t>(n_ranks / 2, 1, classes.size());
  for (std::size_t k = 0; k < classes.size();) {
    std::vector<std::size_t> indices;
    while (k < classes.size() && indices.size() < n_at_a_time) indices.push_back(k++);
    if (auto status = problem.solve(indices, n_eigenvectors, classes); !status) return status;
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
                               int n_eigenvectors, std::optional<std::size_t> only,
                               std::vector<mechanics::ClassStability>& classes) {
  return with_shift(figures, figure, [&](const StabilityProblem& problem) {
    return solve_classes(problem, figures.ranks().size(), n_eigenvectors, only, classes);
  });
}

mechanics::Status small_motion_of(const BallFigures& figures, const mechanics::EquilibriumFigure& figure,
                                  int n_eigenvectors, std::size_t of_class, std::complex<double> rate,
                                  SmallMotionOfBall& motion) {
  return with_shift(figures, figure, [&](const StabilityProblem& problem) {
    return problem.solve(of_class, n_eigenvectors, rate, motion);
  });
}

}  // namespace pseudorigid::continuum
