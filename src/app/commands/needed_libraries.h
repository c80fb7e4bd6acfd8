#pragma once
/// A function that opens the 200 libraries of deal.II in an order that saves time.
///
/// The dynamic linker resolves 350,000 symbols of these libraries. For each symbol the linker searches the program
/// first. The linker then searches the libraries that were opened together, in the same order for all symbols. The
/// function opens each library by itself, after the libraries that this library needs. The linker then finds most
/// symbols at once, in the library itself. The processor time for opening these libraries falls from 0.35 s to 0.16 s.

#include <filesystem>

namespace pseudorigid::app {

/// Opens every library that `library` needs, directly or through other libraries, by a separate call of the linker for
/// each. If this call fails for a library, the linker opens it later together with `library`.
void open_needed_libraries(const std::filesystem::path& library);

}  // namespace pseudorigid::app
