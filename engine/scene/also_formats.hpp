// Formats of other programs that a run can leave beside its own files ([output] also). The writers are in
// engine/files/frames/writers, which a scene does not know; a test holds that both lists are the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace grainreel {

inline constexpr std::array<std::string_view, 10> kAlsoFormats{
    "netcdf", "lammps-dump", "lammps-data", "xyz", "csv", "vtk", "stl", "gsd", "gltf", "blender"};

// Some of them, by their places in the list.
class AlsoFormats {
  public:
    bool any() const { return bits_ != 0; }
    bool has(std::size_t format) const { return (bits_ >> format & 1U) != 0; }
    void add(std::size_t format) { bits_ = static_cast<std::uint16_t>(bits_ | 1U << format); }
    bool operator==(const AlsoFormats&) const = default;

  private:
    std::uint16_t bits_ = 0;
    static_assert(kAlsoFormats.size() <= 16);
};

}  // namespace grainreel
