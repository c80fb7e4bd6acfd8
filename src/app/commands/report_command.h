#pragma once
/// `pseudorigid report DIR`: makes report.html for a run without one, whether it has finished, is at work or was
/// killed.

#include "app/commands/command_line.h"

namespace pseudorigid::app {

/// Writes the page and prints its name. Throws UserError if the directory is not that of a run, or if the page cannot
/// have the place that was named.
void report_run(const Options& options);

}  // namespace pseudorigid::app
