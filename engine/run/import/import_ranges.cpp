#include "engine/run/import/import_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "engine/base/csv.hpp"
#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr const char* ranges_name = "ranges.csv";
constexpr double classes_a_power = 100;  // classes for each power of ten
constexpr int no_size = -1'000'000;      // the class of the value 0

// The kinetic energy in J of translation and rotation, with 2/5 m r2 for a solid sphere.
double energy_of(const State& frame, std::size_t i, const Scene& scene) {
    const double r = frame.radius[i];
    const double mass = mass_of(frame, i, scene.species[frame.species[i]].density);
    return 0.5 * mass * (frame.velocity[i].squaredNorm() + 0.4 * r * r * frame.spin[i].squaredNorm());
}

// A value rounded up to two digits, so that a colour bar has round ends.
double rounded_up(double value) {
    if (!(value > 0)) return 0;
    const double unit = math::pow(10, std::floor(math::log10(value)) - 1);
    return std::ceil(value / unit - 1e-9) * unit;
}

std::string range_row(const char* quantity, double low, double high) {
    return low < high && std::isfinite(low) && std::isfinite(high)
               ? fmt::format("{},{:.6g},{:.6g}\n", quantity, low, high)
               : "";
}

}  // namespace

void TopOfMost::add(double value) {
    if (!(value >= 0) || !std::isfinite(value)) return;
    ++classes_[value > 0 ? static_cast<int>(std::floor(classes_a_power * math::log10(value))) : no_size];
    ++all_;
}

double TopOfMost::value() const {
    std::int64_t below = 0;
    for (const auto& [size, count] : classes_) {
        below += count;
        if (100 * below >= 99 * all_)
            return size == no_size ? 0 : math::pow(10, (size + 1) / classes_a_power);
    }
    return 0;
}

void ImportRanges::add(const State& frame, const std::vector<Link>& touches) {
    if (!heights_ && frame.size() > 0) add_heights(frame);
    if (supply_.contacts) add_forces(frame, touches);
    if (!supply_.velocities) return;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        speed_.add(frame.velocity[i].norm());
        rise_.add(std::abs(frame.velocity[i].z()));
        spin_.add(frame.spin[i].norm());
        energy_.add(energy_of(frame, i, scene_));
    }
}

void ImportRanges::add_heights(const State& frame) {
    heights_ = {frame.position[0].z(), frame.position[0].z()};
    for (const Vec3& place : frame.position) {
        (*heights_)[0] = std::min((*heights_)[0], place.z());
        (*heights_)[1] = std::max((*heights_)[1], place.z());
    }
    for (double& height : *heights_) height -= frame.floor().place.z();
}

void ImportRanges::add_forces(const State& frame, const std::vector<Link>& touches) {
    std::vector<double> forces(frame.size(), 0.0);
    const auto add = [&](std::int32_t id, double force) {
        if (const auto row = frame.row_of(id)) forces[*row] += force;
    };
    for (const Link& touch : touches) {
        add(touch.first, touch.force);
        if (touch.second >= 0) add(touch.second, touch.force);
    }
    for (const double force : forces) force_.add(force);
}

void ImportRanges::write(const fs::path& folder) const {
    std::string text = "quantity,low,high\n";
    text += range_row("speed", 0, rounded_up(speed_.value()));
    const double rise = rounded_up(rise_.value());
    text += range_row("vertical-velocity", -rise, rise);
    if (heights_) text += range_row("start-height", (*heights_)[0], (*heights_)[1]);
    text += range_row("spin", 0, rounded_up(spin_.value()));
    text += range_row("kinetic-energy", 0, rounded_up(energy_.value()));
    text += range_row("contact-force", 0, rounded_up(force_.value()));
    std::ofstream out(folder / ranges_name, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw RunError("{}: cannot be written; is the disk full?", (folder / ranges_name).string());
}

std::optional<std::array<double, 2>> imported_range(const fs::path& run, std::string_view quantity) {
    std::ifstream in = read_plain(run / ranges_name);
    CsvRows rows(in, run / ranges_name);
    while (rows.next()) {
        const std::vector<CsvCell>& cells = rows.cells();
        if (cells.size() != 3 || cells[0].text != quantity) continue;
        const std::optional<double> low = number_in(cells[1].text), high = number_in(cells[2].text);
        if (low && high && *low < *high) return std::array{*low, *high};
    }
    return std::nullopt;
}

bool import_lacks(const fs::path& run, std::string_view quantity) {
    constexpr std::array from_frames = {"speed", "vertical-velocity", "spin", "kinetic-energy",
                                        "contact-force"};
    return is_there(run / ranges_name) && contains(from_frames, quantity) && !imported_range(run, quantity);
}

}  // namespace grainreel
