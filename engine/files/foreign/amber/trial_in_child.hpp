// Work that may crash, tried in a child process first. The HDF5 library follows the pointers of a damaged
// file wherever they lead; whoever opens one must not end with it.
#pragma once

#include <functional>

namespace grainreel {

// Does `work` in a copy of this process, for up to so many seconds. Whether the copy lived to its end; what
// it changed is gone, and an exception counts as an end. True also where no copy can be made.
bool survives(const std::function<void()>& work, unsigned seconds);

}  // namespace grainreel
