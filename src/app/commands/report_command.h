#pragma once
/// The command `pseudorigid report DIR`, which makes report.html from the files of a run. The run may have finished,
/// may still be running, or may have been killed.

#include "app/commands/command_line.h"

namespace pseudorigid::app {

/// Writes the page and prints its path. Throws UserError if the directory does not contain a run or a file of the run
/// cannot be read. Also throws it if the page cannot be written to the chosen path. Throws io::WriteError if the
/// machine cannot write, for example to a full disk.
void report_run(const Options& options);

}  // namespace pseudorigid::app
