/// The face integrals of deal.II's MatrixFree for the widest vectors of this processor (fe_evaluation_force.h). They
/// are in a file of their own, because deal.II's headers for cells and for faces have the same include guard.

#include <deal.II/matrix_free/evaluation_template_face_factory.templates.h>

DEAL_II_NAMESPACE_OPEN

template struct internal::FEFaceEvaluationFactory<3, VectorizedArray<double>>;

DEAL_II_NAMESPACE_CLOSE
