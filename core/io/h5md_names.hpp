#pragma once
/// Where things are in traj.h5, for the sources of core/io/h5md.hpp.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace treejet::h5md {

inline constexpr const char *jet = "/particles/jet", *observables = "/observables",
                            *parameters = "/parameters";
/// The id where there is no point, and any other number there.
inline constexpr std::int64_t absent = -1;
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Step, time or value of an element of a group.
std::string element(const char* group, std::string_view name, const char* part);

}  // namespace treejet::h5md
