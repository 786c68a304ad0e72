#include "engine/base/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace grainreel {

void check_failed(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "grainreel: bug: %s:%d: %s does not hold\n", file, line, condition);
    std::abort();
}

}  // namespace grainreel
