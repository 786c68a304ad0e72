// A study: one scene run again and again with other values of some of its keys, what is measured in each run,
// and the charts of that. docs/guide/studies.md tells how one is written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/app/study/results/reduction.hpp"

namespace grainreel {

// One axis of the grid: a key of the scene and the values that it takes.
struct Variation {
    struct Value {
        std::string toml;   // as an assignment takes it: 3 or "9 mm", quotes included
        std::string words;  // for people: 9 mm
        std::string place;  // in the study file, for messages
        double number = 0;  // in the axis' unit; where the axis is numeric
    };
    std::string key;    // "drive.g_level"
    std::string label;  // the key, unless the study has words for it
    std::string place;
    std::vector<Value> values;
    bool numeric = false;  // all values are numbers, or quantities of the key's dimension
    std::string unit;      // of the numbers; empty for none

    std::string title() const { return unit.empty() ? label : label + " (" + unit + ")"; }
};

// A number that each run is reduced to.
struct StudyMeasure {
    std::string name;  // of its column in study.csv
    std::string label;
    std::string column;  // of measures.csv
    Reduction reduction;
    std::string printed = {};  // the label on paper, with the unit; empty: the label
};

struct StudyChart {
    std::string name;   // of its files
    std::string title;  // may be empty
    std::size_t x = 0;  // of the variations
    std::size_t y = 0;  // of the measures
    bool log_x = false, log_y = false;
    std::optional<std::filesystem::path> reference;  // points from elsewhere, a CSV file
    std::string reference_label;
};

struct Study {
    std::filesystem::path file, scene;
    std::string text, scene_text;  // of these files, as they were read
    std::string title;
    Assignments sets;                  // for every member
    std::vector<std::uint64_t> seeds;  // empty: the scene's own
    std::vector<Variation> variations;
    std::vector<StudyMeasure> measures;
    std::vector<StudyChart> charts;

    std::size_t seed_count() const { return seeds.empty() ? 1 : seeds.size(); }
};

}  // namespace grainreel
