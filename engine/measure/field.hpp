// Fields: what an observer knows place by place, on grids that stay the same for the whole run.
#pragma once

#include <string>
#include <vector>

namespace grainreel {

// One direction of a grid: a place, a phase of the drive, a species.
struct FieldAxis {
    std::string name;        // "z", unique within an observer
    std::string unit;        // "m", "turns", "1"
    std::string about;       // in words: "height above the floor"
    std::vector<double> at;  // the middles of the cells, rising
};

struct FieldInfo {
    std::string name;               // as in files: "solid_fraction"
    std::string label;              // where people read: "solid fraction"
    std::string unit;               // "1", "m/s"
    std::string about;              // in words, with the source of its formula
    std::vector<std::string> axes;  // names of its axes; that of the last one runs fastest
};

// Everything that one observer gives.
struct FieldSet {
    std::vector<FieldAxis> axes;
    std::vector<FieldInfo> fields;
};

// A value for each cell, in the order of the field's axes; NaN where there is none. One a field of the set.
using FieldValues = std::vector<std::vector<double>>;

}  // namespace grainreel
