#include <utility>

#include "app/run_models.h"
#include "app/system_run.h"

namespace pseudorigid::app {
namespace {

template <std::size_t... place>
ModelOutcome run_system_of(const RunContext& context, std::index_sequence<place...>) {
  ModelOutcome outcome;
  const auto run_if_named = [&]<std::size_t at>(std::integral_constant<std::size_t, at>) {
    if (context.scene.system == std::tuple_element_t<at, systems::SystemTable>::name)
      outcome = run_system_at<at>(context);
  };
  (run_if_named(std::integral_constant<std::size_t, place>()), ...);
  return outcome;
}

}  // namespace

ModelOutcome run_system(const RunContext& context) {
  return run_system_of(context, std::make_index_sequence<std::tuple_size_v<systems::SystemTable>>());
}

}  // namespace pseudorigid::app
