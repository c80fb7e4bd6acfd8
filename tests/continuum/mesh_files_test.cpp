/// Bodies of hexahedra with flat edges: volume and inertia converge to those of the ellipsoid, a mesh may have its
/// cells turned in any way, the affine restriction is the pseudo-rigid body, and a rough ball keeps energy and momenta.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "continuum/balls.h"
#include "reduced/observe.h"

namespace pseudorigid::testing {
namespace {

using continuum::BallMesh;
using continuum::CoarseMesh;

/// The cells of the builtin mesh after refinement, their vertices moved by a map.
template <class Map>
CoarseMesh hexahedra(int n_refinements, const Map& map) {
  const BallMesh ball(whole, n_refinements);
  CoarseMesh mesh;
  const auto& triangulation = ball.triangulation();
  mesh.vertices.resize(triangulation.n_vertices());
  for (const auto& cell : triangulation.active_cell_iterators()) {
    auto& vertices = mesh.cells.emplace_back();
    for (unsigned int v = 0; v < 8; ++v) {
      vertices[v] = cell->vertex_index(v);
      mesh.vertices[vertices[v]] = map(ball.position(cell, dealii::Point<3>(v & 1, v >> 1 & 1, v >> 2 & 1)));
    }
  }
  return mesh;
}

dealii::Point<3> onto_ellipsoid(const dealii::Point<3>& X) { return {1.3 * X[0], X[1], 0.8 * X[2]}; }

/// Even under X → −X, so that the centre of mass stays.
dealii::Point<3> onto_rough_ball(const dealii::Point<3>& X) {
  const double bumps = X[0] * X[1] + 0.5 * X[2] * X[2] + X[0] * X[2] * (X[0] * X[0] - X[2] * X[2]);
  return X * (1 + 0.1 * bumps);
}

GeometryError error_of_ellipsoid(int n_refinements) {
  const ElasticBall ball(BallMesh(hexahedra(n_refinements, onto_ellipsoid), 0), 2, neo_hookean);
  const double volume = 4 * std::numbers::pi / 3 * 1.3 * 0.8;
  const Matrix3d E0 = volume / 5 * diagonal(1.69, 1, 0.64);
  return {std::abs(ball.volume() / volume - 1), (ball.E0() - E0).norm() / E0.norm()};
}

/// Flat edges: order 2, so a refinement divides the errors by about 4.
TEST(MeshFile, VolumeAndInertiaConvergeToThoseOfTheEllipsoid) {
  const GeometryError coarse = error_of_ellipsoid(1), fine = error_of_ellipsoid(2);
  EXPECT_LT(fine.volume, 0.02);
  EXPECT_GT(coarse.volume / fine.volume, 3.5);
  EXPECT_GT(coarse.inertia / fine.inertia, 3.5);
}

/// The geometry of a trilinear cell is the same at every degree and after refinement; at degree 3 its inertia is exact.
TEST(MeshFile, GeometryIsTheSameAtEveryDegreeAndRefinement) {
  const CoarseMesh mesh = hexahedra(0, onto_rough_ball);
  const ElasticBall ball(BallMesh(mesh, 0), 3, neo_hookean);
  for (const auto& [degree, n_refinements] : {std::pair{4, 0}, {3, 1}}) {
    const ElasticBall other(BallMesh(mesh, n_refinements), degree, neo_hookean);
    EXPECT_NEAR(other.volume(), ball.volume(), 1e-13);
    EXPECT_LT((other.E0() - ball.E0()).norm(), 1e-13);
  }
}

/// The 24 ways to turn the cube of local coordinates.
CoarseMesh with_turned_cells(CoarseMesh mesh, std::mt19937& generator) {
  for (auto& cell : mesh.cells)
    for (int n = generator() % 24; n > 0; --n) {
      const int axis = generator() % 3, a = (axis + 1) % 3, b = (axis + 2) % 3;
      const auto old = cell;
      for (int v = 0; v < 8; ++v) {  // a quarter turn: ξ_a ← ξ_b, ξ_b ← 1 − ξ_a
        const int bit_a = v >> b & 1, bit_b = 1 - (v >> a & 1);
        cell[v] = old[(v & 1 << axis) | bit_a << a | bit_b << b];
      }
    }
  std::shuffle(mesh.cells.begin(), mesh.cells.end(), generator);
  return mesh;
}

/// A force of the same motion: neighbours agree on their nodes however their local coordinates are turned.
TEST(MeshFile, CellsMayBeTurnedInAnyWay) {
  std::mt19937 generator(5);
  const CoarseMesh mesh = hexahedra(0, onto_rough_ball);
  const auto observables = [&](const CoarseMesh& m) {
    const ElasticBall ball(BallMesh(m, 1), 3, neo_hookean);
    const auto r =
        run<mechanics::Rattle>(ball, affine_state(ball, Matrix3d::Identity(), diagonal(0.3, 0.3, -0.6)), 0.1, 1, 10);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    return observed(ball, r.states.back());
  };
  const auto expected = observables(mesh), turned = observables(with_turned_cells(mesh, generator));
  // The constraint is met to 1e-13 and sums are in another order.
  EXPECT_LT((turned.Q - expected.Q).norm(), 1e-11);
  EXPECT_NEAR(turned.elastic, expected.elastic, 1e-11);
  EXPECT_NEAR(turned.volume_ratio, expected.volume_ratio, 1e-11);
}

/// PHYSICS 7.3 with the mesh's own inertia and volume.
TEST(MeshFile, AffineRestrictionIsThePseudoRigidBody) {
  using Body = reduced::PseudoRigidBody<CiarletGeymonat, true>;
  std::mt19937 generator(3);
  const CoarseMesh mesh = hexahedra(0, onto_rough_ball);
  for (const int degree : {2, 3, 4}) {
    const ElasticBall ball(BallMesh(mesh, 0), degree, ciarlet_geymonat);
    const Body body(ciarlet_geymonat, {ball.E0(), ball.volume()});
    EXPECT_GT(std::abs(ball.E0()(0, 1)), 1e-3) << "the body has no symmetry that hides an error";
    const Matrix3d Q = Matrix3d::Identity() + 0.3 * random_matrix(generator), Qdot = random_matrix(generator);
    const auto o = observed(ball, affine_state(ball, Q, Qdot), {{.multiplier = false}});
    Body::Workspace body_workspace;
    mechanics::ReducedObservables expected;
    ASSERT_TRUE(reduced::observe(body, {0, Q, Qdot}, body_workspace, {}, expected));
    EXPECT_NEAR(o.kinetic, expected.kinetic, 1e-12 * expected.kinetic);
    EXPECT_NEAR(o.elastic, expected.elastic, 1e-12 * std::max(1.0, expected.elastic));
    EXPECT_LT((o.angular_momentum - expected.angular_momentum).norm(), 1e-12);
    EXPECT_LT((o.Q - Q).norm() + (o.F - Q).norm(), 1e-12);
    auto workspace = ball.make_workspace();
    continuum::Vector f = ball.make_vector();
    ASSERT_TRUE(ball.force(0, ball.affine_field(Q), ball.make_vector(), workspace, f));
    Matrix3d force = Matrix3d::Zero();
    ASSERT_TRUE(body.force(0, Q, Matrix3d::Zero(), body_workspace, force));
    EXPECT_LT((moment_of_force(ball, f) - force).norm(), 1e-12 * std::max(1.0, force.norm()));
  }
}

TEST(MeshFile, RoughBallKeepsEnergyAndMomenta) {
  const ElasticBall ball(BallMesh(hexahedra(0, onto_rough_ball), 0), 2, neo_hookean);
  Matrix3d Qdot;
  Qdot << 0.2, -0.5, 0.1, 0.5, -0.3, 0, 0.2, 0.1, 0.1;
  const auto energy_drift = [&](long n_steps) {
    const auto r = run<mechanics::Rattle>(ball, affine_state(ball, Matrix3d::Identity(), Qdot), 1, 4, n_steps);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    const auto first = observed(ball, r.states.front());
    double drift = 0;
    for (const auto& state : r.states) {
      const auto o = observed(ball, state);
      drift = std::max(drift, std::abs(o.kinetic + o.elastic - first.kinetic - first.elastic));
      EXPECT_LT((o.angular_momentum - first.angular_momentum).norm(), 1e-12);
      EXPECT_LT(o.velocity.norm() + o.center.norm(), 1e-12);
    }
    return drift;
  };
  const double coarse = energy_drift(20), fine = energy_drift(40);
  EXPECT_LT(fine, 1e-4);
  EXPECT_GT(coarse / fine, 3.2);  // order 2
}

}  // namespace
}  // namespace pseudorigid::testing
