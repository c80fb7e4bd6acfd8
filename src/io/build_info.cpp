#include "io/build_info.h"

#include "git_hash.h"  // written by git_hash.cmake at build time

namespace pseudorigid::io {

BuildInfo build_info() {
  return {.version = PSEUDORIGID_VERSION,
          .git_hash = PSEUDORIGID_GIT_HASH,
          .compiler = PSEUDORIGID_COMPILER,
          .flags = PSEUDORIGID_FLAGS,
          .build_type = PSEUDORIGID_BUILD_TYPE};
}

}  // namespace pseudorigid::io
