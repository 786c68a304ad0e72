/// @file
/// The version of the library, and its namespace.
///
/// All names are in grainreel::v1, and a using directive makes them available in grainreel: write
/// grainreel::Scene. The number after v is the major version. Within one major version programs need no
/// change.
#pragma once

#include <string>

namespace grainreel::v1 {

/// The version that is linked, "1.0.0", by semver.org.
std::string version();

}  // namespace grainreel::v1

#ifndef GRAINREEL_LIBRARY_SOURCE
namespace grainreel {
using namespace v1;  // NOLINT: so that programs need not name the version
}
#endif
