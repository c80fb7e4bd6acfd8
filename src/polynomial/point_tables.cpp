#include "polynomial/point_tables.h"

#include <algorithm>
#include <utility>

#include "polynomial/dense_kernels.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {

PointTables::PointTables(int stride, int n_images, std::vector<int> shift)
    : stride_(stride), n_images_(n_images), shift_(std::move(shift)) {}

void PointTables::transform(int n_components, double* y) const {
  if (n_images_ == 1) return;
  for (int k = 0; k < n_components * n_fields(); ++k)
    dense().transform_images(y + static_cast<std::size_t>(k) * n_points(), n_images_, stride_);
}

void PointTables::evaluate(const std::vector<Block>& blocks, int n_components, const double* c, double* y) const {
  const int length = n_fields() * stride_;
  ScratchArray octant(length);
  for (const Block& block : blocks) {
    const double* rows = tables_[block.parity].data();
    if (n_images_ == 1) {
      dense().combine(rows, block.n(), length, c + block.offset, y + place(block, 0));
      continue;
    }
    dense().combine(rows, block.n(), length, c + block.offset, octant);
    for (int field = 0; field < n_fields(); ++field)
      std::copy_n(octant + static_cast<std::size_t>(field) * stride_, stride_, y + place(block, field));
  }
  transform(n_components, y);
}

void PointTables::add_transposed(const std::vector<Block>& blocks, int n_components, double* y, double* c) const {
  const int length = n_fields() * stride_;
  transform(n_components, y);
  ScratchArray octant(length);
  for (const Block& block : blocks) {
    const double* rows = tables_[block.parity].data();
    if (n_images_ == 1) {
      dense().contract(rows, block.n(), length, y + place(block, 0), c + block.offset);
      continue;
    }
    for (int field = 0; field < n_fields(); ++field)
      std::copy_n(y + place(block, field), stride_, octant + static_cast<std::size_t>(field) * stride_);
    dense().contract(rows, block.n(), length, octant, c + block.offset);
  }
}

}  // namespace pseudorigid::polynomial
