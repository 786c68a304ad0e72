// A study runs one scene again and again with other values of some of its keys, reduces each run to some
// numbers, and draws charts of them. This header has its data. docs/guide/studies.md tells how a study is
// written.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/keys/keys.hpp"
#include "render/scene/axis_titles.hpp"

namespace grainreel {

constexpr const char* variant_axis = "variant";

using Seeds = std::vector<std::uint64_t>;

// One axis of the grid: a key of the scene and the values that it takes. The variants of a study are an axis
// too, the first one: its key is `variant_axis`, and its values are their names.
struct Variation {
    struct Value {
        std::string toml;   // the value in an assignment: 3 or "9 mm", quotes included; empty for a variant
        std::string words;  // for people: 9 mm, or the variant's name
        std::string place;  // in the study file, for messages
        double number = 0;  // in the axis' unit; used when the axis is numeric
        Assignments sets = {};  // the values that a variant gives to keys of the scene
        Seeds seeds = {};       // seeds of a variant that has its own
    };
    std::string key;    // "drive.g_level"
    std::string label;  // the key, unless the study has words for it
    std::string shown;  // what charts and pages call it: those words, or the key's name as films write it
    std::string place;
    std::vector<Value> values;
    bool numeric = false;  // all values are numbers, or quantities of the key's dimension
    std::string unit;      // unit of the numbers; empty for none

    // The assignments to the scene for the value with that number.
    Assignments assignments(std::size_t number) const;
    std::string title() const { return axis_title(shown, unit); }
};

// How a column of measures.csv becomes one number.
struct Reduction {
    // end: the last value. crossing: last_crossing(). deviation: deviation_of_values(). share: 1 where
    // first_passage() has a value, else 0.
    enum class Kind { end, mean, slope, crossing, first_passage, max, min, deviation, share };
    Kind kind = Kind::end;
    // s; the rows within this window count, ends included.
    double from = 0, to = std::numeric_limits<double>::infinity();
    double threshold = 0;  // SI

    bool has_threshold() const {
        return kind == Kind::crossing || kind == Kind::first_passage || kind == Kind::share;
    }
};

// What the values of the seeds of a setting are joined to.
enum class SeedAverage { mean, median, share };

// A number that each run is reduced to.
struct StudyMeasure {
    std::string name;  // name of its column in study.csv
    std::string label;
    std::string column;  // column of measures.csv
    Reduction reduction;
    std::string unit = {};         // of the number, on charts; empty for none
    std::string column_unit = {};  // of the column, and so of the threshold; empty for none
    SeedAverage average = SeedAverage::mean;
    std::string place = {};  // of its column in the study file, for messages
    bool from_zero = false;  // it cannot be negative, so its intervals are cut off at zero

    ShownUnit shown() const { return shown_unit(label, unit); }
    std::string title() const { return axis_title(label, shown().unit); }
};

struct StudyChart {
    std::string name;   // name of its files
    std::string title;  // may be empty
    std::size_t x = 0;  // index of the variation along x
    std::size_t y = 0;  // index of the measure along y
    bool log_x = false, log_y = false;
    std::string x_label, y_label;  // empty: what the key and the measure are called
    // Where the axes begin and end, in their units; none: by the points.
    std::optional<std::array<double, 2>> x_range, y_range;
    double x_per = 1;                 // in the unit of the key; x is divided by it
    std::string x_per_words;          // it as the study writes it, "2 mm"; empty for none
    std::vector<std::string> series;  // names of the series that are drawn, in this order; empty: all
    std::string series_place = {};    // in the study file, for messages
    std::string font = "DejaVu Sans";
    double letters = 8;                              // height of letters in points, on paper
    std::optional<std::filesystem::path> reference;  // a CSV file of points from elsewhere
    std::string reference_text = {};                 // its contents
    std::string reference_label;
};

// The study looks for the value of its one key at which a measure has a wanted value.
struct StudySearch {
    std::size_t measure = 0;
    double wanted = 0;         // in the measure's unit
    double within = 0;         // how narrow the bracket is to become, in the key's unit
    std::string written_unit;  // behind the key's values in the study file; empty for none
    std::string words;         // "angle = 24"
    std::optional<std::array<double, 3>> found = {};  // low end, estimate and high end so far
    std::string place;                                // in the study file, for messages
};

struct Study {
    std::filesystem::path file, scene;
    std::string text, scene_text;  // contents of these files as they were read
    bool shipped = false;          // these files are parts of the program
    std::string title;
    Assignments sets;           // assignments for every member
    Seeds seeds;                // empty: the scene's own
    bool one_stiffness = true;  // all members have the stiffness of the stiffest, where the plan chooses it
    std::vector<Variation> variations;
    std::optional<StudySearch> search;  // by values of variations[0], of which both ends are there at first
    std::vector<StudyMeasure> measures;
    std::vector<StudyChart> charts;

    // Adds a value of the key that is searched, in order of size.
    void try_value(double x);
    bool has_variants() const { return !variations.empty() && variations.front().key == variant_axis; }
    // The seeds of the setting with these values of the variations: those of its variant, or those of the
    // study. Empty: the scene's own seed is used.
    const Seeds& seeds_of(const std::vector<std::size_t>& at) const;
    // Number of members of that setting.
    std::size_t seed_count(const std::vector<std::size_t>& at) const;
    // Whether any setting has seeds, and whether any has several of them.
    bool has_seeds() const;
    bool has_intervals() const;
    // Whether any measure is joined over the seeds in that way.
    bool joins_by(SeedAverage average) const;
};

// The units in which a chart shows x and y, and the place of a number of the key along x.
ShownUnit unit_of_x(const Study& study, const StudyChart& chart);
ShownUnit unit_of_y(const Study& study, const StudyChart& chart);
double shown_x(const Study& study, const StudyChart& chart, double number);

// Reduces a column to one number. This function and those below depend on times and values alone.
//
// times: s, rising. values: SI units, as many. The result is NaN if no row lies in the window, or if the
// threshold is not reached. Values that are NaN are left out, except by Kind::end, for which the last value
// counts even if it is NaN.
double reduce(const Reduction& how, const std::vector<double>& times, const std::vector<double>& values);
// The time in s of the last finite value in the window; NaN for none. A passage that reduce() does not find
// comes later.
double last_time(const Reduction& how, const std::vector<double>& times, const std::vector<double>& values);

// The mean of values that are all finite; NaN for none.
double mean_of_values(const std::vector<double>& values);
// The standard deviation of the sample, with n - 1. NaN for fewer than two values.
double deviation_of_values(const std::vector<double>& values);
// The slope of the line of least squares, in 1/s times the value's unit: sum (t - mean t) (v - mean v) / sum
// (t - mean t)^2. NaN for fewer than two different times.
double slope_of(const std::vector<double>& times, const std::vector<double>& values);
// The time in s at which the values, joined by straight lines, first reach the threshold. If the first value
// is at the threshold, this is its time.
double first_passage(double threshold, const std::vector<double>& times, const std::vector<double>& values);
// The time in s at which the values cross the threshold for the last time; afterwards they stay on the side
// where they end. A value on the threshold counts as above it.
double last_crossing(double threshold, const std::vector<double>& times, const std::vector<double>& values);

}  // namespace grainreel
