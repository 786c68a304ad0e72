#include "engine/output/outflow_csv.hpp"

#include <fmt/format.h>

#include <iterator>

namespace grainreel {

OutflowWriter::OutflowWriter(const std::filesystem::path& path) : file_(path) {
    file_.write("time_s,id,type,radius,x,y,z,vx,vy,vz\n");
}

void OutflowWriter::write(const std::vector<Departure>& gone, const Clock& clock) {
    if (gone.empty()) return;
    fmt::memory_buffer text;
    for (const Departure& one : gone) {
        const Vec3 &x = one.position, &v = one.velocity;
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{}\n", clock.time(one.step),
                       one.id, one.species + 1, one.radius, x.x(), x.y(), x.z(), v.x(), v.y(), v.z());
    }
    file_.write({text.data(), text.size()});
    rows_ += std::ssize(gone);
}

}  // namespace grainreel
