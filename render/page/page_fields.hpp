// The fields of a run as a page has them: the plane that the film looks at, a byte a cell and quantity.
//
// The bytes, before they are packed, are for Ny cells across and Nz in height (y fastest), Q quantities and R
// records:
//   Ny Nz bytes, the share of each cell that is inside the container, of 255;
//   then for each record and quantity Ny Nz bytes: 0 to 254 from the quantity's lowest value to its highest,
//   255 where there is none.
// render/page/html/fields.js reads them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct FieldQuantity {
    std::string name;   // "speed"
    std::string label;  // "speed of the flow"
    std::string unit;
    double low = 0, high = 0;  // of all records
};

struct PageFields {
    struct Axis {
        double low = 0, cell = 0;  // m
        std::size_t count = 0;
    };
    struct Record {
        double begin = 0, end = 0;  // s
    };
    Axis y, z;
    std::vector<Record> records;  // those that the page has
    std::size_t all_records = 0;
    std::vector<FieldQuantity> quantities;
    std::vector<std::uint8_t> packed;
    std::string why_not;  // a sentence, where the run has fields that the page has not
    bool present() const { return !packed.empty(); }
};

constexpr std::size_t kMostFieldBytes = 1'000'000;  // packed

// The fields of fields.nc in a run's folder; with a grid in three dimensions means over the depth. Nothing
// where the run kept none.
PageFields page_fields(const FilmedScene& scene, const std::filesystem::path& folder);

}  // namespace grainreel
