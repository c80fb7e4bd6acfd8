#pragma once
/// An error that the user can correct. Its text is one sentence, and the program exits with code 2.

#include <stdexcept>

namespace pseudorigid {

struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pseudorigid
