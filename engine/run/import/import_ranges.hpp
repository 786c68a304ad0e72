// Between which values the grains of an imported run lie. Scenes of ours estimate that from drive and bed;
// files of other programs have neither, so the frames themselves are asked.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Which value 99 of 100 stay below, of any number of them in a little memory: sizes are counted by 100
// classes a power of ten, so that the answer is at most 2.4 % too large.
class TopOfMost {
  public:
    // value: not negative; other values do not count.
    void add(double value);
    // 0 where there was none, or where 99 of 100 are 0.
    double value() const;

  private:
    std::map<int, std::int64_t> classes_;
    std::int64_t all_ = 0;
};

class ImportRanges {
  public:
    ImportRanges(const Scene& scene, const FrameSupply& supply) : scene_(scene), supply_(supply) {}
    // Heights are those of the first frame that has grains.
    void add(const Frame& frame, const std::vector<Touch>& touches);
    // ranges.csv in the run's folder: quantity, low and high in SI. What the files say nothing of, and what
    // is 0 always, has no row. Throws RunError where it cannot be written.
    void write(const std::filesystem::path& folder) const;

  private:
    void add_heights(const Frame& frame);
    void add_forces(const Frame& frame, const std::vector<Touch>& touches);

    const Scene& scene_;
    FrameSupply supply_;
    TopOfMost speed_, rise_, spin_, energy_, force_;
    std::optional<std::array<double, 2>> heights_;
};

// The range of a quantity in a run's folder: "speed", "vertical-velocity", "start-height", "spin",
// "kinetic-energy" or "contact-force"; none where the run was not imported, or its files do not say.
std::optional<std::array<double, 2>> imported_range(const std::filesystem::path& run,
                                                    std::string_view quantity);

// Whether a run was imported and its files do not say this quantity, which is one of those above.
bool import_lacks(const std::filesystem::path& run, std::string_view quantity);

}  // namespace grainreel
