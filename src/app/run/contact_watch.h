#pragma once
/// Summary of the contacts of a body with rigid planes, updated after every step. The summary has the start of the
/// first contact, the end of the last contact, the largest force, and the coefficient of restitution
///
///   e = (n·ẋ_c − ż₀ at the end of the last contact) / (ż₀ − n·ẋ_c at the start of the first contact)
///
/// with the centre of mass x_c, and the normal n of a plane and its speed ż₀ along n. This plane is the plane with the
/// largest force, or the nearest plane if there is no contact. A contact starts or ends when the height of the body
/// above the nearest plane is zero. The height is interpolated linearly within a step, but the velocity ẋ_c is not. At
/// the start of the first contact, ẋ_c is the velocity after the last step before the contact. At the end of the last
/// contact, it is the velocity after the step in which the contact ends. A contact that exists at time 0 starts there,
/// with the velocity at time 0. If the denominator is 0, e is 0. Each quantity of the summary is 0 until its event
/// occurs. All quantities are in internal units.

#include <algorithm>
#include <array>
#include <span>

#include "loads/contact.h"
#include "observables/body_observables.h"

namespace pseudorigid::app {

class ContactWatch {
 public:
  /// Updates the summary at the end of a step, or at the start of the run. `now` is the contact at the time `t`, and
  /// `velocity` is the velocity of the centre of mass. Does nothing if `t` is not after the last recorded time, because
  /// the step is then a repetition of an earlier step.
  void look(double t, const loads::Contact& now, const Eigen::Vector3d& velocity) {
    if (is_begun_ && t <= t_) return;
    const double v = now.normal.dot(velocity) - now.speed;
    largest_force_ = std::max(largest_force_, now.force);
    const bool was_touching = is_begun_ && height_ < 0, touches = now.height < 0;
    const double crossing = is_begun_ ? t_ + (t - t_) * height_ / (height_ - now.height) : t;
    if (touches && !was_touching && !has_touched_) {
      has_touched_ = true;
      first_ = crossing;
      speed_before_ = is_begun_ ? -v_ : -v;
    }
    if (!touches && was_touching) {
      last_ = crossing;
      restitution_ = speed_before_ != 0 ? v / speed_before_ : 0;
    }
    is_begun_ = true;
    t_ = t;
    height_ = now.height;
    v_ = v;
  }

  /// Writes the summary into the observables of a sample. `o.force` must already have the force at this sample. The
  /// largest force of the summary takes this force into account.
  void write(mechanics::ContactObservables& o) const {
    o.first = first_;
    o.last = last_;
    o.largest_force = std::max(largest_force_, o.force);
    o.restitution = restitution_;
  }

  /// The data members as an array, for checkpoints.
  static constexpr std::size_t n_numbers = 10;
  std::array<double, n_numbers> numbers() const {
    return {is_begun_ ? 1.0 : 0.0, t_,    height_,        v_,          has_touched_ ? 1.0 : 0.0, first_,
            speed_before_,         last_, largest_force_, restitution_};
  }
  /// Restores the data members from this array.
  void take_numbers(std::span<const double, n_numbers> numbers) {
    is_begun_ = numbers[0] != 0;
    t_ = numbers[1];
    height_ = numbers[2];
    v_ = numbers[3];
    has_touched_ = numbers[4] != 0;
    first_ = numbers[5];
    speed_before_ = numbers[6];
    last_ = numbers[7];
    largest_force_ = numbers[8];
    restitution_ = numbers[9];
  }

 private:
  /// `is_begun_` is true after the first call of `look`, and `has_touched_` after the start of the first contact.
  bool is_begun_ = false, has_touched_ = false;
  double t_ = 0, height_ = 0, v_ = 0;  ///< time, height and n·ẋ_c − ż₀ at the end of the last step
  double first_ = 0, speed_before_ = 0, last_ = 0, largest_force_ = 0,
         restitution_ = 0;  ///< the summary, and the approach speed ż₀ − n·ẋ_c at the time `first_`
};

}  // namespace pseudorigid::app
