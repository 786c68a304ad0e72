// The fields of coarse-graining by name and unit, as files have them.
#pragma once

#include <optional>

#include "engine/measure/field.hpp"
#include "engine/measure/fields/coarse_graining.hpp"

namespace grainreel {

FieldSet coarse_field_set(const Scene& scene, const CoarseGraining& by);

// The values in the order of that set. `fields` may be missing: then all are NaN.
FieldValues coarse_field_values(const std::optional<CoarseFields>& fields, const CoarseGraining& by);

}  // namespace grainreel
