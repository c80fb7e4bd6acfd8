#include "reduced/steady_curve.h"

#include <Eigen/SVD>

namespace pseudorigid::reduced {

NullDirections null_directions(const PlaneMatrix& DF) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(DF.topRows<7>(), Eigen::ComputeFullV);
  return {svd.matrixV().col(7), svd.matrixV().col(6), svd.singularValues()[6] / svd.singularValues()[0]};
}

}  // namespace pseudorigid::reduced
