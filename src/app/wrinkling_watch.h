#pragma once
/// Reports the first sample at which the surface of an incompressible ball has reached Biot's limit
/// (continuum/surface_stretch.h): from there on the exact motion has waves of every length that grow on the surface,
/// and the finite elements show those that the mesh can carry. Looked at samples only. A resumed run looks from its
/// resume on; what was reported before is in the log.

#include <algorithm>
#include <optional>

#include "app/run_context.h"
#include "continuum/surface_stretch.h"

namespace pseudorigid::app {

class WrinklingWatch {
 public:
  explicit WrinklingWatch(const RunContext& context)
      : context_(context), watches_(context.scene.body.incompressible && !context.rows && has_this_limit(context)) {}

  void look(double time, const continuum::BallSpace& space, const continuum::Vector& x) {
    if (!watches_) return;
    const continuum::LeastPlace surface = continuum::least_surface_stretch(space, x);
    least_ = std::min(least_, surface.value);
    if (first_ || surface.value > continuum::biot_ratio) return;
    first_ = time;
    context_.log->warn(
        "continuum: the surface reaches Biot's limit at t = {:.6g}: its stretch along the surface is {:.3g} of that "
        "along the normal at X/r = ({:.3f}, {:.3f}, {:.3f}); below 0.2956 a smooth surface is unstable to wrinkles "
        "whose length the mesh decides, so compare with finer elements what is seen near it",
        time, surface.value, surface.where[0], surface.where[1], surface.where[2]);
  }

  void report(io::Manifest::Model& statistics) const {
    if (watches_ && least_ < 1) statistics.counters["least_surface_stretch_ratio"] = least_;
    if (first_) statistics.counters["surface_limit_time"] = *first_;
  }

 private:
  /// On incompressible bodies ciarlet-geymonat is neo-Hookean, and mooney-rivlin has the same limit; others have their
  /// own.
  static bool has_this_limit(const RunContext& context) {
    const scene::Law law = context.scene.material.law;
    return law != scene::Law::saint_venant_kirchhoff && law != scene::Law::saint_venant_kirchhoff_as_printed;
  }

  const RunContext& context_;
  bool watches_;
  double least_ = 1;
  std::optional<double> first_;
};

}  // namespace pseudorigid::app
