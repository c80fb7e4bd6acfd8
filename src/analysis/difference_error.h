#pragma once
/// Estimates of the errors of the differences in a comparison (comparison.h), as parts of an error bar. Model r is
/// compared with the reference c. Let x be a quantity, and R the divisor of its difference. The number e_m bounds the
/// error of every entry of Q of model m, in time or due to the quadrature rule. In space, model r has no error, and s
/// is the largest relative error of the reference, |δQ|/|Q|. The rules for the parts are as follows.
///
///   functions of Q, with |δx| ≤ L |δQ|
///     time, quadrature   3 L (e_r + e_c) / R
///     space              L s max_t |Q_c| / R
///   other quantities, with n times the relative error ε_m of the strain
///     time, quadrature   n (ε_r max_t |x_r| + ε_c max_t |x_c|) / R,  ε_m = 6 e_m max_t |Q_m| / max_t |C_m − Id|
///     space              f max_t |x_c − x'_c| / R
///
/// |·| is the Frobenius norm, and the factor 3 bounds it by the largest entry of a matrix. In the undeformed body, x is
/// 0. Stretches are counted from 1. The quantity on another discretisation is x', with the factor f of OtherResolution.
/// In small oscillations, stresses and velocities have the relative error of strains (n = 1), and energies twice this
/// error (n = 2). This is an assumption for quantities that are not affine. In time, the error of a constant of the
/// motion is its drift. Comparison adds the relative error of R times the difference.

#include <optional>
#include <string>
#include <vector>

#include "analysis/error_bar.h"
#include "analysis/samples.h"
#include "io/csv.h"

namespace pseudorigid::analysis {

/// Bound ε_m of the relative error of the strain C − Id, if every entry of Q has the error e at most. The table must
/// have the columns of Q. The result is 0 for e = 0, and otherwise infinite without a strain.
double relative_error_of_strain(const io::Table& table, double e);

/// A quantity that is not a function of Q. The columns of a vector are its components. Empty `of_model` are those of
/// the reference.
struct ComparedQuantity {
  Columns columns;                                             ///< columns of x_c
  Columns of_model{};                                          ///< columns of x_r
  double undeformed = 0;                                       ///< x₀ of every component
  double n_strains = 1;                                        ///< n
  bool constant = false;                                       ///< true if x is a constant of the motion
  bool in_both_models = true;                                  ///< false if the difference is x_c itself
  double OtherResolution::*factor = &OtherResolution::factor;  ///< f
};

class DifferenceErrors {
 public:
  /// The tables and errors of both models, which must outlive the object.
  DifferenceErrors(const io::Table& r, const io::Table& c, const RunErrors& of_model, const RunErrors& of_reference)
      : r_(r), c_(c), of_model_(of_model), of_reference_(of_reference) {}

  /// The parts of a function of Q, with `lipschitz` = L/R. Both tables must have the columns of Q.
  ErrorBar of_function_of_Q(double lipschitz) const;
  /// The parts of a function of Q of model r alone, which has no error in space.
  ErrorBar of_function_of_model(double lipschitz) const;
  /// The parts of another quantity. A part is empty if it does not follow from the tables and the known errors.
  ErrorBar of_quantity(const ComparedQuantity& quantity, double divisor) const;

 private:
  using Part = std::optional<double> RunErrors::*;
  std::optional<double> relative_to_strain(const ComparedQuantity& quantity, Part part) const;
  std::optional<double> drift_of_both(const ComparedQuantity& quantity) const;
  std::optional<double> in_space(const ComparedQuantity& quantity) const;

  const io::Table& r_;
  const io::Table& c_;
  const RunErrors& of_model_;
  const RunErrors& of_reference_;
};

}  // namespace pseudorigid::analysis
