#pragma once
/// report.html: one page that holds files of a run and draws them in the browser (src/io/report/). It loads nothing
/// from elsewhere, and the files can be saved from it.
///
/// The page has an element `<script type="…" data-file="NAME"></script>` for every file that it can show; in a report
/// it holds the file's text, `&` and `<` as in HTML. Files that a run does not have are empty there. The elements
/// frames-<mover>.csv are not files of the run: they hold faces of its pictures (report_frames.h).

#include <span>
#include <string>
#include <string_view>

#include "io/run_directory.h"

namespace pseudorigid::io {

/// The page without files.
std::string_view report_page();

/// The page filled with the files of the directory. `movers`: the names of the CSV files of trajectories, of a system
/// or of models. UserError if a file with the name of a result cannot be read.
std::string report_of(const RunDirectory& directory, std::span<const std::string> movers,
                      std::string_view empty = report_page());

/// Writes it as the directory's report.html.
void write_report(const RunDirectory& directory, std::span<const std::string> movers);

}  // namespace pseudorigid::io
