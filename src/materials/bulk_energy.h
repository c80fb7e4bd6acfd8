#pragma once
/// The bulk term of the laws as a function of θ = ln J, per unit reference volume:
///
///   B(θ) = (λ/4)(e^{2θ} − 1 − 2θ),   B′(θ) = (λ/2)(e^{2θ} − 1),   B″(0) = λ.
///
/// It is the term (λ/4)(III − 1 − ln III) of ciarlet_geymonat.h. A nearly incompressible body has λ ≫ μ. It can have
/// this term at the projection of ln J on the functions of the pressure, and the rest of its law at each point.

#include <cmath>
#include <optional>
#include <variant>

#include "materials/law_table.h"

namespace pseudorigid::materials {

struct BulkEnergy {
  double lambda;

  double energy(double theta) const { return energy(theta, std::expm1(2 * theta)); }
  double rate(double theta) const { return rate_of(std::expm1(2 * theta)); }
  /// B and B′ from `excess` = e^{2θ} − 1, for numbers or lanes.
  template <class T>
  T energy(T theta, T excess) const {
    return T(lambda / 4) * (excess - T(2.0) * theta);
  }
  template <class T>
  T rate_of(T excess) const {
    return T(lambda / 2) * excess;
  }
};

/// A law without its bulk term, and the modulus λ of this term.
struct SplitLaw {
  AnyLaw rest;
  double lambda;
};

/// Splits the bulk term off. Empty for laws whose resistance to changes of volume is not a function of J: both forms of
/// saint-venant-kirchhoff, and the law without energy.
inline std::optional<SplitLaw> without_bulk(const AnyLaw& law) {
  return std::visit(
      []<class Law>(Law rest) -> std::optional<SplitLaw> {
        if constexpr (std::is_same_v<Law, CiarletGeymonat> || std::is_same_v<Law, MooneyRivlin> ||
                      std::is_same_v<Law, Gent>) {
          const double lambda = rest.lambda;
          rest.lambda = 0;
          return SplitLaw{rest, lambda};
        }
        return std::nullopt;
      },
      law);
}

}  // namespace pseudorigid::materials
