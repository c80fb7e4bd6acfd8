/// The templates of deal.II that FEEvaluationForce needs, for the widest vectors of this processor. The installed library
/// has them for vectors of one number only.

#include <deal.II/matrix_free/dof_info.templates.h>
#include <deal.II/matrix_free/evaluation_template_face_factory.templates.h>
#include <deal.II/matrix_free/evaluation_template_factory.templates.h>
#include <deal.II/matrix_free/evaluation_template_factory_hanging_nodes.templates.h>
#include <deal.II/matrix_free/mapping_info.templates.h>
#include <deal.II/matrix_free/mapping_info_storage.templates.h>
#include <deal.II/matrix_free/matrix_free.templates.h>
#include <deal.II/matrix_free/shape_info.templates.h>

DEAL_II_NAMESPACE_OPEN

static_assert(VectorizedArray<double>::size() > 1);
template class MatrixFree<3, double, VectorizedArray<double>>;
template struct internal::FEEvaluationFactory<3, VectorizedArray<double>>;
template struct internal::FEFaceEvaluationFactory<3, VectorizedArray<double>>;
template struct internal::FEEvaluationHangingNodesFactory<3, double, VectorizedArray<double>>;

DEAL_II_NAMESPACE_CLOSE
