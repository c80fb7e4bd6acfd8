#pragma once
/// A law without stored energy: W = 0 and P = 0. With this law, an incompressible body is an ideal fluid, and a
/// compressible body consists of free particles. An ideal fluid in affine motion is Dirichlet's fluid ellipsoid.

#include "materials/tensor.h"

namespace pseudorigid::materials {

struct Fluid {
  bool operator==(const Fluid&) const = default;

  template <class T>
  T energy(const Tensor<T>&) const {
    return T(0.0);
  }
  template <class T>
  Tensor<T> stress(const Tensor<T>& F) const {
    return entrywise([](const T&) { return T(0.0); }, F);
  }
  template <class T>
  Tensor<T> tangent(const Tensor<T>& F, const Tensor<T>&) const {
    return stress(F);
  }
};

}  // namespace pseudorigid::materials
