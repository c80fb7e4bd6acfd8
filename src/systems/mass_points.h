#pragma once
/// System of n mass points with masses m_i, positions q_i and velocities v_i (Oliva, Geometric Mechanics, 5.5.1). The
/// points satisfy m_i q̈_i = f_i^ext + Σ_j f_ij, with internal forces f_ij = −f_ji along q_i − q_j. A spring has the
/// stiffness k and the rest length l, and a dashpot has the damping d. G is the gravitational constant, g the
/// acceleration of the uniform field, and γ the drag coefficient. The fixed centre c attracts with the strength μ. The
/// forces, or their potentials V, are
///
/// Internal:  gravity   V = −Σ_{i<j} G m_i m_j/|q_i − q_j|
///            springs   V = Σ ½k(|q_i − q_j| − l)²
///            dashpots  f_ij = −d ⟨v_i − v_j, n⟩ n,  n = (q_i − q_j)/|q_i − q_j|   (0 in rigid motions)
/// External:  uniform field V = −Σ m_i⟨g, q_i⟩,  confinement ½k Σ|q_i − c|²,  fixed centre −Σ μ m_i/|q_i − c|,
///            linear drag f_i = −γ v_i
///
/// The springs and the confinement have different stiffnesses k. Dashpots and drag dissipate the power
///
///   P = Σ d⟨v_i − v_j, n⟩² + γ Σ|v_i|².
///
/// The energy E therefore satisfies dE/dt = −P.

#include <Eigen/Dense>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include "mechanics/core/conservative_system.h"
#include "mechanics/core/unconstrained.h"
#include "systems/central_force.h"
#include "systems/invariant_axes.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

class MassPoints : public mechanics::Unconstrained {
 public:
  using Vector = Eigen::Matrix3Xd;  // one column for each point
  using In = const Eigen::Ref<const Vector>&;
  using Out = Eigen::Ref<Vector>;
  /// A spring between the points with the indices i and j, from 0.
  struct Spring {
    int i = 0, j = 1;
    SpringLaw law;
  };
  /// A dashpot between the points with the indices i and j, from 0.
  struct Dashpot {
    int i = 0, j = 1;
    double damping = 0;  // damping d
  };
  struct Parameters {
    Eigen::VectorXd masses;
    double gravitational_constant = 0;  // gravitational constant G
    std::vector<Spring> springs{};
    std::vector<Dashpot> dashpots{};
    Eigen::Vector3d field = Eigen::Vector3d::Zero();   // acceleration g of the uniform field
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  // centre c of confinement and attraction
    double confinement = 0;                            // stiffness k of the confinement
    double central_attraction = 0;                     // strength μ of the fixed centre
    double drag = 0;                                   // drag coefficient γ
  };

  explicit MassPoints(Parameters parameters) : p_(std::move(parameters)) {
    const bool homogeneous = p_.confinement == 0 && p_.central_attraction == 0;
    if (homogeneous) translations_ = translations_across(p_.field);
    axes_ = turns_that_fix({p_.field});
  }

  mechanics::Status force(double, In q, In v, Workspace&, Out f) const {
    f.setZero();
    return status_of_force(act<double>([&](Eigen::Index i) -> Eigen::Vector3d { return q.col(i); },
                                       [&](Eigen::Index i) -> Eigen::Vector3d { return v.col(i); },
                                       [&](Eigen::Index i, const Eigen::Vector3d& f_i) { f.col(i) += f_i; }));
  }
  /// Computes the forces for any scalar type T. The functions place(i) and velocity(i) return the position and the
  /// velocity of point i, and add(i, f) adds the force f on point i. Returns 1 if V′(r)/r (central_force.h) is finite
  /// for all central forces, otherwise NaN.
  template <class T, class Place, class Velocity, class Add>
  T act(const Place& place, const Velocity& velocity, const Add& add) const {
    using Space = Eigen::Matrix<T, 3, 1>;
    T reserve(1.0);
    const auto pull = [&](const auto& law, const Space& d) -> Space {
      Space f = Space::Constant(T(0.0));
      reserve = reserve * add_central_force(law, d, f);
      return f;
    };
    const auto add_pair = [&](const auto& law, Eigen::Index i, Eigen::Index j) {
      const Space f = pull(law, place(i) - place(j));
      add(i, f);
      add(j, -f);
    };
    for (Eigen::Index i = 0; i < n(); ++i) {
      const Space from_center = place(i) - p_.center.template cast<T>();
      add(i, (p_.masses(i) * p_.field).template cast<T>() - T(p_.confinement) * from_center - T(p_.drag) * velocity(i));
      if (p_.central_attraction != 0) add(i, pull(AttractionLaw{p_.central_attraction * p_.masses(i)}, from_center));
    }
    if (p_.gravitational_constant != 0)
      for (Eigen::Index i = 0; i < n(); ++i)
        for (Eigen::Index j = 0; j < i; ++j) add_pair(pair_gravity(i, j), i, j);
    for (const Spring& s : p_.springs) add_pair(s.law, s.i, s.j);
    for (const Dashpot& d : p_.dashpots) {
      const Space along = direction<T>(place(d.i) - place(d.j));
      const Space f = T(-d.damping) * along.dot(velocity(d.i) - velocity(d.j)) * along;
      add(d.i, f);
      add(d.j, -f);
    }
    return reserve;
  }
  /// Members that the templates of mechanics/core/stage_by_stage.h call for the stages of a Gauss step in SIMD lanes.
  bool solve_stages_in_lanes(mechanics::GaussStages& stages) const { return solve_stages_in_lanes_of(*this, stages); }
  double cost_of_iteration() const { return cost_of_iteration_in_lanes<MassPoints>; }
  void apply_inverse_mass(In f, Out a) const { a = f * p_.masses.cwiseInverse().asDiagonal(); }
  void apply_mass(In v, Out f) const { f = v * p_.masses.asDiagonal(); }

  Vector make_vector() const { return Vector::Zero(3, n()); }

  bool velocity_dependent() const { return p_.drag != 0 || !p_.dashpots.empty(); }
  bool dissipative() const { return velocity_dependent(); }

  double kinetic_energy(In v) const { return 0.5 * v.colwise().squaredNorm().dot(p_.masses); }
  double potential_energy(In q) const {
    double V = 0;
    const AttractionLaw to_center{p_.central_attraction};
    for (Eigen::Index i = 0; i < n(); ++i) {
      const Eigen::Vector3d d = q.col(i) - p_.center;
      V += -p_.masses(i) * p_.field.dot(q.col(i)) + 0.5 * p_.confinement * d.squaredNorm();
      if (p_.central_attraction != 0) V += p_.masses(i) * to_center.energy(d.norm());
    }
    if (p_.gravitational_constant != 0)
      for (Eigen::Index i = 0; i < n(); ++i)
        for (Eigen::Index j = 0; j < i; ++j) V += pair_gravity(i, j).energy((q.col(i) - q.col(j)).norm());
    for (const Spring& s : p_.springs) V += s.law.energy((q.col(s.i) - q.col(s.j)).norm());
    return V;
  }
  /// The power P that dashpots and drag dissipate.
  double dissipated_power(In q, In v) const {
    double P = p_.drag * v.squaredNorm();
    for (const Dashpot& d : p_.dashpots) {
      const double closing = direction<double>(q.col(d.i) - q.col(d.j)).dot(v.col(d.i) - v.col(d.j));
      P += d.damping * closing * closing;
    }
    return P;
  }
  Eigen::Vector3d momentum(In v) const { return v * p_.masses; }
  /// The angular momentum Σ m_i (q_i − c) × v_i about the point c.
  Eigen::Vector3d angular_momentum(In q, In v, const Eigen::Vector3d& c) const {
    Eigen::Vector3d L = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < n(); ++i) L += p_.masses(i) * column(q, i, c).cross(Eigen::Vector3d(v.col(i)));
    return L;
  }

  /// The number of symmetries of the conservative forces. The first symmetries are translations, and the others are
  /// rotations about axes through c. Internal forces have all these symmetries, and external forces can exclude some of
  /// them. Drag does not change the number, because drag has no potential. With drag, the momenta are not constant.
  int n_symmetries() const { return static_cast<int>(translations_.size() + axes_.size()); }
  void symmetry(int i, In q, In v, Out dq, Out dv) const {
    const auto k = static_cast<std::size_t>(i);
    if (k < translations_.size()) {
      dq.colwise() = translations_[k];
      dv.setZero();
      return;
    }
    const Eigen::Vector3d& axis = axes_[k - translations_.size()];
    for (Eigen::Index c = 0; c < n(); ++c) {
      dq.col(c) = axis.cross(column(q, c, p_.center));
      dv.col(c) = axis.cross(Eigen::Vector3d(v.col(c)));
    }
  }

  const Parameters& parameters() const { return p_; }

 private:
  Eigen::Index n() const { return p_.masses.size(); }
  static Eigen::Vector3d column(In q, Eigen::Index i, const Eigen::Vector3d& c) { return q.col(i) - c; }
  /// The unit vector d/|d| up to round-off, or 0 if d = 0. The force of a dashpot of length 0 is therefore 0.
  template <class T>
  static Eigen::Matrix<T, 3, 1> direction(const Eigen::Matrix<T, 3, 1>& d) {
    if constexpr (std::is_same_v<T, double>)
      return d.stableNormalized();
    else
      return d * (1.0 / sqrt(T(1e-300) + d.squaredNorm()));
  }
  /// The gravity between the points i and j, with the strength G m_i m_j.
  AttractionLaw pair_gravity(Eigen::Index i, Eigen::Index j) const {
    return {p_.gravitational_constant * p_.masses(i) * p_.masses(j)};
  }

  Parameters p_;
  Directions translations_, axes_;
};

}  // namespace pseudorigid::systems
