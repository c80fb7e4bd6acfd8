#pragma once
/// The 200 libraries that deal.II needs, opened in an order that costs little time.
///
/// A library that is opened resolves its names, 350,000 in all of them, and the dynamic linker looks for each in one
/// library after another: first the program, then the libraries that were opened together, in one order for all. Opened
/// by itself, after those that it needs, a library finds most names at once, in itself: 0.16 s of processor time in
/// place of 0.35 s.

#include <filesystem>

namespace pseudorigid::app {

/// Opens all libraries that this library needs, directly or through others, each by itself. A library that is not
/// found, or that cannot be opened by itself, is opened together with the whole.
void open_needed_libraries(const std::filesystem::path& library);

}  // namespace pseudorigid::app
