#include "io/pvd.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/user_error.h"
#include "scratch.h"

namespace pseudorigid::io::test {
namespace {

TEST(PvdCollection, IsTakenUpWithoutTheFramesFromATimeOn) {
  const ScratchDirectory scratch;
  const auto path = scratch / "reduced.pvd";
  PvdCollection first(path);
  for (const double t : {0.0, 1.0, 2.0}) first.add(t, scratch / "graphics" / "reduced-000000.vtu");
  EXPECT_EQ(PvdCollection::resume(path, 2).frames().size(), 2u);
  EXPECT_EQ(PvdCollection::resume(scratch / "none.pvd", 2).frames().size(), 0u);
}

/// A list that was edited by hand or cut off is the user's to mend: the message has its name and the line.
TEST(PvdCollection, DamagedIsRefusedWithItsLine) {
  const ScratchDirectory scratch;
  const auto path = scratch / "reduced.pvd";
  PvdCollection whole(path);
  whole.add(1, scratch / "graphics" / "reduced-000007.vtu");
  const std::string text = contents(path);
  const auto damaged = [&](const std::string& what, const std::string& by) {
    std::string changed = text;
    const auto at = changed.find(what);
    EXPECT_NE(at, changed.npos) << what;
    put(path, changed.replace(at, what.size(), by));
    return message_of<UserError>([&] { PvdCollection::resume(path, HUGE_VAL); });
  };
  for (const auto& [what, by] : {std::pair{"timestep=\"1", "timestep=\""},
                                 {"timestep=\"1", "timestep=\"one"},
                                 {"000007.vtu", "seven.vtu"},
                                 {"timestep", "time"}}) {
    const std::string message = damaged(what, by);
    EXPECT_NE(message.find("reduced.pvd:"), message.npos) << what << " -> " << by << ": " << message;
  }
}

}  // namespace
}  // namespace pseudorigid::io::test
