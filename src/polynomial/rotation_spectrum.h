#pragma once
/// Small motions about a figure that turns steadily about axis 3 (steady_rotation.h), in the frame that turns with it:
///
///   ü + 2Ω ê₃×u̇ + Ku = 0 on ker G,   K = D²V − Ω²P − Σ_b λ_b D²g_b      (mechanics/equilibria/linear_stability.h)
///
/// of the whole body, in which every motion is allowed. They fall into classes that do not mix: even or odd under the
/// reflection of axis 3, and under the half turn about it; on a spheroid, by the azimuthal number m, u ~ e^{imφ} as
/// seen in cylindrical components. Each class is a dense eigenvalue problem, and all rates of the body are found.
///
/// Taken out with their momenta, as they say nothing of the figure: uniform motions; the turns of space (J); the turns
/// of the reference ball (Z), which the exact integrals do not feel and those over points feel by their error; and of a
/// fluid all motions A w(X), div w = 0 in the ball and w·X = 0 on its surface, which only exchange matter within the
/// figure. The momenta of these are the circulations (Kelvin), and the remainder are motions at fixed circulations.
///
/// K maps motions of each of the eight parities into themselves. So one call of the force rate gives a column for each.

#include <memory>
#include <vector>

#include "mechanics/equilibria/linear_stability.h"
#include "polynomial/steady_rotation.h"
#include "polynomial/turns.h"

namespace pseudorigid::polynomial {

/// A class of small motions.
struct MotionClass {
  bool odd_in_z;  ///< under x₃ ↦ −x₃
  int m;          ///< azimuthal number on a spheroid; on an ellipsoid 0 if even under the half turn, otherwise 1
};

struct ClassStability {
  MotionClass motions;
  mechanics::LinearStability stability;
};

class RotationSpectrum {
 public:
  RotationSpectrum(const BodySetup& setup, bool incompressible, Figure figure);

  const PolynomialSpace& space() const { return body_->space(); }
  /// Coefficients of the whole body from those of the octant.
  Eigen::VectorXd whole(const Eigen::VectorXd& x) const;

  /// The classes in the same order for every figure.
  mechanics::Status analyse(const SteadyRotation& rotation, std::vector<ClassStability>& classes) const;

 private:
  /// A class with a basis of it, a column each.
  struct Part {
    MotionClass motions;
    Eigen::MatrixXd fields;
    Eigen::MatrixXd exchanges;  ///< w of a fluid
  };
  void add_parts(bool odd_in_z, bool odd_under_half_turn, Figure figure);
  Eigen::MatrixXd exchanges(const Eigen::MatrixXd& fields) const;
  Eigen::VectorXd whole_multiplier(const Eigen::VectorXd& lambda) const;
  Eigen::MatrixXd stiffness(const SteadyRotation& rotation) const;
  mechanics::SymmetryDirections turns(const Eigen::VectorXd& x, double spin) const;
  mechanics::SymmetryDirections symmetries(const Part& part, const Eigen::MatrixXd& T, const Eigen::Matrix3d& A,
                                           const mechanics::SymmetryDirections& turns) const;

  bool incompressible_, is_fluid_;
  std::shared_ptr<const CompressibleBody> body_;
  std::shared_ptr<const PolynomialSpace> octant_;
  std::shared_ptr<const Turns> turns_;
  std::vector<Part> parts_;
};

}  // namespace pseudorigid::polynomial
