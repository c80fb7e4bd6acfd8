#pragma once
/// A family of steady rotations (steady_rotation.h) of a polynomial body with the stability of its members
/// (rotation_spectrum.h). mechanics/equilibria/figure_family.h finds the members.

#include <functional>
#include <vector>

#include "mechanics/equilibria/figure_family.h"
#include "polynomial/rotation_spectrum.h"

namespace pseudorigid::polynomial {

using mechanics::FamilyOfFigures, mechanics::FigureFamily, mechanics::FigureMember, mechanics::SpecialFigure;

class RotationFinder {
 public:
  RotationFinder(const BodySetup& setup, bool incompressible, FamilyOfFigures family)
      : rotations_(setup, incompressible, family.figure),
        spectrum_(setup, incompressible, family.figure),
        finder_(
            rotations_,
            [this](const EquilibriumFigure& figure, std::vector<ClassStability>& classes) {
              return spectrum_.analyse(figure, classes);
            },
            std::move(family)) {}
  RotationFinder(const RotationFinder&) = delete;  // because some members refer to other members
  RotationFinder& operator=(const RotationFinder&) = delete;

  /// `family` returns the members with these parameters and the special points between successive members. `member`
  /// sets its argument `member` to the member with this parameter. mechanics::FigureFinder describes the failures.
  FigureFamily family(const std::vector<double>& parameters, std::function<bool()> give_up = {}) {
    return finder_.family(parameters, std::move(give_up));
  }
  mechanics::Status member(double parameter, FigureMember& member) { return finder_.member(parameter, member); }

  const RotationSpectrum& spectrum() const { return spectrum_; }

 private:
  SteadyRotations rotations_;
  RotationSpectrum spectrum_;
  mechanics::FigureFinder finder_;
};

}  // namespace pseudorigid::polynomial
