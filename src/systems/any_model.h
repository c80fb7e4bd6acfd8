#pragma once
/// The model of any system (system_scene.h) as one type. Methods and outputs are therefore compiled once for all
/// systems. AnyModel contains the initial state, and the equations of motion as an unconstrained system, a constrained
/// system or a second-order field. Its functions compute the columns of the output and the rate of change of states,
/// and return the potential landscape of the system. All numbers are in the scales of the scene.

#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "mechanics/core/any_field.h"
#include "mechanics/core/any_system.h"
#include "mechanics/core/reversed_field.h"
#include "mechanics/core/vector_space.h"
#include "mechanics/equilibria/any_landscape.h"
#include "scene/catalogue.h"

namespace pseudorigid::systems {

class AnyModel {
 public:
  using Form =
      std::variant<mechanics::AnySystem<0>, mechanics::AnySystem<mechanics::dynamic_constraints>, mechanics::AnyField>;
  using State = mechanics::VectorState<Eigen::VectorXd>;
  using Workspace = mechanics::AnyWorkspace;

  template <class Model>
  requires(!std::is_same_v<Model, AnyModel>) explicit AnyModel(Model model)
      : form_(form_of(model.system)),
        start_{model.initial.t, mechanics::detail::flat(model.initial.q), mechanics::detail::flat(model.initial.v)},
        held_(std::make_unique<Held<Model>>(std::move(model))) {}

  const Form& form() const { return form_; }
  const State& start() const { return start_; }
  /// Appends the values of the columns for `state`, without the time, to `row`. Fails if the model cannot compute them.
  mechanics::Status row(const State& state, Workspace& workspace, std::vector<double>& row) {
    if (reversed_)
      return held_->row({-state.t, state.q, -state.v},
                        workspace.as<mechanics::ReversedField<mechanics::AnyField>::Workspace>().field, row);
    return held_->row(state, workspace, row);
  }
  /// The rate of change of the state per unit of time, which limits the step of methods. The result is that of the
  /// member `rate` of the model. Without this member, it is |v|/(1 + |q|) with the maximum norm.
  double rate(const State& state) const { return held_->rate(state); }
  /// The potential landscape of the system. The landscape may refer to this model. The model must then exist as long as
  /// the landscape. Throws std::logic_error if the system does not have a landscape.
  mechanics::AnyLandscape landscape() const { return held_->landscape(); }
  /// Names and units of the coordinates of the landscape. The list is empty if the system does not have a landscape.
  std::vector<scene::Column> coordinates() const { return held_->coordinates(); }
  /// Returns the model of the same system that starts at rest at the point q of the landscape, at the time 0. Its
  /// `start().q` is this point in the coordinates of the motion.
  AnyModel resting_at(const Eigen::VectorXd& q) const { return held_->resting_at(q); }

  /// Reverses the direction of time, for a run backwards in time. Call this function at most once. The equations of
  /// motion must be a second-order field, and the motion must start at the time 0. A state (t, q, q̇) of the motion is
  /// then represented by (−t, q, −q̇), and `row` appends the same columns as before.
  void reverse() {
    form_ = mechanics::AnyField(mechanics::ReversedField(std::get<mechanics::AnyField>(form_)));
    start_.v *= -1;
    reversed_ = !reversed_;
  }
  bool reversed() const { return reversed_; }

 private:
  /// The functions of a model as virtual functions, so that the type of the model is not a part of AnyModel.
  struct Interface {
    virtual ~Interface() = default;
    virtual mechanics::Status row(const State& state, Workspace& workspace, std::vector<double>& row) = 0;
    virtual double rate(const State& state) const = 0;
    virtual mechanics::AnyLandscape landscape() const = 0;
    virtual std::vector<scene::Column> coordinates() const = 0;
    virtual AnyModel resting_at(const Eigen::VectorXd& q) const = 0;
  };

  template <class Model>
  struct Held final : Interface {
    using System = typename Model::System;
    using Own = mechanics::State<System>;

    explicit Held(Model m) : model(std::move(m)) {}
    mechanics::Status row(const State& state, Workspace& workspace, std::vector<double>& row) override {
      return model.row(own(state), mechanics::detail::own_workspace<System>(workspace), row);
    }
    double rate(const State& state) const override {
      if constexpr (requires(const Own& s) { model.rate(s); }) return model.rate(own(state));
      return mechanics::max_norm(state.v) / (1 + mechanics::max_norm(state.q));
    }
    mechanics::AnyLandscape landscape() const override {
      if constexpr (requires { model.landscape(); }) return mechanics::AnyLandscape(model.landscape());
      throw std::logic_error("a landscape of a system without equilibria");
    }
    std::vector<scene::Column> coordinates() const override {
      if constexpr (requires { model.coordinates(); }) return model.coordinates();
      return {};
    }
    AnyModel resting_at(const Eigen::VectorXd& q) const override {
      if constexpr (requires { model.resting_at(q); }) {
        return AnyModel(model.resting_at(q));
      } else {
        Model at_rest = model;
        at_rest.initial = own({0, q, Eigen::VectorXd::Zero(q.size())});
        return AnyModel(std::move(at_rest));
      }
    }

    /// Converts the state s to the type of vectors of the system.
    static Own own(const State& s) {
      using Vector = typename System::Vector;
      return {s.t, mechanics::detail::read_as<Vector>(s.q), mechanics::detail::read_as<Vector>(s.v)};
    }
    Model model;
  };

  template <class System>
  static Form form_of(const System& system) {
    using namespace mechanics;
    static_assert(
        ConstrainedSystem<System> || SecondOrderField<System>,
        "no method can run this system: a member of ConstrainedSystem (mechanics/core/constrained_system.h) or of "
        "SecondOrderField (mechanics/core/second_order_field.h) is missing or misspelt");
    if constexpr (!ConstrainedSystem<System>)
      return AnyField(system);
    else if constexpr (unconstrained<System>)
      return AnySystem<0>(system);
    else
      return AnySystem<dynamic_constraints>(system);
  }

  Form form_;
  State start_;
  bool reversed_ = false;
  std::unique_ptr<Interface> held_;
};

}  // namespace pseudorigid::systems
