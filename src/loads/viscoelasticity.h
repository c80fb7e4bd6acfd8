#pragma once
/// Maxwell branches, which make the body viscoelastic (materials/maxwell_branch.h). The law of the material is the
/// spring parallel to all branches, and the viscosity η (viscosity.h) is the dashpot parallel to them. Common
/// rheologies are
///
///   Kelvin–Voigt            the law and η, no branch
///   Maxwell                 the law `none`, one branch
///   standard linear solid   the law and one branch
///   Burgers                 the law `none`, two branches
///   generalised Maxwell     the law and n branches

#include <algorithm>
#include <optional>

#include "loads/load.h"

namespace pseudorigid::loads {

struct Viscoelasticity {
  std::vector<double> moduli, times;  ///< shear modulus μ_b and relaxation time τ_b of each branch
  bool relaxed = false;               ///< true if the branches have no stress in the initial state

  /// Largest number of branches.
  static constexpr std::size_t most_branches = materials::most_branches;

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(self.moduli, scene::Numbers{.number = scene::positive, .may_be_empty = true},
          scene::About{"Material/Branch moduli", "pressure",
                       "Shear moduli of at most four Maxwell branches, which are parallel to the law of the material. "
                       "A branch is a spring and a dashpot in series. Its fast response is elastic, and its stress "
                       "relaxes. The law none with one branch is a Maxwell body, and with two branches a Burgers "
                       "body. Another law with one branch is a standard linear solid."});
    visit(self.times, scene::Numbers{.number = scene::positive, .may_be_empty = true},
          scene::About{"Material/Branch times", "time",
                       "Relaxation time of each branch, which is its viscosity over its modulus."});
    visit(self.relaxed, scene::Boolean{},
          scene::About{"Material/Branches relaxed", "",
                       "true: the branches have no stress in the initial state. false: the initial deformation is "
                       "sudden, so that the branches have the stress of this deformation."});
  }

  static constexpr std::string_view no_equilibria =
      "the rates of small motions about an equilibrium are not known with viscoelastic branches";
  static constexpr bool has_static_equilibria = false;
  static constexpr std::string_view skipped = "viscoelastic branches: Material/Branch moduli is empty";
  std::string needed(const BodyFacts&) const {
    return "viscoelastic branches with internal strains at every point of integration: " +
           std::to_string(moduli.size());
  }
  bool is_present() const { return !moduli.empty(); }

  /// Returns a Forcing with the branches. A modulus without a time, or a time without a modulus, is omitted here;
  /// scene/branches.h rejects such scenes.
  Forcing forcing() const {
    Forcing sum;
    for (std::size_t i = 0; i < std::min(moduli.size(), times.size()); ++i)
      sum.branches.list.push_back({.modulus = moduli[i], .relaxation_time = times[i]});
    sum.branches.relaxed = relaxed && !sum.branches.empty();
    return sum;
  }

  /// Returns an empty optional, because the branches admit the reflection of every axis.
  std::optional<std::string> breaks_plane(int) const { return std::nullopt; }
};

}  // namespace pseudorigid::loads
