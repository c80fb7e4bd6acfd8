#pragma once
/// A family of figures of equilibrium (body_figures.h) of a polynomial body with the stability of its members
/// (figure_spectrum.h). mechanics/equilibria/figure_family.h finds the members.

#include <functional>
#include <optional>
#include <vector>

#include "mechanics/equilibria/figure_family.h"
#include "polynomial/figure_spectrum.h"

namespace pseudorigid::polynomial {

using mechanics::FamilyOfFigures, mechanics::FigureFamily, mechanics::FigureMember, mechanics::SpecialFigure;

class BodyFigureFinder {
 public:
  /// The members have no classes of small motions if `small_motions` is false.
  BodyFigureFinder(const BodySetup& body, bool incompressible, FamilyOfFigures family, Drive drive = Drive::rotation,
                   bool small_motions = true)
      : setup_{body, incompressible, drive, family.figure},
        small_motions_(small_motions),
        figures_(setup_),
        spectrum_(setup_),
        finder_(figures_, analysis(), std::move(family)) {}
  BodyFigureFinder(const BodyFigureFinder&) = delete;  // because some members refer to other members
  BodyFigureFinder& operator=(const BodyFigureFinder&) = delete;

  /// `family` returns the members with these parameters and the special points between successive members. `member`
  /// sets its argument `member` to the member with this parameter. mechanics::FigureFinder describes the failures.
  FigureFamily family(const std::vector<double>& parameters, std::function<bool()> give_up = {},
                      const mechanics::FamilyWatch& watch = {}, FigureFamily known = {}) {
    return finder_.family(parameters, std::move(give_up), watch, std::move(known));
  }
  mechanics::Status member(double parameter, FigureMember& member) { return finder_.member(parameter, member); }
  /// The family with the figure at rest under the loads (mechanics::figure_at_rest).
  FigureFamily at_rest() const { return mechanics::figure_at_rest(figures_, analysis(), 1); }

  const FigureSetup& setup() const { return setup_; }
  const FigureSpectrum& spectrum() const { return spectrum_; }

 private:
  mechanics::StabilityOfFigure analysis() const {
    return
        [this](const EquilibriumFigure& figure, std::optional<std::size_t> only, std::vector<ClassStability>& classes) {
          return small_motions_ ? spectrum_.analyse(figure, only, classes) : mechanics::Status();
        };
  }

  FigureSetup setup_;
  bool small_motions_;
  BodyFigures figures_;
  FigureSpectrum spectrum_;
  mechanics::FigureFinder finder_;
};

}  // namespace pseudorigid::polynomial
