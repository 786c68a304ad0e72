// The ranges of speeds, heights, forces and other quantities in an imported run, for colour bars. For our own
// scenes they are estimated from drive and bed. Files of other programs have neither, so they are taken from
// the frames.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/frames/state_archive.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

// Finds the value that 99 of 100 values do not exceed. It needs little memory for any number of values.
// Values are counted in 100 classes for each power of ten, so the answer is at most 2.4 % too large.
class TopOfMost {
  public:
    // Adds a value. Negative values do not count.
    void add(double value);
    // 0 where there were no values, or where 99 of 100 are 0.
    double value() const;

  private:
    std::map<int, std::int64_t> classes_;
    std::int64_t all_ = 0;
};

// Collects the ranges frame by frame.
class ImportRanges {
  public:
    ImportRanges(const Scene& scene, const StateSupply& supply) : scene_(scene), supply_(supply) {}
    // Adds a frame. Heights are taken only from the first frame with grains.
    void add(const State& frame, const std::vector<Link>& touches);
    // Writes ranges.csv into the run's folder: quantity, low and high in SI. A quantity that is unknown or
    // always 0 has no row. Throws RunError where the file cannot be written.
    void write(const std::filesystem::path& folder) const;

  private:
    void add_heights(const State& frame);
    void add_forces(const State& frame, const std::vector<Link>& touches);

    const Scene& scene_;
    StateSupply supply_;
    TopOfMost speed_, rise_, spin_, energy_, force_;
    std::optional<std::array<double, 2>> heights_;
};

// The range of a quantity in a run's folder: "speed", "vertical-velocity", "start-height", "spin",
// "kinetic-energy" or "contact-force". None where the run was not imported or the quantity is unknown.
std::optional<std::array<double, 2>> imported_range(const std::filesystem::path& run,
                                                    std::string_view quantity);

// Whether a run was imported and this quantity is unknown in it. Always false for "start-height".
bool import_lacks(const std::filesystem::path& run, std::string_view quantity);

}  // namespace grainreel
