#pragma once
/// One type for the landscapes of all systems (landscape.h). With this type the search for critical points is compiled
/// only once. An AnyLandscape contains the landscape that the constructor takes. If this landscape refers to a system,
/// the system must exist as long as the AnyLandscape.

#include <concepts>
#include <memory>
#include <utility>

#include "mechanics/equilibria/landscape.h"

namespace pseudorigid::mechanics {

class AnyLandscape {
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

 public:
  template <class L>
  requires(!std::same_as<L, AnyLandscape> && Landscape<L>) AnyLandscape(L landscape)
      : held_(std::make_unique<Model<L>>(std::move(landscape))) {}

  int n_coordinates() const { return held_->n_coordinates(); }
  int n_constraints() const { return held_->n_constraints(); }
  Vector periods() const { return held_->periods(); }
  double potential(const Vector& q) const { return held_->potential(q); }
  Status gradient(const Vector& q, Vector& dV) const { return held_->gradient(q, dV); }
  Status constraint(const Vector& q, Vector& g) const { return held_->constraint(q, g); }
  void constraint_gradient(const Vector& q, Matrix& G) const { held_->constraint_gradient(q, G); }
  Status hessian(const Vector& q, const Vector& lambda, Matrix& H) const { return held_->hessian(q, lambda, H); }
  void mass(const Vector& q, Matrix& M) const { held_->mass(q, M); }
  Status damping(const Vector& q, Matrix& C) const { return held_->damping(q, C); }

 private:
  struct Interface {
    virtual ~Interface() = default;
    virtual int n_coordinates() const = 0;
    virtual int n_constraints() const = 0;
    virtual Vector periods() const = 0;
    virtual double potential(const Vector& q) const = 0;
    virtual Status gradient(const Vector& q, Vector& dV) const = 0;
    virtual Status constraint(const Vector& q, Vector& g) const = 0;
    virtual void constraint_gradient(const Vector& q, Matrix& G) const = 0;
    virtual Status hessian(const Vector& q, const Vector& lambda, Matrix& H) const = 0;
    virtual void mass(const Vector& q, Matrix& M) const = 0;
    virtual Status damping(const Vector& q, Matrix& C) const = 0;
  };

  template <class L>
  struct Model final : Interface {
    explicit Model(L landscape) : l(std::move(landscape)) {}
    int n_coordinates() const override { return l.n_coordinates(); }
    int n_constraints() const override { return l.n_constraints(); }
    Vector periods() const override { return l.periods(); }
    double potential(const Vector& q) const override { return l.potential(q); }
    Status gradient(const Vector& q, Vector& dV) const override { return l.gradient(q, dV); }
    Status constraint(const Vector& q, Vector& g) const override { return l.constraint(q, g); }
    void constraint_gradient(const Vector& q, Matrix& G) const override { l.constraint_gradient(q, G); }
    Status hessian(const Vector& q, const Vector& lambda, Matrix& H) const override { return l.hessian(q, lambda, H); }
    void mass(const Vector& q, Matrix& M) const override { l.mass(q, M); }
    Status damping(const Vector& q, Matrix& C) const override { return l.damping(q, C); }
    L l;
  };

  std::unique_ptr<const Interface> held_;
};

}  // namespace pseudorigid::mechanics
