#include "engine/questions/field_means.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/files/fields_file.hpp"
#include "engine/run/stored/stored_run.hpp"

namespace grainreel {
namespace {

// Whether a field is a mean over mass: what grains have, in place of what a volume has.
bool is_by_mass(const std::string& name) {
    return name.starts_with("velocity_") || name == "granular_temperature";
}

std::size_t place_of(const std::vector<std::string>& names, const std::string& name) {
    if (const auto place = place_in(names, name)) return *place;
    throw UserError("fields.nc has no '{}'", name);
}

// Sums of values times weights, and the means of them.
struct Sums {
    std::vector<double> sum, weight;

    explicit Sums(std::size_t cells) : sum(cells), weight(cells) {}
    void add(std::size_t cell, double value, double by) {
        if (!std::isfinite(value) || !(by > 0)) return;
        sum[cell] += value * by, weight[cell] += by;
    }
    std::vector<double> means() const {
        std::vector<double> all(sum.size(), kUnknown);
        for (std::size_t k = 0; k < all.size(); ++k)
            if (weight[k] > 0) all[k] = sum[k] / weight[k];
        return all;
    }
};

MeanFields mean_of_records(const FieldsReader& reader, const TimeWindow& window) {
    MeanFields mean;
    mean.middles = reader.middles();
    const std::vector<std::string>& names = reader.names();
    const std::size_t volume = place_of(names, "free_volume"), density = place_of(names, "density");
    std::vector<Sums> sums;
    for (std::size_t record = 0; record < reader.records(); ++record) {
        const auto [begin, end] = reader.span(record);
        const double rounding = 1e-6 * (end - begin);
        if (begin < window.from - rounding || end > window.to + rounding) continue;
        const std::vector<std::vector<double>> values = reader.read(record);
        const std::size_t cells = values[volume].size();
        if (sums.empty())
            sums.assign(names.size(), Sums(cells)), mean.from = begin, mean.volume = values[volume];
        for (std::size_t f = 0; f < names.size(); ++f)
            for (std::size_t k = 0; k < cells; ++k)
                sums[f].add(k, values[f][k], (end - begin) * (is_by_mass(names[f]) ? values[density][k] : 1));
        mean.to = end;
        ++mean.records;
    }
    // The share of a cell that lies just outside of a round wall is 0 but for rounding.
    const double largest =
        mean.volume.empty() ? 0 : *std::max_element(mean.volume.begin(), mean.volume.end());
    for (double& here : mean.volume)
        if (here < 1e-6 * largest) here = 0;
    for (std::size_t f = 0; f < sums.size(); ++f) {
        if (f == volume) continue;
        mean.names.push_back(names[f]);
        mean.values.push_back(sums[f].means());
    }
    return mean;
}

// The places of a cell; NaN along an axis without cells.
std::array<double, 3> middle_of(const MeanFields& fields, std::size_t cell) {
    std::array<double, 3> middle{kUnknown, kUnknown, kUnknown};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<double>& all = fields.middles[axis];
        if (all.empty()) continue;
        middle[axis] = all[cell % all.size()];
        cell /= all.size();
    }
    return middle;
}

Dimension dimension_of_field(const std::string& name) {
    if (name == "density") return Dimension::density;
    if (name.starts_with("velocity_")) return Dimension::speed;
    if (name.find("stress") != std::string::npos) return Dimension::pressure;
    return Dimension::number;
}

std::vector<AnswerCell> cells_of(const std::vector<double>& places,
                                 const std::vector<std::vector<double>>& values, std::size_t k) {
    std::vector<AnswerCell> row(places.begin(), places.end());
    for (const std::vector<double>& field : values)
        row.push_back(std::isfinite(field[k]) ? AnswerCell(field[k]) : AnswerCell());
    return row;
}

AnswerTable table_of(const char* name, const std::vector<std::string>& axes,
                     const std::vector<std::string>& names) {
    AnswerTable table{name, "Means of the fields", {}, {}};
    for (const std::string& axis : axes)
        table.columns.push_back({axis, Dimension::length, "middle of the cell"});
    for (const std::string& field : names) {
        table.columns.push_back({field, dimension_of_field(field), ""});
        if (field == "granular_temperature") table.columns.back().unit = "m2/s2";
    }
    return table;
}

AnswerTable table_as_kept(const MeanFields& fields) {
    std::vector<std::string> axes;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!fields.middles[axis].empty()) axes.emplace_back(1, "xyz"[axis]);
    AnswerTable table = table_of("fields", axes, fields.names);
    for (std::size_t k = 0; k < fields.volume.size(); ++k) {
        if (!(fields.volume[k] > 0)) continue;
        std::vector<double> places;
        for (const double place : middle_of(fields, k))
            if (!std::isnan(place)) places.push_back(place);
        table.rows.push_back(cells_of(places, fields.values, k));
    }
    return table;
}

AnswerTable table_of_rings(const RingFields& rings) {
    AnswerTable table = table_of("rings", {"r", "z"}, rings.names);
    for (std::size_t k = 0; k < rings.r.size(); ++k)
        table.rows.push_back(cells_of({rings.r[k], rings.z[k]}, rings.values, k));
    return table;
}

}  // namespace

const std::vector<double>& MeanFields::of(const std::string& name) const {
    return values[place_of(names, name)];
}

RingFields rings_of(const MeanFields& fields) {
    if (fields.middles[0].size() < 2 || fields.middles[1].size() < 2)
        throw UserError("rings need fields in three dimensions; write output.fields.grid = \"xyz\"");
    const std::vector<double>&x = fields.middles[0], &z = fields.middles[2];
    const double width = x[1] - x[0];
    const std::size_t across = (x.size() + 1) / 2 * 3 / 2 + 1;  // rings, up to the corners of the grid
    std::vector<Sums> sums(fields.names.size() + 1, Sums(across * z.size()));  // the last one: velocity_r
    Sums room(across * z.size());
    const std::vector<double>&density = fields.of("density"), &vx = fields.of("velocity_x"),
          &vy = fields.of("velocity_y");
    for (std::size_t k = 0; k < fields.volume.size(); ++k) {
        const auto place = middle_of(fields, k);
        const double r = math::hypot(place[0], place[1]);
        const std::size_t height = k / (x.size() * fields.middles[1].size());
        const std::size_t ring = height * across + std::min(across - 1, static_cast<std::size_t>(r / width));
        room.add(ring, 1, fields.volume[k]);
        const double mass = fields.volume[k] * density[k];
        for (std::size_t f = 0; f < fields.names.size(); ++f)
            sums[f].add(ring, fields.values[f][k], is_by_mass(fields.names[f]) ? mass : fields.volume[k]);
        if (r > 0) sums.back().add(ring, (place[0] * vx[k] + place[1] * vy[k]) / r, mass);
    }
    RingFields rings;
    std::vector<std::size_t> kept;  // what depends on directions across the axis has no mean over a ring
    for (std::size_t f = 0; f < fields.names.size(); ++f) {
        const std::string& name = fields.names[f];
        if (name == "velocity_x" || name == "velocity_y" || name.find("stress") != std::string::npos)
            continue;
        kept.push_back(f);
        rings.names.push_back(name);
    }
    kept.push_back(fields.names.size());
    rings.names.emplace_back("velocity_r");
    rings.values.resize(kept.size());
    for (std::size_t ring = 0; ring < room.weight.size(); ++ring) {
        if (!(room.weight[ring] > 0)) continue;
        rings.r.push_back((static_cast<double>(ring % across) + 0.5) * width);
        rings.z.push_back(z[ring / across]);
        for (std::size_t i = 0; i < kept.size(); ++i) {
            const Sums& all = sums[kept[i]];
            rings.values[i].push_back(all.weight[ring] > 0 ? all.sum[ring] / all.weight[ring] : kUnknown);
        }
    }
    return rings;
}

double turnover_time(const MeanFields& fields) {
    const std::vector<double>&z = fields.middles[2], &density = fields.of("density"),
          &vz = fields.of("velocity_z");
    if (z.size() < 2) return kUnknown;
    const double height = z[1] - z[0];
    std::vector<double> rising(z.size());  // kg/s
    double mass = 0;
    for (std::size_t k = 0; k < fields.volume.size(); ++k) {
        const double here = fields.volume[k] * density[k];
        if (!std::isfinite(here)) continue;
        mass += here;
        if (vz[k] > 0) rising[k / (fields.volume.size() / z.size())] += here * vz[k] / height;
    }
    const double most = *std::max_element(rising.begin(), rising.end());
    return most > 0 ? mass / most : kUnknown;
}

Answer fields_answer(const StoredRun& run, const std::string& grid, const TimeWindow& window) {
    std::error_code none_there;
    if (!std::filesystem::exists(run.path() / "fields.nc", none_there))
        throw UserError("{}: the run kept no fields; they need [output.fields] in its scene",
                        (run.path() / "fields.nc").string());
    const FieldsReader reader(run.path() / "fields.nc");
    const MeanFields mean = mean_of_records(reader, window);
    if (mean.records == 0)
        throw UserError(
            "no record of fields.nc lies within {:.6g} s to {}; there are {}, {:.6g} s to {:.6g} s",
            window.from, std::isfinite(window.to) ? fmt::format("{:.6g} s", window.to) : "the run's end",
            reader.records(), reader.records() > 0 ? reader.span(0)[0] : 0,
            reader.records() > 0 ? reader.span(reader.records() - 1)[1] : 0);
    AnswerTable span{"turnover",
                     "Mean flow",
                     {{"from", Dimension::time, ""},
                      {"to", Dimension::time, ""},
                      {"records", Dimension::number, ""},
                      {"turnover", Dimension::time, "in which as much mass rises as the bed has"}},
                     {}};
    const double turnover = turnover_time(mean);
    span.rows.push_back({mean.from, mean.to, static_cast<std::int64_t>(mean.records),
                         std::isfinite(turnover) ? AnswerCell(turnover) : AnswerCell()});
    Answer answer;
    answer.tables.push_back(std::move(span));
    answer.tables.push_back(grid == "rz" ? table_of_rings(rings_of(mean)) : table_as_kept(mean));
    return answer;
}

}  // namespace grainreel
