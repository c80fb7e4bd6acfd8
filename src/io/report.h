#pragma once
/// The page report.html, which contains files of a run and draws them in the browser (src/io/report/). The page does
/// not load other files. The browser can save the files from the page.
///
/// The page has an element `<script type="…" data-file="NAME"></script>` for every file that it can show. In a report,
/// the element contains the text of the file, with `&` and `<` escaped as in HTML. The element is empty if the run does
/// not have the file. The elements `frames-<mover>.csv` are not files of the run. These elements contain faces of the
/// body from its pictures (report_frames.h).

#include <span>
#include <string>
#include <string_view>

#include "io/run_directory.h"

namespace pseudorigid::io {

/// The text of the page, with empty elements.
std::string_view report_page();

/// Returns the page with the files of the directory. `movers` are the names of the trajectories (movers_in of
/// manifest.h). `empty` is the page with empty elements. Throws UserError if a file that the page shows cannot be read.
std::string report_of(const RunDirectory& directory, std::span<const std::string> movers,
                      std::string_view empty = report_page());

/// Writes the page to report.html in the directory. Throws the errors of report_of, and WriteError.
void write_report(const RunDirectory& directory, std::span<const std::string> movers);

}  // namespace pseudorigid::io
