#pragma once
/// The command `pseudorigid report DIR`, which makes report.html from the files of a run. The run may have finished,
/// may still be in progress, or may have been killed.

#include "app/commands/command_line.h"

namespace pseudorigid::app {

/// Writes the page and prints its path. Throws UserError if the directory does not contain a run, or if a file of the
/// run cannot be read. Also throws UserError if the page cannot be written because of its path. Throws io::WriteError
/// if the page cannot be written for another reason, for example because the disk is full.
void report_run(const Options& options);

}  // namespace pseudorigid::app
