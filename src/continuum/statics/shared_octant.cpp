#include "continuum/statics/shared_octant.h"

#include <unordered_map>
#include <utility>

namespace pseudorigid::continuum {
namespace {

/// The entries of this rank of a vector with the entries `whole`.
void copy_part(const Eigen::VectorXd& whole, const std::vector<unsigned int>& entries, Vector& part) {
  for (std::size_t i = 0; i < entries.size(); ++i) part.begin()[i] = whole[entries[i]];
}

}  // namespace

SharedOctant::SharedOctant(std::shared_ptr<const BallBody> shared, const BallSpace& whole)
    : body_(std::move(shared)),
      n_field_(static_cast<Eigen::Index>(whole.make_vector().size())),
      n_multiplier_(static_cast<Eigen::Index>(whole.make_multiplier().size())) {
  const BallSpace& space = body_->space();
  std::unordered_map<std::size_t, unsigned int> cell_of_number;
  for (const std::size_t number : whole.cell_numbers())
    cell_of_number.emplace(number, static_cast<unsigned int>(cell_of_number.size()));
  field_entries_.resize(3 * space.n_nodes());
  unsigned int own = 0;
  for (const std::size_t number : space.cell_numbers()) {
    const unsigned int cell = cell_of_number.at(number);
    for (unsigned int j = 0; j < space.n_pressure(); ++j) multiplier_entries_.push_back(space.n_pressure() * cell + j);
    const std::vector<unsigned int>&nodes = space.cell_nodes(own++), &there = whole.cell_nodes(cell);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      if (nodes[a] < space.n_nodes())  // not a ghost node
        for (unsigned int c = 0; c < 3; ++c) field_entries_[3 * nodes[a] + c] = 3 * there[a] + c;
  }
}

Vector SharedOctant::part_of_field(const Eigen::VectorXd& whole) const {
  Vector part = body_->make_vector();
  copy_part(whole, field_entries_, part);
  part.update_ghost_values();
  return part;
}

Vector SharedOctant::part_of_multiplier(const Eigen::VectorXd& whole) const {
  Vector part = body_->space().make_multiplier();
  copy_part(whole, multiplier_entries_, part);
  return part;
}

Eigen::VectorXd SharedOctant::whole_field(const Vector& part) const { return whole(part, field_entries_, n_field_); }

Eigen::VectorXd SharedOctant::whole_multiplier(const Vector& part) const {
  return whole(part, multiplier_entries_, n_multiplier_);
}

Eigen::VectorXd SharedOctant::whole(const Vector& part, const std::vector<unsigned int>& entries,
                                    Eigen::Index n) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(n);
  for (std::size_t i = 0; i < entries.size(); ++i) result[entries[i]] = part.begin()[i];
  add_over_ranks({result.data(), static_cast<std::size_t>(n)}, body_->space().communicator());
  return result;
}

}  // namespace pseudorigid::continuum
