#pragma once
/// The checkpoints from which a resumed run continues.

#include <optional>
#include <string>

#include "app/ranks/on_all_ranks.h"
#include "app/run/run_context.h"
#include "io/checkpoint.h"
#include "io/files.h"

namespace pseudorigid::app {

/// The checkpoint with this name in the directory of the run; empty if the run is not resumed, or if the first rank
/// finds no such checkpoint. The first rank decides, because the other ranks may read the disk later or have another
/// disk. Throws the errors of io::Checkpoint::load on all ranks. Collective.
inline std::optional<io::Checkpoint> resumed_checkpoint(const RunContext& context, const std::string& name) {
  if (!context.resumes) return {};
  const auto path = context.directory.checkpoint(name);
  bool exists = false;
  on_all_ranks(*context.ranks, [&] { exists = io::is_there(path); });
  if (!context.ranks->of_first(exists)) return {};
  std::optional<io::Checkpoint> content;
  on_all_ranks(*context.ranks, [&] { content = io::Checkpoint::load(path); });
  return content;
}

}  // namespace pseudorigid::app
