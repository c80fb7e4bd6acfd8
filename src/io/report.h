#pragma once
/// The page report.html, which contains the texts of files of a run. In the browser, the scripts of src/io/report/ draw
/// the data of these files. The page does not load other files. The user can save the contained files from the page.
///
/// The page has an element `<script type="…" data-file="NAME"></script>` for every file that it can show. In a report,
/// the element contains the text of the file, with `&` and `<` escaped as in HTML. The element is empty if the run does
/// not have the file. The elements with the name `frames-<name>.csv` do not contain files of the run. They contain
/// tables of faces of the body with the trajectory <name> (report_frames.h).

#include <span>
#include <string>
#include <string_view>

#include "io/run_directory.h"

namespace pseudorigid::io {

/// The text of the page with empty elements. The file name of an element may contain the placeholder {mover} for the
/// name of a trajectory.
std::string_view report_page();

/// Returns the page `empty` with the texts of the files in the directory. `movers` contains the names of the
/// trajectories, as movers_in in manifest.h returns them. An element with {mover} in its file name is repeated for each
/// trajectory, with the name of the trajectory in place of {mover}. Throws UserError if manifest.json or
/// another file of the run that the page shows exists but cannot be read. If a picture cannot be read, the table of its
/// trajectory is empty (table_of_frames).
std::string report_of(const RunDirectory& directory, std::span<const std::string> movers,
                      std::string_view empty = report_page());

/// Writes the page to report.html in the directory. Throws the errors of report_of, and WriteError if the page cannot
/// be written.
void write_report(const RunDirectory& directory, std::span<const std::string> movers);

}  // namespace pseudorigid::io
