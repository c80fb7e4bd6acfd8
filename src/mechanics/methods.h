#pragma once
/// The methods by rising order, for code that chooses among them at run time.

#include <array>
#include <string_view>
#include <utility>

#include "mechanics/composition.h"
#include "mechanics/rattle.h"

namespace pseudorigid::mechanics {

enum class MethodId { rattle, rattle4, rattle6, rattle8 };

inline constexpr std::array all_methods{MethodId::rattle, MethodId::rattle4, MethodId::rattle6, MethodId::rattle8};

/// Calls visitor(Method{}) with the method of that id.
template <class Visitor>
decltype(auto) with_method(MethodId id, Visitor&& visitor) {
  switch (id) {
    case MethodId::rattle4:
      return std::forward<Visitor>(visitor)(Rattle4{});
    case MethodId::rattle6:
      return std::forward<Visitor>(visitor)(Rattle6{});
    case MethodId::rattle8:
      return std::forward<Visitor>(visitor)(Rattle8{});
    case MethodId::rattle:
      break;
  }
  return std::forward<Visitor>(visitor)(Rattle{});
}

constexpr std::string_view method_name(MethodId id) {
  constexpr std::array<std::string_view, 4> names{"rattle", "rattle-4", "rattle-6", "rattle-8"};
  return names[static_cast<std::size_t>(id)];
}

}  // namespace pseudorigid::mechanics
