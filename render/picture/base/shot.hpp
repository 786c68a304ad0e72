// A Shot is what one picture shows: a frame, and what stands beside its grains because the film asks for it.
// A field that is not asked for, or not known, is empty.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/measure/flow/flowed_out.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

class MeasureTable;  // engine/measure/measures.hpp
struct MeshWear;     // engine/measure/walls/mesh_wear.hpp

struct Shot : State {
    Shot() = default;
    // A frame is a shot with nothing beside it. This copies or moves all grains.
    Shot(State frame) : State(std::move(frame)) {}

    std::vector<Vec3> displacement;  // m, of each grain over the last period of the drive; also empty before
                                     // one has passed
    std::vector<Link> touches;
    std::vector<double> own;  // a value of each grain that the user brings; NaN where there is none

    // The rows of measures.csv so far: the first `measure_rows` rows of a table that goes on growing.
    std::shared_ptr<const MeasureTable> measures;
    std::size_t measure_rows = 0;

    std::shared_ptr<const std::vector<MeshWear>> worn;  // pressure and wear on the triangles of each mesh
    std::optional<FlowedOut> flowed_out;                // since the run began

    // Earlier moments, by rising time, that the exposure covers besides this one. Their own lists `exposed`
    // are empty.
    std::vector<std::shared_ptr<const Shot>> exposed;
};

using ShotPtr = std::shared_ptr<const Shot>;

}  // namespace grainreel
