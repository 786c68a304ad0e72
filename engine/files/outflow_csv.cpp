#include "engine/files/outflow_csv.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace {

constexpr const char* header = "time_s,id,type,radius,x,y,z,vx,vy,vz";

}  // namespace

OutflowWriter::OutflowWriter(const std::filesystem::path& path) : file_(path) {
    file_.write(fmt::format("{}\n", header));
}

OutflowWriter::Kept OutflowWriter::kept_until(const std::filesystem::path& path, double time) {
    std::ifstream file = read_plain(path);
    std::string line;
    if (!std::getline(file, line) || file.eof() || line != header)
        throw UserError(
            fmt::format("{}: is missing, or has another first line than `{}`", path.string(), header));
    Kept kept{line.size() + 1, 0};
    while (std::getline(file, line) && !file.eof() && std::strtod(line.c_str(), nullptr) <= time) {
        kept.bytes += line.size() + 1;
        ++kept.rows;
    }
    return kept;
}

OutflowWriter::OutflowWriter(const std::filesystem::path& path, double time)
    : OutflowWriter(path, kept_until(path, time)) {}

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
