#include "continuum/statics/figure_stability.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

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

/// The number of the parity of the image of a displacement under the exchange of the axes 1 and 2.
int exchanged_parity(int number) { return (number & 4) | (number & 1) << 1 | (number & 2) >> 1; }

/// The bases of the two parities of a class. `numbers` has the numbers of the parities. If the figure is symmetric
/// under the exchange of the axes 1 and 2, and the exchange maps the first parity to the second one, the vectors of the
/// second basis are the images of those of the first.
struct ClassBasis {
  ClassBasis(const BallFigures& of_figures, const TangentProblem& problem, std::size_t of_class,
             const SectorRanks& ranks)
      : figures(of_figures),
        numbers(parities_of_classes[of_class]),
        has_images(figures.is_symmetric_under_exchange() && exchanged_parity(numbers[0]) == numbers[1]),
        parts{SectorBasis(problem, numbers[0], ranks, ranks.owns(0)),
              SectorBasis(problem, numbers[1], ranks, !has_images && ranks.owns(1))} {}

  /// The number of bases whose vectors are computed.
  std::size_t n_computed() const { return has_images ? 1 : 2; }
  bool contains(int number) const { return number == numbers[0] || number == numbers[1]; }
  /// Eigenvector i of a part.
  Vector eigenvector(std::size_t part, std::size_t i) const {
    return part < n_computed() ? parts[part].eigenvector(i) : figures.exchanged(parts[0].eigenvector(i));
  }
  void span(int n_eigenvectors) {
    for (std::size_t part = 0; part < n_computed(); ++part) parts[part].span(static_cast<std::size_t>(n_eigenvectors));
    if (has_images) parts[1].span_images(parts[0], [this](const Vector& u) { return figures.exchanged(u); });
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

  const BallFigures& figures;
  std::array<int, 2> numbers;
  bool has_images;  ///< true if the second basis has the images of the first
  std::array<SectorBasis, 2> parts;
};

/// The displacements due to rotations of space and of the undeformed ball about each axis.
struct Rotations {
  std::array<Vector, 3> of_space, of_ball;
};

/// Replaces `stability` by that of the owner on all ranks. Collective.
void share(const SectorRanks& ranks, bool is_owner, mechanics::LinearStability& stability) {
  if (ranks.size() == 1) return;
  auto& [rates, second_variation, n_negative, growth_rate, stable] = stability;
  std::vector<double> values{static_cast<double>(rates.size()), static_cast<double>(n_negative), growth_rate,
                             stable ? 1.0 : 0.0};
  for (const mechanics::Rate& rate : rates)
    values.insert(values.end(), {rate.s.real(), rate.s.imag(), static_cast<double>(rate.energy_sign)});
  values.insert(values.end(), second_variation.begin(), second_variation.end());
  values = ranks.of_owner(is_owner, values);
  n_negative = static_cast<int>(values[1]);
  growth_rate = values[2];
  stable = values[3] == 1;
  rates.clear();
  const double* next = values.data() + 4;
  for (double n = values[0]; n > 0; --n, next += 3) rates.push_back({{next[0], next[1]}, static_cast<int>(next[2])});
  second_variation = Eigen::Map<const Eigen::VectorXd>(next, values.data() + values.size() - next);
}

class StabilityProblem {
 public:
  /// `ranks` share the parities of a class; they must exist as long as the object.
  StabilityProblem(const BallFigures& figures, const mechanics::EquilibriumFigure& figure, double shift,
                   const SectorRanks& ranks)
      : figures_(figures),
        ranks_(ranks),
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

  /// Sets the stability in the class with this index. Collective.
  mechanics::Status solve(std::size_t number, int n_eigenvectors, mechanics::ClassStability& of_class) const {
    ClassBasis basis(figures_, problem_, number, ranks_);
    if (auto status = fill(n_eigenvectors, basis); !status) return status;
    const auto analyse = [&](int n, mechanics::LinearStability& stability) {
      basis.span(n);
      const Eigen::MatrixXd K = stiffness(basis);
      mechanics::Status status;
      if (ranks_.is_first())
        status = mechanics::analyse_stability(
            mechanics::reduce(K, coriolis(basis), symmetries(basis), SectorBasis::dependent), stability);
      share(ranks_, ranks_.is_first(), stability);
      return ranks_.of_all(status);
    };
    // Without the rates in the smaller basis, the error of a rate is the rate itself.
    if (!analyse(3 * n_eigenvectors / 5, of_class.in_smaller_basis)) of_class.in_smaller_basis = {};
    return analyse(n_eigenvectors, of_class.stability);
  }
  mechanics::Status solve(std::size_t of_class, int n_eigenvectors, std::complex<double> rate,
                          SmallMotionOfBall& motion) const {
    ClassBasis basis(figures_, problem_, of_class, ranks_);
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
  /// Calls `work(part)` for the parts of the basis that this rank owns, until the first failure. Returns the failure of
  /// any rank on all ranks. Collective.
  template <class Work>
  mechanics::Status for_own_parts(const ClassBasis& basis, Work&& work) const {
    mechanics::Status status;
    for (std::size_t part = 0; part < basis.n_computed(); ++part)
      if (status && basis.parts[part].is_mine()) status = work(part);
    return ranks_.of_all(status);
  }

  /// Adds the vectors of both bases: eigenvectors, the static responses to the forces of Coriolis of the eigenvectors
  /// of the other basis of the class, and rotations. Collective.
  mechanics::Status fill(int n_eigenvectors, ClassBasis& basis) const {
    auto status = for_own_parts(basis, [&](std::size_t part) {
      return basis.parts[part].add_eigenvectors(n_eigenvectors, known_eigenvector(basis.numbers[part]));
    });
    if (!status) return status;
    for (std::size_t part = 0; part < basis.n_computed(); ++part) basis.parts[part].share_eigenvectors();
    status = for_own_parts(basis, [&](std::size_t part) { return add_others(basis, part); });
    if (!status) return status;
    for (std::size_t part = 0; part < basis.n_computed(); ++part) basis.parts[part].share_others();
    return {};
  }
  /// The rotation of a symmetric figure about its axis, an eigenvector of K with the eigenvalue 0, if it has the parity
  /// with this number; otherwise null. The basis would have it twice, with a difference of round-off.
  const Vector* known_eigenvector(int number) const {
    for (int axis = 0; axis < 3; ++axis)
      if (number == parity_of_rotation(axis) && figures_.is_symmetric_about(axis, drive_) &&
          figures_.permits_rotation_of_space(axis))
        return &rotations_.of_space[axis];
    return nullptr;
  }
  /// Adds the vectors of a part that are not eigenvectors.
  mechanics::Status add_others(ClassBasis& basis, std::size_t part) const {
    const std::size_t other = 1 - part;
    const std::size_t n_eigenvectors = basis.parts[basis.has_images ? 0 : other].n_eigenvectors();
    std::vector<Vector> forces;
    for (std::size_t i = 0; spin_ > 0 && i < n_eigenvectors; ++i) {
      Vector& force = forces.emplace_back(turned(space_, 2, basis.eigenvector(other, i)));
      for (unsigned int k = 0; k < 3 * space_.n_nodes(); ++k) force.local_element(k) *= space_.mass().local_element(k);
    }
    if (auto status = basis.parts[part].add_responses(forces); !status) return status;
    for (int axis = 0; axis < 3; ++axis)
      if (basis.numbers[part] == parity_of_rotation(axis)) {
        basis.parts[part].add_projected(rotations_.of_space[axis]);
        // The two rotations of a symmetric figure differ by the error of the mesh alone.
        if (!figures_.is_symmetric_about(axis, drive_)) basis.parts[part].add_projected(rotations_.of_ball[axis]);
      }
    return {};
  }

  Eigen::MatrixXd stiffness(const ClassBasis& basis) const {
    const Eigen::Index n = basis.size(), n_first = basis.parts[0].size();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    K.topLeftCorner(n_first, n_first) = basis.parts[0].stiffness(shift_);
    auto of_second = K.bottomRightCorner(n - n_first, n - n_first);
    if (basis.has_images)
      of_second = K.topLeftCorner(n_first, n_first);
    else
      of_second = basis.parts[1].stiffness(shift_);
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
  const SectorRanks& ranks_;
  const BallSpace& space_;
  double drive_, spin_;
  Vector x_, lambda_;
  double shift_;
  TangentProblem problem_;
  Rotations rotations_;
};

/// The problems of a figure for the shifts s, 8s and 64s, which are made when they are needed. K + s M must be positive
/// definite. A larger shift permits a more unstable figure, but the iteration for the eigenvectors is then slower.
class ShiftedProblems {
 public:
  ShiftedProblems(const BallFigures& figures, const mechanics::EquilibriumFigure& figure, const SectorRanks& ranks)
      : figures_(figures), figure_(figure), ranks_(ranks) {}

  /// Calls `solve` with the problem of the first shift, and after a failure with those of the larger shifts. Returns
  /// the status of the last call.
  template <class Solve>
  mechanics::Status solve(Solve&& solve) {
    mechanics::Status status;
    for (std::size_t trial = 0; trial < problems_.size(); ++trial) {
      if (!problems_[trial]) {
        const double shift = figures_.typical_stiffness() + softening(figures_, figure_.drive);
        problems_[trial] = std::make_unique<StabilityProblem>(figures_, figure_, std::pow(8, trial) * shift, ranks_);
      }
      status = solve(*problems_[trial]);
      if (status) break;
    }
    return status;
  }

 private:
  const BallFigures& figures_;
  const mechanics::EquilibriumFigure& figure_;
  const SectorRanks& ranks_;
  std::array<std::unique_ptr<StabilityProblem>, 3> problems_;
};

}  // namespace

mechanics::Status stability_of(const BallFigures& figures, const mechanics::EquilibriumFigure& figure,
                               int n_eigenvectors, std::optional<std::size_t> only,
                               std::vector<mechanics::ClassStability>& classes) {
  classes.clear();
  for (const auto& parities : parities_of_classes) classes.push_back({{(parities[0] & 4) != 0, parities[0] & 1}, {}});
  const RankGroups groups(figures.ranks(), only ? 1 : classes.size());
  ShiftedProblems problems(figures, figure, groups.own());
  mechanics::Status status;
  // Each class has the first shift with which it can be solved, so its result does not depend on the other classes.
  for (std::size_t k = 0; k < classes.size(); ++k) {
    if ((only && k != *only) || !groups.owns(k) || !status) continue;
    status =
        problems.solve([&](const StabilityProblem& problem) { return problem.solve(k, n_eigenvectors, classes[k]); });
  }
  status = figures.ranks().of_all(status);
  if (!status || groups.size() == 1) return status;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    const bool is_owner = groups.owns(k) && groups.own().is_first();
    share(figures.ranks(), is_owner, classes[k].stability);
    share(figures.ranks(), is_owner, classes[k].in_smaller_basis);
  }
  return {};
}

mechanics::Status small_motion_of(const BallFigures& figures, const mechanics::EquilibriumFigure& figure,
                                  int n_eigenvectors, std::size_t of_class, std::complex<double> rate,
                                  SmallMotionOfBall& motion) {
  return ShiftedProblems(figures, figure, figures.ranks()).solve([&](const StabilityProblem& problem) {
    return problem.solve(of_class, n_eigenvectors, rate, motion);
  });
}

}  // namespace pseudorigid::continuum
