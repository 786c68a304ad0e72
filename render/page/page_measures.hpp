// The numbers of a page: its measures, with the columns that have a chart at first, and its fields.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/measure/measures.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct PageColumn {
    std::string name;   // name in measures.csv
    std::string label;  // in words
    std::string unit;   // SI; empty for pure numbers
    // The units that a chart may show, from the largest, with their sizes in SI. Empty for pure numbers.
    std::vector<std::pair<std::string, double>> units = {};
    bool smooth =
        false;  // its line is the mean over the last period, as in the film, with the rows faint behind
};

struct PageMeasures {
    std::vector<PageColumn> columns;    // all of measures.csv, in its order
    std::vector<std::size_t> charted;   // those of them that have a chart at first
    std::vector<std::size_t> rows;      // the rows that charts show as the page opens, evenly spread
    std::size_t time = 0;               // index of the column of time
    std::optional<std::size_t> cycles;  // index of the column of periods, where a line is smooth
};

// The indices of at most `most` out of so many rows, evenly spread, with the first and the last.
std::vector<std::size_t> spread_rows(std::size_t rows, std::size_t most);

constexpr std::size_t kMostRowsAtOnce = 2000;

// Chooses columns and charts, four charts at most. The film's plots come first, then the measures that
// usually matter. Labels and smoothing are the film's, in its language. A measure gets a chart only if its
// values change. Without a column of time nothing is charted.
PageMeasures page_measures(const FilmedScene& scene, const MeasureTable& table);

// The fields of a run as a page has them: in the plane that the film looks at, one byte for each cell and
// quantity.
//
// The bytes, before they are packed, are for Ny cells across and Nz in height (y fastest), Q quantities and R
// records:
//   Ny Nz bytes, the share of each cell that is inside the container, 255 for all of it;
//   then for each record and quantity Ny Nz bytes: 0 to 254 from the quantity's lowest value to its highest,
//   255 where there is none.
// render/page/html/fields.js reads them.
struct FieldQuantity {
    std::string name;   // "speed"
    std::string label;  // "speed of the flow"
    std::string unit;
    double low = 0, high = 0;  // range over all records
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
    std::vector<Record> records;  // the records that the page has
    std::size_t all_records = 0;
    std::vector<FieldQuantity> quantities;
    std::vector<std::uint8_t> packed;
    std::string why_not;  // a sentence, when the run has fields that the page lacks
    bool present() const { return !packed.empty(); }
};

constexpr std::size_t kMostFieldBytes = 1'000'000;  // bytes when packed

// The fields of fields.nc in a run's folder. A grid in three dimensions gives means over the depth. Empty
// when the run kept none.
PageFields page_fields(const FilmedScene& scene, const std::filesystem::path& folder);

}  // namespace grainreel
