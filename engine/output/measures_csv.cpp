#include "engine/output/measures_csv.hpp"

#include <iterator>

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel {

namespace {

// A name as a part of a column's name: quotes and separators of CSV would break the row.
std::string plain(const std::string& name) {
    std::string result = name;
    for (char& c : result) {
        if (c == ',' || c == '"' || c == '\n' || c == '\r') c = '_';
    }
    return result;
}

}  // namespace

MeasuresWriter::MeasuresWriter(const std::filesystem::path& path, const std::vector<std::string>& species)
    : file_(path), species_(species.size()) {
    std::string header =
        "step,time_s,phase_turns,cycles,kinetic_J,rotational_J,gravitational_J,elastic_J,"
        "wall_work_J,lost_J,centre_x_m,centre_y_m,centre_z_m";
    for (const std::string& name : species) {
        header += fmt::format(",{0}_centre_x_m,{0}_centre_y_m,{0}_centre_z_m,{0}_height_m", plain(name));
    }
    header += ",height_difference,lacey,contact_number,largest_overlap,floor_position_m\n";
    file_.write(header);
}

void MeasuresWriter::write(const Measures& m) {
    GRAINREEL_CHECK(m.species_centre.size() == species_ && m.species_height.size() == species_);
    fmt::memory_buffer row;
    auto out = std::back_inserter(row);
    fmt::format_to(out, "{},{},{},{}", m.step, m.time, m.phase, m.cycles);
    fmt::format_to(out, ",{},{},{},{},{},{}", m.kinetic, m.rotational, m.gravitational, m.elastic,
                   m.wall_work, m.lost);
    const Vec3& c = m.centre_of_mass;
    fmt::format_to(out, ",{},{},{}", c.x(), c.y(), c.z());
    for (std::size_t s = 0; s < species_; ++s) {
        const Vec3& centre = m.species_centre[s];
        fmt::format_to(out, ",{},{},{},{}", centre.x(), centre.y(), centre.z(), m.species_height[s]);
    }
    fmt::format_to(out, ",{},{},{},{},{}\n", m.height_difference, m.lacey, m.contact_number,
                   m.largest_overlap, m.floor_position);
    file_.write({row.data(), row.size()});
    ++rows_;
}

}  // namespace grainreel
