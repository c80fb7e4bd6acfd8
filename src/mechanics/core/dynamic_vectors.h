#pragma once
/// Conversions between Eigen vectors of dynamic size and the vectors and multipliers of a system. The dynamic vector
/// contains the entries of a matrix column by column. `read_as<V>` converts a dynamic vector to an input argument of
/// type V, and `WriteAs<V>` to an output argument of type V. The cost depends on V:
///
///   matrix of fixed size     copies
///   double                   copy of the only entry for input, reference to this entry for output
///   NoMultiplier             empty objects
///   VectorXd                 references
///   matrix of dynamic size   views for functions that take Eigen::Ref; slow copies for other functions

#include <Eigen/Core>
#include <optional>
#include <type_traits>

#include "mechanics/core/vector_space.h"

namespace pseudorigid::mechanics {

namespace detail {

template <class V>
inline constexpr bool has_dynamic_size = V::SizeAtCompileTime == Eigen::Dynamic;
template <>
inline constexpr bool has_dynamic_size<double> = false;
template <>
inline constexpr bool has_dynamic_size<NoMultiplier> = false;

template <class V>
decltype(auto) read_as(const Eigen::VectorXd& x) {
  if constexpr (std::is_same_v<V, Eigen::VectorXd>)
    return (x);
  else if constexpr (std::is_same_v<V, double>)
    return x[0];
  else if constexpr (std::is_same_v<V, NoMultiplier>)
    return NoMultiplier();
  else if constexpr (has_dynamic_size<V>)
    return Eigen::Map<const V>(x.data(), V::RowsAtCompileTime, x.size() / V::RowsAtCompileTime);
  else
    return V(Eigen::Map<const V>(x.data()));
}

/// An output argument of type V for a function of a system. The general form is for a V of fixed size. It contains a
/// copy, whose entries the destructor writes to the dynamic vector.
template <class V>
class WriteAs {
 public:
  explicit WriteAs(Eigen::VectorXd& x) : x_(x), own_(Eigen::Map<const V>(x.data())) {}
  ~WriteAs() { Eigen::Map<V>(x_.data()) = own_; }
  WriteAs(const WriteAs&) = delete;
  operator V&() { return own_; }

 private:
  Eigen::VectorXd& x_;
  V own_;
};
template <class V>
requires has_dynamic_size<V>
class WriteAs<V> {
 public:
  explicit WriteAs(Eigen::VectorXd& x) : view_(x.data(), V::RowsAtCompileTime, x.size() / V::RowsAtCompileTime) {}
  ~WriteAs() {
    if (copy_) view_ = *copy_;
  }
  WriteAs(const WriteAs&) = delete;
  operator Eigen::Ref<V>() { return view_; }
  operator V&() { return copy_.emplace(view_); }

 private:
  Eigen::Map<V> view_;
  std::optional<V> copy_;
};
template <>
class WriteAs<Eigen::VectorXd> {
 public:
  explicit WriteAs(Eigen::VectorXd& x) : x_(x) {}
  operator Eigen::VectorXd&() { return x_; }

 private:
  Eigen::VectorXd& x_;
};
template <>
class WriteAs<double> {
 public:
  explicit WriteAs(Eigen::VectorXd& x) : x_(x[0]) {}
  operator double&() { return x_; }

 private:
  double& x_;
};
template <>
class WriteAs<NoMultiplier> {
 public:
  explicit WriteAs(Eigen::VectorXd&) {}
  operator NoMultiplier&() { return none_; }

 private:
  NoMultiplier none_;
};

/// The inverse of read_as: returns the entries of x as a dynamic vector.
template <class V>
Eigen::VectorXd flat(V x) {
  const auto entries = local_values(x);
  return Eigen::Map<const Eigen::VectorXd>(entries.data(), static_cast<Eigen::Index>(entries.size()));
}

}  // namespace detail

}  // namespace pseudorigid::mechanics
