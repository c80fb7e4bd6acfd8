#pragma once
/// 3×3 tensors over any scalar: double, complex (derivatives by complex step), or a SIMD vector with a tensor entry of
/// one cell in each lane.
///
/// All operations are inlined and written entry by entry, so that the compiler keeps the tensors in registers. Loops
/// would prevent this, because the compiler unrolls them too late. The use of registers halves the time of a force
/// evaluation.

namespace pseudorigid::materials {

template <class T>
struct Tensor {
  T a[3][3];
  T& operator()(int i, int j) { return a[i][j]; }
  const T& operator()(int i, int j) const { return a[i][j]; }
};

/// Returns the tensor with the entries f(A_ij, B_ij, …).
template <class F, class T, class... Ts>
[[gnu::always_inline]] inline Tensor<T> entrywise(F f, const Tensor<T>& A, const Ts&... B) {
  return {{{f(A(0, 0), B(0, 0)...), f(A(0, 1), B(0, 1)...), f(A(0, 2), B(0, 2)...)},
           {f(A(1, 0), B(1, 0)...), f(A(1, 1), B(1, 1)...), f(A(1, 2), B(1, 2)...)},
           {f(A(2, 0), B(2, 0)...), f(A(2, 1), B(2, 1)...), f(A(2, 2), B(2, 2)...)}}};
}

/// Returns the cofactor cof F = (det F) F⁻ᵀ = ∂(det F)/∂F.
template <class T>
[[gnu::always_inline]] inline Tensor<T> cofactor(const Tensor<T>& F) {
  return {{{F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1), F(1, 2) * F(2, 0) - F(1, 0) * F(2, 2),
            F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0)},
           {F(2, 1) * F(0, 2) - F(2, 2) * F(0, 1), F(2, 2) * F(0, 0) - F(2, 0) * F(0, 2),
            F(2, 0) * F(0, 1) - F(2, 1) * F(0, 0)},
           {F(0, 1) * F(1, 2) - F(0, 2) * F(1, 1), F(0, 2) * F(1, 0) - F(0, 0) * F(1, 2),
            F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0)}}};
}

/// Returns the derivative of cof(F + sH) with respect to s at s = 0. Its entries are the mixed minors of F and H.
template <class T>
[[gnu::always_inline]] inline Tensor<T> cofactor_derivative(const Tensor<T>& F, const Tensor<T>& H) {
  const auto minor = [&](int i, int j, int k, int l) {
    return (F(i, j) * H(k, l) + H(i, j) * F(k, l)) - (F(i, l) * H(k, j) + H(i, l) * F(k, j));
  };
  return {{{minor(1, 1, 2, 2), minor(1, 2, 2, 0), minor(1, 0, 2, 1)},
           {minor(2, 1, 0, 2), minor(2, 2, 0, 0), minor(2, 0, 0, 1)},
           {minor(0, 1, 1, 2), minor(0, 2, 1, 0), minor(0, 0, 1, 1)}}};
}

/// Returns det F from F and its cofactor `cof`.
template <class T>
[[gnu::always_inline]] inline T determinant(const Tensor<T>& F, const Tensor<T>& cof) {
  return F(0, 0) * cof(0, 0) + F(0, 1) * cof(0, 1) + F(0, 2) * cof(0, 2);
}

template <class T>
[[gnu::always_inline]] inline T determinant(const Tensor<T>& F) {
  return determinant(F, cofactor(F));
}

/// Returns A : B = tr(AᵀB), summed row by row. The sums of the rows are independent, so the processor can compute them
/// in parallel.
template <class T>
[[gnu::always_inline]] inline T dot(const Tensor<T>& A, const Tensor<T>& B) {
  return (A(0, 0) * B(0, 0) + A(0, 1) * B(0, 1) + A(0, 2) * B(0, 2)) +
         ((A(1, 0) * B(1, 0) + A(1, 1) * B(1, 1) + A(1, 2) * B(1, 2)) +
          (A(2, 0) * B(2, 0) + A(2, 1) * B(2, 1) + A(2, 2) * B(2, 2)));
}

/// Returns the trace tr A.
template <class T>
[[gnu::always_inline]] inline T trace(const Tensor<T>& A) {
  return A(0, 0) + A(1, 1) + A(2, 2);
}

/// Returns the product AB.
template <class T>
[[gnu::always_inline]] inline Tensor<T> product(const Tensor<T>& A, const Tensor<T>& B) {
  const auto entry = [&](int i, int j) { return A(i, 0) * B(0, j) + A(i, 1) * B(1, j) + A(i, 2) * B(2, j); };
  return {{{entry(0, 0), entry(0, 1), entry(0, 2)},
           {entry(1, 0), entry(1, 1), entry(1, 2)},
           {entry(2, 0), entry(2, 1), entry(2, 2)}}};
}

/// Returns the product AᵀB.
template <class T>
[[gnu::always_inline]] inline Tensor<T> transposed_product(const Tensor<T>& A, const Tensor<T>& B) {
  const auto entry = [&](int i, int j) { return A(0, i) * B(0, j) + A(1, i) * B(1, j) + A(2, i) * B(2, j); };
  return {{{entry(0, 0), entry(0, 1), entry(0, 2)},
           {entry(1, 0), entry(1, 1), entry(1, 2)},
           {entry(2, 0), entry(2, 1), entry(2, 2)}}};
}

/// Returns the trace tr A².
template <class T>
[[gnu::always_inline]] inline T trace_of_square(const Tensor<T>& A) {
  return (A(0, 0) * A(0, 0) + A(1, 1) * A(1, 1) + A(2, 2) * A(2, 2)) +
         2.0 * (A(0, 1) * A(1, 0) + A(0, 2) * A(2, 0) + A(1, 2) * A(2, 1));
}

template <class T>
[[gnu::always_inline]] inline Tensor<T> operator*(const T& s, const Tensor<T>& A) {
  return entrywise([&](const T& a) { return s * a; }, A);
}

}  // namespace pseudorigid::materials
