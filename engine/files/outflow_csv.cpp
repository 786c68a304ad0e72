#include "engine/files/outflow_csv.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "engine/base/clock.hpp"
#include "engine/base/csv.hpp"
#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

namespace {

constexpr const char* header = "time_s,id,type,radius,x,y,z,vx,vy,vz";

}  // namespace

OutflowWriter::OutflowWriter(const std::filesystem::path& path) : file_(path) {
    file_.write(fmt::format("{}\n", header));
}

OutflowWriter::Kept OutflowWriter::kept_until(const std::filesystem::path& path, double time) {
    std::ifstream file = read_plain(path);
    CsvRows rows(file, path);
    if (!rows.next() || !rows.ended() || rows.text() != header)
        throw UserError("{}: is missing, or has another first line than `{}`", path.string(), header);
    Kept kept{rows.bytes(), 0};
    while (rows.next() && rows.ended() && number_in(rows.cells().front().text).value_or(0) <= time) {
        kept.bytes = rows.bytes();
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

namespace {

constexpr double rounding = 1e-9;  // s, by which a time may differ after it was written and read

std::vector<double> column_called(const MeasureTable& table, const char* name,
                                  const std::filesystem::path& file) {
    if (!table.find(name)) throw UserError("{}: has no column {}", file.string(), name);
    return table.all(name);
}

}  // namespace

bool grains_leave(const Scene& scene) {
    return (scene.container.outlet && !scene.container.tray) || !scene.exits.empty();
}

OutflowSums::OutflowSums(const Scene& scene) {
    for (const Species& species : scene.species) densities_.push_back(species.density);
}

std::optional<OutflowSums> OutflowSums::read(const std::filesystem::path& file, const Scene& scene) {
    const auto [table, fault] = read_measures_file(file);
    if (!table) return std::nullopt;
    if (!fault.empty()) throw UserError("{}; film.outflow = false draws without it", fault);
    const std::vector<double> times = column_called(*table, "time_s", file),
                              types = column_called(*table, "type", file),
                              radii = column_called(*table, "radius", file);
    OutflowSums record(scene);
    const auto species = static_cast<double>(scene.species.size());
    for (std::size_t row = 0; row < times.size(); ++row) {
        const bool in_order = std::isfinite(times[row]) && (row == 0 || times[row] >= times[row - 1]);
        const bool known = types[row] >= 1 && types[row] <= species && types[row] == std::floor(types[row]);
        if (!in_order || !known || !(radii[row] > 0 && std::isfinite(radii[row])))
            throw UserError("{}:{}: is of another scene or damaged; film.outflow = false draws without it",
                            file.string(), row + 2);
        record.add(times[row], static_cast<std::int32_t>(types[row]) - 1, radii[row]);
    }
    return record;
}

void OutflowSums::add(double time, std::int32_t species, double radius) {
    const double volume = 4.0 / 3 * std::numbers::pi * math::cube(radius);
    const double before = mass_.empty() ? 0 : mass_.back();
    times_.push_back(time);
    mass_.push_back(before + volume * densities_.at(static_cast<std::size_t>(species)));
}

FlowedOut OutflowSums::until(double time) const {
    const auto after = std::upper_bound(times_.begin(), times_.end(), time + rounding);
    const std::ptrdiff_t gone = after - times_.begin();
    return {gone, gone > 0 ? mass_[gone - 1] : 0};
}

}  // namespace grainreel
