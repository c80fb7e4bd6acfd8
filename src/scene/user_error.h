#pragma once
/// An error that the user can mend: one sentence, exit code 2.

#include <stdexcept>

namespace pseudorigid {

struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pseudorigid
