#pragma once
/// 3×3 tensors over any scalar: double, complex (derivatives by complex step), or a SIMD vector of cells.

namespace pseudorigid::materials {

template <class T>
struct Tensor {
  T a[3][3];
  T& operator()(int i, int j) { return a[i][j]; }
  const T& operator()(int i, int j) const { return a[i][j]; }
};

/// cof F = (det F) F⁻ᵀ = ∂(det F)/∂F
template <class T>
inline Tensor<T> cofactor(const Tensor<T>& F) {
  Tensor<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c(i, j) = F(i1, j1) * F(i2, j2) - F(i1, j2) * F(i2, j1);
    }
  return c;
}

/// det F, given its cofactors.
template <class T>
inline T determinant(const Tensor<T>& F, const Tensor<T>& cof) {
  return F(0, 0) * cof(0, 0) + F(0, 1) * cof(0, 1) + F(0, 2) * cof(0, 2);
}

template <class T>
inline T determinant(const Tensor<T>& F) {
  return determinant(F, cofactor(F));
}

/// A : B
template <class T>
inline T dot(const Tensor<T>& A, const Tensor<T>& B) {
  T s = A(0, 0) * B(0, 0);
  for (int k = 1; k < 9; ++k) s = s + A(k / 3, k % 3) * B(k / 3, k % 3);
  return s;
}

template <class T>
inline Tensor<T> operator*(const T& s, const Tensor<T>& A) {
  Tensor<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = s * A(i, j);
  return r;
}

}  // namespace pseudorigid::materials
