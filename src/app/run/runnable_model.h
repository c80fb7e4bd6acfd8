#pragma once
/// Interface of a model to ModelRun: the start of its motion, its largest frequency, and its output. A model may
/// offer more, which ModelRun asks for if it is there:
///
///   void take_up(rows)                        what the rows of an interrupted run know of the past
///   std::vector<double> remarks() const, take_remarks(numbers)                what it has warned of, for checkpoints
///   void choose_quadrature(state), estimate_quadrature(state, stable step of RATTLE, or 0)
///                                             its rule, and what that errs, before and after the search for the step
///   Eigen::Vector2d energies(state) const     kinetic and potential, for methods that need not keep their sum
///   Status judge(state) const                 states with which a run ends, asked after every step
///   double constraint_scale() const           with constraints
///   Status write_frame(path, time, state, system workspace)                   pictures, picture.h
///   shape_file(), shape_columns(), shape(time, state)                         shapes for the report
///   std::string place_of_least_jacobian(state) const                          for a run that cannot go on
///   const Order& rank_order() const, using MemoryLayout                       distributed vectors, rank_order.h
///
/// All ranks run it together; one of them writes.

#include <concepts>
#include <string>
#include <vector>

#include "io/manifest.h"
#include "mechanics/core/second_order_field.h"

namespace pseudorigid::app {

// clang-format off
template <class M>
concept RunnableModel = requires(M& model, const M& known, const mechanics::State<typename M::System>& state,
                                 decltype(known.system().make_workspace())& workspace, double t,
                                 std::vector<double>& row, io::Manifest::Model& statistics) {
  { known.name } -> std::convertible_to<const char*>;                 // of its files
  { M::steps_between_looks } -> std::convertible_to<int>;             // at the clock and the interrupt flag
  { M::pilot_reserve } -> std::convertible_to<double>;                // the part of the tolerance that a pilot gets
  { known.system() } -> std::same_as<const typename M::System&>;
  { known.initial_state() } -> std::same_as<mechanics::State<typename M::System>>;
  known.configuration(state);                                         // configuration to which Time/Tolerance applies, of Eigen
  { known.rate(state) } -> std::convertible_to<double>;               // of the motion, in addition to its largest frequency
  { known.pilot_window(t) } -> std::convertible_to<double>;           // how long a pilot looks at a motion until t
  { known.columns() } -> std::convertible_to<std::vector<std::string>>;
  { model.row(t, state, workspace, row) } -> std::same_as<mechanics::Status>;
  known.report(workspace, statistics);                                // the workspace of the method, in fact
};
// clang-format on

}  // namespace pseudorigid::app
