// Whoever makes a page tells how far that is, and may be stopped.
#pragma once

#include <functional>

namespace grainreel {

// Told the share that is done; false: stop.
using PageProgress = std::function<bool(double)>;

// Thrown where one said stop; write_report() catches it.
struct PageStopped {};

inline const PageProgress kNoPageProgress = [](double) { return true; };

inline void go_on_or_stop(const PageProgress& progress, double share) {
    if (!progress(share)) throw PageStopped();
}

}  // namespace grainreel
