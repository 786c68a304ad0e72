// The data file, as atom_style sphere of LAMMPS and granular of LIGGGHTS read it.
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "engine/base/plain_file.hpp"
#include "engine/handover/start_state.hpp"

namespace grainreel {

namespace {

constexpr std::size_t kFlushAt = std::size_t{1} << 20;  // bytes

}  // namespace

void write_data_file(const std::filesystem::path& path, const CarriedScene& carried, const StartState& start,
                     std::size_t types) {
    TextFile file(path);
    fmt::memory_buffer text;
    const auto flush = [&](bool all) {
        if (!all && text.size() < kFlushAt) return;
        file.write({text.data(), text.size()});
        text.clear();
    };
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "handed over by grainreel; units si\n\n{} atoms\n{} atom types\n\n",
                   start.grains.size(), types);
    const char* names[] = {"xlo xhi", "ylo yhi", "zlo zhi"};
    for (int axis = 0; axis < 3; ++axis)
        fmt::format_to(out, "{} {} {}\n", carried.low[axis], carried.high[axis], names[axis]);
    fmt::format_to(out, "\nAtoms\n\n");
    for (const StartState::Grain& g : start.grains) {
        double x = g.position.x();
        if (carried.periodic) {  // read_data wants them inside
            const double depth = carried.high.x() - carried.low.x();
            x -= std::floor((x - carried.low.x()) / depth) * depth;
        }
        fmt::format_to(out, "{} {} {} {} {} {} {}\n", g.id, g.type, g.diameter, g.density, x, g.position.y(),
                       g.position.z());
        flush(false);
    }
    fmt::format_to(out, "\nVelocities\n\n");
    for (const StartState::Grain& g : start.grains) {
        fmt::format_to(out, "{} {} {} {} {} {} {}\n", g.id, g.velocity.x(), g.velocity.y(), g.velocity.z(),
                       g.spin.x(), g.spin.y(), g.spin.z());
        flush(false);
    }
    flush(true);
}

}  // namespace grainreel
