#pragma once
/// The angular frequency x of the slowest small pulsation of a homogeneous elastic ball about rest, in units of c/r.
/// Here r is the radius, and c is the speed of shear waves. The pulsation is the spheroidal mode of degree 2:
///
///   exact                           x of analysis/sphere_frequencies.h
///   pseudo-rigid   x² = 10 + 4γ/5,  γ = ρgr/μ, g = (4/3)πGρr
///
/// ρ is the density, μ is the shear modulus, and G is Newton's constant.

#include <optional>

#include "scene/scene.h"

namespace pseudorigid::app {

struct SmallPulsation {
  double exact, pseudo_rigid;
  double ratio() const { return pseudo_rigid / exact; }
};

/// Both frequencies for an elastic sphere without loads, or for an incompressible elastic sphere with its own gravity
/// as the only load. A mesh file or Body/Inertia excludes a sphere. Empty for any other body, and for a compressible
/// body whose law has a pressure in the undeformed state. Also empty for γ > 18, because the exact sphere then pulsates
/// with two frequencies of degree 2 (docs/adequacy.md).
std::optional<SmallPulsation> small_pulsation(const scene::Scene& scene);

}  // namespace pseudorigid::app
