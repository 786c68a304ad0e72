#include "engine/output/outflow_csv.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "engine/base/error.hpp"

namespace grainreel {

OutflowWriter::OutflowWriter(const std::filesystem::path& path) : file_(path) {
    file_.write("time_s,id,type,radius,x,y,z,vx,vy,vz\n");
}

namespace {

// Bytes of header and whole rows up to that time, and how many rows these are.
std::pair<std::uintmax_t, std::int64_t> rows_until(const std::filesystem::path& path, double time) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line) || file.eof())
        throw UserError(fmt::format("{}: is missing, or has no header", path.string()));
    std::pair<std::uintmax_t, std::int64_t> kept{line.size() + 1, 0};
    while (std::getline(file, line) && !file.eof() && std::strtod(line.c_str(), nullptr) <= time) {
        kept.first += line.size() + 1;
        ++kept.second;
    }
    return kept;
}

}  // namespace

OutflowWriter::OutflowWriter(const std::filesystem::path& path, double time)
    : file_(path, rows_until(path, time).first), rows_(rows_until(path, time).second) {}

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
