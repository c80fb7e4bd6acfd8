#pragma once
/// One type, AnySystem<n>, for any system in constrained form. With this type the compiler compiles each method once
/// and not once per system. The corresponding type for second-order fields, which adaptive methods integrate, is in
/// any_field.h. The parameter n is 0 for a system without constraints. For all other systems n is dynamic_constraints,
/// so that systems with different numbers of constraints have the same type.
///
/// A call of a member goes through a virtual function and copies vectors of fixed size (dynamic_vectors.h). This costs
/// noticeable time if a force evaluation takes only some nanoseconds. The models of the ball therefore do not use
/// AnySystem.
///
/// Acceleration and projection of a constrained system are computed by ExplicitMultiplier with the concrete type of the
/// system (explicit_multiplier.h). Some systems have energies and symmetries (conservative_system.h). AnySystem is the
/// same type with and without energies, so `fits` in field_of.h tests `is_conservative()` at run time.

#include <memory>
#include <type_traits>
#include <utility>

#include "mechanics/core/any_workspace.h"
#include "mechanics/core/conservative_system.h"
#include "mechanics/core/dynamic_vectors.h"
#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/core/second_order_field.h"
#include "mechanics/core/stage_by_stage.h"

namespace pseudorigid::mechanics {

namespace detail {

/// Functions of a system that methods call, with vectors of dynamic size. If there are no constraints, `acceleration`,
/// `project` and the functions of the constraints succeed and leave their output arguments unchanged.
struct SystemInterface {
  using Vector = Eigen::VectorXd;
  virtual ~SystemInterface() = default;
  virtual Vector make_vector() const = 0;
  virtual Vector make_multiplier() const = 0;
  virtual AnyWorkspace make_workspace() const = 0;

  virtual Status force(double t, const Vector& q, const Vector& v, AnyWorkspace& w, Vector& f) const = 0;
  virtual void apply_inverse_mass(const Vector& f, Vector& a) const = 0;
  virtual Status constraint(const Vector& q, Vector& g) const = 0;
  virtual void constraint_rate(const Vector& q, const Vector& v, Vector& r) const = 0;
  virtual void constraint_curvature(const Vector& q, const Vector& v, Vector& r) const = 0;
  virtual void add_reaction(const Vector& q, const Vector& lambda, Vector& f) const = 0;
  virtual SolveReport solve_gram(const Vector& q1, const Vector& q0, const Vector& r, AnyWorkspace& w,
                                 Vector& lambda) const = 0;
  virtual Status acceleration(double t, const Vector& q, const Vector& v, AnyWorkspace& w, Vector& a) const = 0;
  virtual Status project(Vector& q, Vector& v, AnyWorkspace& w) const = 0;
  virtual Status solve_stages(GaussStages& stages, AnyWorkspace& w) const = 0;
  // The following functions are meant for conservative systems. For other systems they return 0 or do nothing.
  virtual double kinetic_energy(const Vector& v) const = 0;
  virtual double potential_energy(const Vector& q) const = 0;
  virtual void apply_mass(const Vector& v, Vector& f) const = 0;
  virtual void add_reaction_rate(const Vector& q, const Vector& v, const Vector& lambda, Vector& f) const = 0;
  virtual int n_symmetries() const = 0;
  virtual void symmetry(int i, const Vector& q, const Vector& v, Vector& dq, Vector& dv) const = 0;
};

/// Returns the workspace of the system S. The object w contains the workspace of the field ExplicitMultiplier<S>, which
/// has the workspace of S as a member.
template <ConstrainedSystem S>
typename S::Workspace& own_workspace(AnyWorkspace& w) {
  return w.as<typename ExplicitMultiplier<S>::Workspace>().system;
}

template <ConstrainedSystem S>
class HeldSystem final : public SystemInterface {
  using In = const Vector&;
  using Out = Vector&;
  using Field = ExplicitMultiplier<S>;
  static constexpr auto in = read_as<typename S::Vector>;
  static constexpr auto in_multiplier = read_as<typename S::Multiplier>;
  using Own = WriteAs<typename S::Vector>;
  using OwnMultiplier = WriteAs<typename S::Multiplier>;

 public:
  explicit HeldSystem(S system) : system_(std::move(system)), field_(system_) {}
  HeldSystem(const HeldSystem&) = delete;  // field_ refers to system_ of this object

  Vector make_vector() const override { return flat(system_.make_vector()); }
  Vector make_multiplier() const override { return flat(system_.make_multiplier()); }
  AnyWorkspace make_workspace() const override { return AnyWorkspace(field_.make_workspace()); }

  Status force(double t, In q, In v, AnyWorkspace& w, Out f) const override {
    return system_.force(t, in(q), in(v), own_workspace<S>(w), Own(f));
  }
  void apply_inverse_mass(In f, Out a) const override { system_.apply_inverse_mass(in(f), Own(a)); }
  Status constraint(In q, Out g) const override { return system_.constraint(in(q), OwnMultiplier(g)); }
  void constraint_rate(In q, In v, Out r) const override { system_.constraint_rate(in(q), in(v), OwnMultiplier(r)); }
  void constraint_curvature(In q, In v, Out r) const override {
    system_.constraint_curvature(in(q), in(v), OwnMultiplier(r));
  }
  void add_reaction(In q, In lambda, Out f) const override {
    system_.add_reaction(in(q), in_multiplier(lambda), Own(f));
  }
  SolveReport solve_gram(In q1, In q0, In r, AnyWorkspace& w, Out lambda) const override {
    return system_.solve_gram(in(q1), in(q0), in_multiplier(r), own_workspace<S>(w), OwnMultiplier(lambda));
  }
  Status acceleration(double t, In q, In v, AnyWorkspace& w, Out a) const override {
    if constexpr (!unconstrained<S>)
      return field_.acceleration(t, in(q), in(v), w.template as<typename Field::Workspace>(), Own(a));
    return {};
  }
  Status project(Out q, Out v, AnyWorkspace& w) const override {
    if constexpr (!unconstrained<S>) return field_.project(Own(q), Own(v), w.template as<typename Field::Workspace>());
    return {};
  }

  Status solve_stages(GaussStages& stages, AnyWorkspace& w) const override {
    return mechanics::solve_stages(field_, stages, w.template as<typename Field::Workspace>());
  }

  double kinetic_energy(In v) const override {
    if constexpr (ConservativeSystem<S>) return system_.kinetic_energy(in(v));
    return 0;
  }
  double potential_energy(In q) const override {
    if constexpr (ConservativeSystem<S>) return system_.potential_energy(in(q));
    return 0;
  }
  void apply_mass(In v, Out f) const override {
    if constexpr (ConservativeSystem<S>) system_.apply_mass(in(v), Own(f));
  }
  void add_reaction_rate(In q, In v, In lambda, Out f) const override {
    if constexpr (ConservativeSystem<S>) system_.add_reaction_rate(in(q), in(v), in_multiplier(lambda), Own(f));
  }
  int n_symmetries() const override {
    if constexpr (ConservativeSystem<S>) return system_.n_symmetries();
    return 0;
  }
  void symmetry(int i, In q, In v, Out dq, Out dv) const override {
    if constexpr (ConservativeSystem<S>) system_.symmetry(i, in(q), in(v), Own(dq), Own(dv));
  }

 private:
  S system_;
  Field field_;
};

}  // namespace detail

/// Any system in constrained form, without its energies and symmetries. The system has no constraints if n is 0, and
/// any number of constraints if n is dynamic_constraints. The class has the members of a ConstrainedSystem. For every
/// n, it also has the functions for the stages of Gauss steps (stage_by_stage.h). If n is not 0, it has `acceleration`
/// and `project` of the system's second-order field.
template <int n>
class AnyConstrainedSystem {
  static_assert(n == 0 || n == dynamic_constraints);

 public:
  using Vector = Eigen::VectorXd;
  using Multiplier = std::conditional_t<n == 0, NoMultiplier, Vector>;
  using Workspace = AnyWorkspace;
  static constexpr int n_constraints = n;

  Vector make_vector() const { return zero_; }
  Multiplier make_multiplier() const {
    if constexpr (n == 0)
      return {};
    else
      return no_reaction_;
  }
  Workspace make_workspace() const { return held_->make_workspace(); }

  Status force(double t, const Vector& q, const Vector& v, Workspace& w, Vector& f) const {
    return held_->force(t, q, v, w, f);
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { held_->apply_inverse_mass(f, a); }
  Status constraint(const Vector& q, Multiplier& g) const {
    if constexpr (n == 0)
      return {};
    else
      return held_->constraint(q, g);
  }
  void constraint_rate(const Vector& q, const Vector& v, Multiplier& r) const {
    if constexpr (n != 0) held_->constraint_rate(q, v, r);
  }
  void constraint_curvature(const Vector& q, const Vector& v, Multiplier& r) const {
    if constexpr (n != 0) held_->constraint_curvature(q, v, r);
  }
  void add_reaction(const Vector& q, const Multiplier& lambda, Vector& f) const {
    if constexpr (n != 0) held_->add_reaction(q, lambda, f);
  }
  SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace& w,
                         Multiplier& lambda) const {
    if constexpr (n == 0)
      return {};
    else
      return held_->solve_gram(q1, q0, r, w, lambda);
  }
  double constraint_tolerance() const { return constraint_tolerance_; }

  Status acceleration(double t, const Vector& q, const Vector& v, Workspace& w, Vector& a) const requires(n != 0) {
    return held_->acceleration(t, q, v, w, a);
  }
  Status project(Vector& q, Vector& v, Workspace& w) const requires(n != 0) { return held_->project(q, v, w); }

  Status solve_stages(GaussStages& stages, Workspace& w) const { return held_->solve_stages(stages, w); }

  bool velocity_dependent() const { return velocity_dependent_; }
  bool dissipative() const { return dissipative_; }
  bool time_dependent() const { return time_dependent_; }
  bool has_stages_in_lanes() const { return stages_in_lanes_; }
  double cost_of_iteration() const { return cost_of_iteration_; }

 protected:
  template <class S>
  explicit AnyConstrainedSystem(S system)
      : constraint_tolerance_(system.constraint_tolerance()),
        velocity_dependent_(mechanics::velocity_dependent(system)),
        dissipative_(mechanics::dissipative(system)),
        time_dependent_(mechanics::time_dependent(system)),
        stages_in_lanes_(mechanics::has_stages_in_lanes(ExplicitMultiplier<S>(system))),
        cost_of_iteration_(mechanics::cost_of_iteration(ExplicitMultiplier<S>(system))),
        held_(std::make_shared<detail::HeldSystem<S>>(std::move(system))),
        zero_(held_->make_vector()),
        no_reaction_(held_->make_multiplier()) {}

  const detail::SystemInterface& held() const { return *held_; }

 private:
  double constraint_tolerance_;
  bool velocity_dependent_, dissipative_, time_dependent_, stages_in_lanes_;
  double cost_of_iteration_;
  std::shared_ptr<const detail::SystemInterface> held_;
  Vector zero_, no_reaction_;
};

/// Any system in constrained form, with its energies and symmetries. If the system is not conservative, its energies
/// and its number of symmetries are 0. The functions apply_mass, add_reaction_rate and symmetry then leave their output
/// vectors unchanged.
template <int n>
class AnySystem : public AnyConstrainedSystem<n> {
 public:
  using Vector = typename AnyConstrainedSystem<n>::Vector;
  using Multiplier = typename AnyConstrainedSystem<n>::Multiplier;
  /// The base class. If the system is not conservative, a method must compile for this type (`fits` in field_of.h).
  using WithoutEnergies = AnyConstrainedSystem<n>;

  template <ConstrainedSystem S>
  requires(unconstrained<S> == (n == 0) && !std::is_base_of_v<WithoutEnergies, S>) explicit AnySystem(S system)
      : AnyConstrainedSystem<n>(std::move(system)),
        is_conservative_(ConservativeSystem<S>),
        n_symmetries_(this->held().n_symmetries()) {}

  bool is_conservative() const { return is_conservative_; }
  double kinetic_energy(const Vector& v) const { return this->held().kinetic_energy(v); }
  double potential_energy(const Vector& q) const { return this->held().potential_energy(q); }
  void apply_mass(const Vector& v, Vector& f) const { this->held().apply_mass(v, f); }
  void add_reaction_rate(const Vector& q, const Vector& v, const Multiplier& lambda, Vector& f) const {
    if constexpr (n != 0) this->held().add_reaction_rate(q, v, lambda, f);
  }
  int n_symmetries() const { return n_symmetries_; }
  void symmetry(int i, const Vector& q, const Vector& v, Vector& dq, Vector& dv) const {
    this->held().symmetry(i, q, v, dq, dv);
  }

 private:
  bool is_conservative_;
  int n_symmetries_;
};

}  // namespace pseudorigid::mechanics
