#pragma once
/// The checkpoint of a run that computes families of figures. It contains the known part of each family, so that a
/// resumed run continues after the last figure. A run of a sweep has no checkpoint, because its family is one figure.

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>

#include "app/run/run_context.h"
#include "io/checkpoint.h"
#include "mechanics/equilibria/figure_family.h"

namespace pseudorigid::app {

class FamilyCheckpoint {
 public:
  /// `name` is the name of the checkpoint. If the context resumes an earlier run, the constructor loads the checkpoint
  /// of this name, if there is one, and throws the errors of io::Checkpoint::load. The object refers to `context`.
  /// Collective.
  FamilyCheckpoint(const RunContext& context, std::string name);

  /// The known part of family number k of the run, from 0 on. Throws UserError if the checkpoint does not fit.
  mechanics::FigureFamily known(std::size_t k) const;
  /// Writes the checkpoint with the known part of family number k. Collective.
  void save(std::size_t k, const mechanics::FigureFamily& known);
  /// The same as `save` if the last checkpoint is old. Collective.
  void save_if_old(std::size_t k, const mechanics::FigureFamily& known);

 private:
  std::filesystem::path path() const { return context_.directory.checkpoint(name_); }

  using Clock = std::chrono::steady_clock;

  const RunContext& context_;
  std::string name_;
  bool keeps_states_;  ///< false for a run of a sweep
  io::Checkpoint content_;
  Clock::time_point last_save_ = Clock::now();
  Clock::duration cost_{};  ///< duration of the last save
};

}  // namespace pseudorigid::app
