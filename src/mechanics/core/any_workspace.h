#pragma once
/// The workspace of an AnySystem or AnyField. An AnyWorkspace owns the workspace of the concrete system, and
/// `as<Workspace>()` returns a reference to it. `as` does not check the type Workspace. Therefore use an AnyWorkspace
/// only with the AnySystem or AnyField that made it, or with a copy of this object.

#include <memory>
#include <utility>

namespace pseudorigid::mechanics {

class AnyWorkspace {
 public:
  template <class Workspace>
  explicit AnyWorkspace(Workspace workspace) : held_(std::make_unique<Held<Workspace>>(std::move(workspace))) {}

  template <class Workspace>
  Workspace& as() {
    return static_cast<Held<Workspace>&>(*held_).workspace;
  }

 private:
  struct Base {
    virtual ~Base() = default;
  };
  template <class Workspace>
  struct Held final : Base {
    explicit Held(Workspace w) : workspace(std::move(w)) {}
    Workspace workspace;
  };
  std::unique_ptr<Base> held_;
};

}  // namespace pseudorigid::mechanics
