#include "app/run/picture.h"

#include <fmt/format.h>

#include <vector>

#include "app/ranks/on_all_ranks.h"
#include "app/run/scene_to_model.h"
#include "io/body_picture.h"

namespace pseudorigid::app {
namespace {

/// In a single process, writes the grid to `path`. On several ranks, writes the piece of this rank. The first rank then
/// also writes the list of all pieces.
void write_pieces(const RunContext& context, std::filesystem::path path, const io::UnstructuredGrid& grid) {
  const int n_ranks = context.ranks->size();
  if (n_ranks == 1) return io::write_vtu(path, grid);
  std::vector<std::filesystem::path> pieces;
  for (int rank = 0; rank < n_ranks; ++rank)
    pieces.push_back(path.parent_path() / fmt::format("{}-{:04}.vtu", path.stem().string(), rank));
  io::write_vtu(pieces[context.ranks->rank()], grid);
  if (context.ranks->is_first()) io::write_pvtu(path.replace_extension("pvtu"), grid, pieces);
}

}  // namespace

void write_picture(const RunContext& context, const std::filesystem::path& path, double time,
                   const mechanics::PointBlocks& blocks, const mechanics::BodyFields& fields) {
  const scene::Scene& scene = context.scene;
  const io::PicturedContact contact{
      loads::constant_forcing(internal_loads(scene)).planes.at(context.internal_time(time)),
      to_eigen(scene.body.semi_axes)};
  const io::UnstructuredGrid grid =
      io::body_picture(blocks, fields, time, context.units, scene.output.fields, scene.output.cells, contact);
  on_all_ranks(*context.ranks, [&] { write_pieces(context, path, grid); });
}

}  // namespace pseudorigid::app
