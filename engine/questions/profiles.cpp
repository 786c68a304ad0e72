#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/questions/columns/grain_columns.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/solid_fraction.hpp"
#include "engine/questions/statistics.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_bins = 10000;

struct Bin {
    std::int64_t grains = 0;
    double speed = 0, upward = 0;  // m/s, sums
    std::vector<double> volume;    // m3, by species
};

struct Bins {
    double low = 0, width = 0;  // m
    std::vector<Bin> bins;
    std::int64_t left_out = 0;  // grains
};

Bins bins_along(const Snapshot& s, const std::vector<double>& at, double low) {
    Bins all{low, s.bin(), {}, 0};
    for (std::size_t i = 0; i < at.size(); ++i) {
        const double place = std::floor((at[i] - low) / all.width);
        if (!(place >= 0 && place < static_cast<double>(most_bins))) {
            ++all.left_out;
            continue;
        }
        const auto k = static_cast<std::size_t>(place);
        while (all.bins.size() <= k)
            all.bins.push_back({0, 0, 0, std::vector<double>(s.scene.species.size(), 0)});
        Bin& bin = all.bins[k];
        ++bin.grains;
        bin.speed += s.frame.velocity[i].norm();
        bin.upward += s.frame.velocity[i].z();
        bin.volume[static_cast<std::size_t>(s.frame.species[i])] +=
            4.0 / 3.0 * std::numbers::pi * std::pow(s.frame.radius[i], 3);
    }
    return all;
}

// Empty of nothing.
AnswerCell ratio(double sum, double of) {
    if (of <= 0) return {};
    return sum / of;
}

std::vector<AnswerCell> row_of(const Bins& all, std::size_t k) {
    const Bin& bin = all.bins[k];
    const double edge = all.low + static_cast<double>(k) * all.width;
    const auto grains = static_cast<double>(bin.grains);
    const double solid = std::accumulate(bin.volume.begin(), bin.volume.end(), 0.0);
    std::vector<AnswerCell> row = {edge, edge + all.width, bin.grains, ratio(bin.speed, grains),
                                   ratio(bin.upward, grains)};
    for (const double volume : bin.volume) row.push_back(ratio(volume, solid));
    row.emplace_back(solid);
    return row;
}

// Up to the top of the highest grain, which may be in the bin above its centre's.
void add_bins_of_tops(const Snapshot& s, const std::vector<double>& at, Bins& all) {
    constexpr double hair = 1e-9;  // of a bin
    double highest = 0;            // bins
    for (std::size_t i = 0; i < at.size(); ++i) {
        const double top = (at[i] + s.frame.radius[i] - all.low) / all.width - hair;
        if (top < static_cast<double>(most_bins)) highest = std::max(highest, std::ceil(top));
    }
    const Bin empty{0, 0, 0, std::vector<double>(s.scene.species.size(), 0)};
    all.bins.resize(std::max(all.bins.size(), static_cast<std::size_t>(highest)), empty);
}

// Where the floor alone moves, heights above it are not heights in the container.
void add_solid_fraction(const Snapshot& s, const Bins& all, bool above_floor, AnswerTable& table) {
    table.columns.push_back({"solid_fraction", Dimension::number,
                             "volume of the parts of grains that are there, over the room in the container"});
    const double container = container_offset(s.scene, s.frame).z(),
                 zero = above_floor ? floor_offset(s.scene, s.frame).z() : 0;
    const std::vector<double> fractions =
        solid_fractions(s, all.low + zero - container, all.width, all.bins.size());
    for (std::size_t k = 0; k < fractions.size(); ++k) {
        AnswerCell& cell = table.rows[k].emplace_back();
        if (std::isfinite(fractions[k])) cell = fractions[k];
    }
}

}  // namespace

Answer profile_answer(const Snapshot& s, const std::string& along) {
    const std::vector<std::string> directions = {"height", "x", "y", "z", "r"};
    if (std::find(directions.begin(), directions.end(), along) == directions.end())
        throw UserError(fmt::format("'{}' is no direction; there are height, x, y, z and r", along));
    if (s.frame.size() == 0) throw UserError("there are no grains at this moment");
    const std::vector<double> at = values_of(s, column_called(s, along));
    const bool across = along == "x" || along == "y";
    // Edges are multiples of the width, so that those of several moments agree.
    const double width = s.bin();
    Bins all = bins_along(s, at, across ? std::floor(statistics_of(at).least / width) * width : 0);
    AnswerTable table{"profile",
                      fmt::format("Along {}, in bins of the mean diameter", along),
                      {{along + "_from", Dimension::length, "", AnswerColumn::kKey},
                       {along + "_to", Dimension::length, "", AnswerColumn::kKey},
                       {"grains", Dimension::number, "whose centre is there"},
                       {"mean_speed", Dimension::speed, "", "grains"},
                       {"mean_vz", Dimension::speed, "", "grains"}},
                      {},
                      true};
    for (const Species& species : s.scene.species)
        table.columns.push_back(
            {"share_" + species.name, Dimension::number, "of their solid volume", "solid_volume"});
    table.columns.push_back({"solid_volume", Dimension::number, "of these grains", "", "m3"});
    const bool in_container = s.scene.container.shape != Container::Shape::none;
    const bool upwards = in_container && (along == "height" || along == "z");
    if (upwards) add_bins_of_tops(s, at, all);
    for (std::size_t k = 0; k < all.bins.size(); ++k) table.rows.push_back(row_of(all, k));
    if (upwards) add_solid_fraction(s, all, along == "height", table);
    Answer answer{{std::move(table)}, {}};
    if (all.left_out > 0) answer.notes.push_back(fmt::format("{} grains lie outside the bins", all.left_out));
    return answer;
}

}  // namespace grainreel
