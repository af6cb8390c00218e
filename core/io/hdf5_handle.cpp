#include "core/io/hdf5_handle.hpp"

#include <hdf5.h>

#include <algorithm>
#include <type_traits>

namespace treejet::hdf5 {

static_assert(std::is_same_v<hid_t, Id> && std::is_same_v<herr_t, int>);

void start_library() {
  static const bool once = [] {
    H5dont_atexit();
    H5open();
    return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  }();
  static_cast<void>(once);
}

std::string reason() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* to) -> herr_t {
        auto& all = *static_cast<std::string*>(to);
        if (all.empty() && error->desc) all = error->desc;
        return 0;
      },
      &text);
  constexpr std::string_view opens = "error message = '";
  if (const auto begin = text.find(opens); begin != std::string::npos) {
    text.erase(0, begin + opens.size());
    text.resize(std::min(text.find('\''), text.size()));
  }
  return text;
}

void refuse(const std::filesystem::path& path, std::string_view object, std::string_view why) {
  throw FileError(fmt::format("{}: {} {}", path.string(), object, why));
}

}  // namespace treejet::hdf5
