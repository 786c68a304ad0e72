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

constexpr const char* variant_axis = "variant";

using Seeds = std::vector<std::uint64_t>;

// One axis of the grid: a key of the scene and the values that it takes. The variants of a study are an axis
// too, the first one: its key is `variant_axis`, and its values are their names.
struct Variation {
    struct Value {
        std::string toml;   // as an assignment takes it: 3 or "9 mm", quotes included; empty for a variant
        std::string words;  // for people: 9 mm, or the variant's name
        std::string place;  // in the study file, for messages
        double number = 0;  // in the axis' unit; where the axis is numeric
        Assignments sets = {};  // what a variant gives the scene
        Seeds seeds = {};       // of a variant that has its own
    };
    std::string key;    // "drive.g_level"
    std::string label;  // the key, unless the study has words for it
    std::string place;
    std::vector<Value> values;
    bool numeric = false;  // all values are numbers, or quantities of the key's dimension
    std::string unit;      // of the numbers; empty for none

    // What the value of that number gives the scene.
    Assignments assignments(std::size_t number) const;
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
    Assignments sets;  // for every member
    Seeds seeds;       // empty: the scene's own
    std::vector<Variation> variations;
    std::vector<StudyMeasure> measures;
    std::vector<StudyChart> charts;

    bool has_variants() const { return !variations.empty() && variations.front().key == variant_axis; }
    // The seeds of a setting, which has these values of the variations: those of its variant, or the
    // study's. Empty: the scene's own.
    const Seeds& seeds_of(const std::vector<std::size_t>& at) const;
    // How many members that setting has.
    std::size_t seed_count(const std::vector<std::size_t>& at) const;
    // Whether any setting has seeds, and whether one has several.
    bool has_seeds() const;
    bool has_intervals() const;
};

}  // namespace grainreel
