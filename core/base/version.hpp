#pragma once
/// What this binary is: enough to say beside a result which program made it.

#include <string_view>

namespace treejet {

struct Version {
  std::string_view number;  ///< e.g. "0.1.0"
  std::string_view commit;  ///< git hash, "-dirty" behind it if files differed; "unknown" outside a checkout
  std::string_view compiler;  ///< name and number
  std::string_view build;     ///< Release, Debug, ...
};

/// Its values are filled in at build time by core/base/version.cmake.
Version version();

}  // namespace treejet
