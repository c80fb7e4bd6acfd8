#include "continuum/statics/sector_basis.h"

#include <algorithm>
#include <cmath>

#include "continuum/modes/block_lanczos.h"

namespace pseudorigid::continuum {

mechanics::Status SectorBasis::add_eigenvectors(int n, const Vector* known) {
  // Relative residual of eigenvectors. The eigenvalues of the projected problem have errors of the order of its square.
  constexpr double eigenvector_tolerance = 1e-6;
  if (auto status = sector_.factorize(); !status) return status;
  BlockLanczos lanczos([&](const auto& y, auto& z) { return sector_.apply(y, z); },
                       static_cast<Eigen::Index>(sector_.n_unknowns()), left_out(known));
  if (auto status = lanczos.find(n, eigenvector_tolerance); !status) return status;
  ParitySector::Modes modes;
  if (auto status = sector_.modes_of(lanczos.vectors(), modes); !status) return status;
  for (Eigen::Index k = 0; k < modes.u.cols(); ++k) eigenvectors_.push_back(modes.u.col(k));
  return {};
}

mechanics::Status SectorBasis::add_responses(const std::vector<Vector>& forces) {
  Eigen::MatrixXd f(sector_.mass().size(), static_cast<Eigen::Index>(forces.size())), u;
  for (Eigen::Index k = 0; k < f.cols(); ++k) f.col(k) = sector_.entries_of(forces[static_cast<std::size_t>(k)]);
  if (auto status = sector_.respond(f, u); !status) return status;
  for (Eigen::Index k = 0; k < u.cols(); ++k) responses_.push_back(u.col(k));
  return {};
}

void SectorBasis::share_others() {
  ranks_.share(is_mine_, sector_.mass().size(), responses_);
  ranks_.share(is_mine_, sector_.mass().size(), others_);
}

void SectorBasis::span(std::size_t n) {
  basis_.clear();
  for (const auto* vectors : {&eigenvectors_, &responses_})
    for (std::size_t i = 0; i < std::min(n, vectors->size()); ++i) append((*vectors)[i]);
  for (const Eigen::VectorXd& u : others_) append(u);
}

Vector SectorBasis::combination(const Eigen::VectorXd& z) const {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(sector_.n_unknowns()));
  for (Eigen::Index i = 0; i < size(); ++i) u += z[i] * (*this)[i];
  return sector_.field_of(u);
}

Eigen::VectorXd SectorBasis::coordinates(const Vector& u) const {
  const Eigen::VectorXd M_u = sector_.mass().cwiseProduct(sector_.entries_of(u));
  Eigen::VectorXd result(size());
  for (Eigen::Index i = 0; i < size(); ++i) result[i] = M_u.dot((*this)[i]);
  return result;
}

Eigen::MatrixXd SectorBasis::stiffness(double shift) const {
  Eigen::MatrixXd K(size(), size());
  if (is_mine_) {
    Eigen::MatrixXd b(sector_.mass().size(), size());
    for (Eigen::Index j = 0; j < size(); ++j) b.col(j) = (*this)[j];
    K = b.transpose() * sector_.product(b);
    K.diagonal().array() -= shift;
  }
  ranks_.share(is_mine_, K);
  return (K + K.transpose()) / 2;
}

Eigen::MatrixXd SectorBasis::left_out(const Vector* known) const {
  const auto vector = [&](const Vector& u) {
    return sector_.entries_of(u).cwiseProduct(sector_.mass().cwiseSqrt()).normalized();
  };
  const auto& sign = sector_.parity().sign;
  if (std::ranges::count(sign, -1) != 1) return known ? Eigen::MatrixXd(vector(*known)) : Eigen::MatrixXd();
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(std::ranges::find(sign, -1) - sign.begin());
  Vector u = sector_.space().make_vector();
  for (unsigned int i = 0; i < 3 * sector_.space().n_nodes(); ++i) u.local_element(i) = axis[i % 3];
  return vector(u);
}

void SectorBasis::append(Eigen::VectorXd u) {
  const double before = std::sqrt(u.dot(sector_.mass().cwiseProduct(u)));
  for (int repetition = 0; repetition < 2; ++repetition)
    for (const Eigen::VectorXd& b : basis_) u -= b.dot(sector_.mass().cwiseProduct(u)) * b;
  const double length = std::sqrt(u.dot(sector_.mass().cwiseProduct(u)));
  if (length > dependent * before) basis_.push_back(u / length);
}

}  // namespace pseudorigid::continuum
