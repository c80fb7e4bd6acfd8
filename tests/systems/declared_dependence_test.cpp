/// A system that says nothing of the velocity or the time has a force without them: what it forgets is found.

#include "mechanics/core/declared_dependence.h"

#include <gtest/gtest.h>

#include "systems/spherical_pendulum_scene.h"

namespace pseudorigid::systems {
namespace {

using mechanics::State;

/// The pendulum with a drag that a misspelt member does not declare.
struct Silent : SphericalPendulum {
  using SphericalPendulum::SphericalPendulum;
  bool velocity_dependent() const { return false; }
};

/// The pendulum on a support that shakes, likewise.
struct Shaken : SphericalPendulum {
  using SphericalPendulum::SphericalPendulum;
  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& w, Vector& f) const {
    mechanics::Status status = SphericalPendulum::force(t, q, v, w, f);
    f[0] += std::sin(t);
    return status;
  }
};
struct DeclaredShaken : Shaken {
  using Shaken::Shaken;
  bool time_dependent() const { return true; }
};

template <class System>
std::string found(double c) {
  const System system({.c = c});
  return mechanics::check_declared_dependence(system, State<System>{0, {0, 0, -1}, {0.1, 0, 0}}).reason();
}

TEST(DeclaredDependence, OfTheVelocity) {
  EXPECT_EQ(found<SphericalPendulum>(0), "");
  EXPECT_EQ(found<SphericalPendulum>(0.1), "");
  EXPECT_EQ(found<Silent>(0), "");
  EXPECT_EQ(found<Silent>(0.1),
            "a force depends on the velocity, and its system does not declare velocity_dependent()");
}

TEST(DeclaredDependence, OfTheTime) {
  EXPECT_EQ(found<DeclaredShaken>(0), "");
  EXPECT_EQ(found<Shaken>(0), "a force depends on time, and its system does not declare time_dependent()");
}

}  // namespace
}  // namespace pseudorigid::systems
