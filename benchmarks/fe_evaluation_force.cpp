#include "fe_evaluation_force.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>
#if DEAL_II_VECTORIZATION_WIDTH_IN_BITS > 0  // the installed library has these templates for vectors of one number only
#include <deal.II/matrix_free/dof_info.templates.h>
#include <deal.II/matrix_free/evaluation_template_factory.templates.h>
#include <deal.II/matrix_free/evaluation_template_factory_hanging_nodes.templates.h>
#include <deal.II/matrix_free/mapping_info.templates.h>
#include <deal.II/matrix_free/mapping_info_storage.templates.h>
#include <deal.II/matrix_free/matrix_free.templates.h>
#include <deal.II/matrix_free/shape_info.templates.h>
#endif

#include <cmath>
#include <stdexcept>

namespace pseudorigid::benchmarks {
namespace {

template <int degree>
class ForceOfDegree final : public FEEvaluationForce {
  using Lanes = dealii::VectorizedArray<double>;
  using MatrixFree = dealii::MatrixFree<3, double>;
  /// The renumbering is compiled in the library only, for vectors of one number.
  using LibrarySettings = dealii::MatrixFree<3, double, dealii::VectorizedArray<double, 1>>::AdditionalData;

 public:
  ForceOfDegree(const dealii::Triangulation<3>& triangulation, const Placement& position,
                const materials::CiarletGeymonat& law)
      : law_(law),
        scalar_element_(degree),
        element_(scalar_element_, 3),
        mapping_(degree),
        dof_handler_(triangulation) {
    mapping_.initialize(triangulation, [&](const auto& cell) {
      std::vector<dealii::Point<3>> points;
      for (const auto& xi : scalar_element_.get_unit_support_points()) points.push_back(position(cell, xi));
      return points;
    });
    dof_handler_.distribute_dofs(element_);
    const dealii::AffineConstraints<double> none;
    dealii::DoFRenumbering::matrix_free_data_locality(dof_handler_, none, settings<LibrarySettings>());
    matrix_free_.reinit(mapping_, dof_handler_, none, dealii::QGauss<1>(degree + 1),
                        settings<typename MatrixFree::AdditionalData>());
  }

  void force(const Vector& x, Vector& f) const override {
    matrix_free_.cell_loop(&ForceOfDegree::add_cells, this, f, x, true);
  }

  int n_lanes() const override { return static_cast<int>(Lanes::size()); }

  Vector placed() const override {
    Vector x;
    matrix_free_.initialize_dof_vector(x);
    std::vector<dealii::types::global_dof_index> indices(element_.dofs_per_cell);
    for (const auto& cell : dof_handler_.active_cell_iterators()) {
      cell->get_dof_indices(indices);
      for (unsigned int i = 0; i < indices.size(); ++i) {
        const auto [component, node] = element_.system_to_component_index(i);
        const auto X = mapping_.transform_unit_to_real_cell(cell, scalar_element_.unit_support_point(node));
        x[indices[i]] = placement(X)[component];
      }
    }
    return x;
  }

 private:
  template <class Settings>
  static Settings settings() {
    Settings settings;
    settings.tasks_parallel_scheme = Settings::none;
    settings.mapping_update_flags = dealii::update_gradients | dealii::update_JxW_values;
    return settings;
  }

  void add_cells(const MatrixFree& data, Vector& f, const Vector& x,
                 const std::pair<unsigned int, unsigned int>& cells) const {
    dealii::FEEvaluation<3, degree, degree + 1, 3, double> cell(data);
    for (unsigned int batch = cells.first; batch < cells.second; ++batch) {
      cell.reinit(batch);
      cell.gather_evaluate(x, dealii::EvaluationFlags::gradients);
      for (unsigned int q = 0; q < cell.n_q_points; ++q) {
        const dealii::Tensor<2, 3, Lanes> gradient = cell.get_gradient(q);
        materials::Tensor<Lanes> F;
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) F(i, j) = gradient[i][j];
        const materials::Tensor<Lanes> P = law_.stress(F);
        dealii::Tensor<2, 3, Lanes> minus_P;
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) minus_P[i][j] = -P(i, j);
        cell.submit_gradient(minus_P, q);
      }
      cell.integrate_scatter(dealii::EvaluationFlags::gradients, f);
    }
  }

  materials::CiarletGeymonat law_;
  dealii::FE_Q<3> scalar_element_;
  dealii::FESystem<3> element_;
  dealii::MappingQCache<3> mapping_;
  dealii::DoFHandler<3> dof_handler_;
  MatrixFree matrix_free_;
};

template <int degree>
std::unique_ptr<FEEvaluationForce> force_up_to(int wanted, const dealii::Triangulation<3>& triangulation,
                                               const Placement& position, const materials::CiarletGeymonat& law) {
  if (wanted == degree) return std::make_unique<ForceOfDegree<degree>>(triangulation, position, law);
  if constexpr (degree > 2) return force_up_to<degree - 1>(wanted, triangulation, position, law);
  throw std::invalid_argument("no FEEvaluation of that degree");
}

}  // namespace

std::unique_ptr<FEEvaluationForce> PSEUDORIGID_FE_EVALUATION(const dealii::Triangulation<3>& triangulation,
                                                             const Placement& position, int degree,
                                                             const materials::CiarletGeymonat& law) {
  return force_up_to<8>(degree, triangulation, position, law);
}

}  // namespace pseudorigid::benchmarks
