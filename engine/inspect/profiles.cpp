#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/nearest_name.hpp"
#include "engine/inspect/columns/grain_columns.hpp"
#include "engine/inspect/questions.hpp"
#include "engine/inspect/statistics.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_bins = 10000;

double mean_diameter(const Snapshot& s) {
    double sum = 0;
    for (const double radius : s.frame.radius) sum += 2 * radius;
    return sum / static_cast<double>(s.frame.size());
}

int column_called(const Snapshot& s, const std::string& name) {
    const GrainVocabulary words(s);
    const auto word = words.find(name);
    if (word && word->column >= 0) return word->column;
    std::vector<std::string> names;
    for (const GrainColumn& column : grain_columns()) names.push_back(column.name);
    const std::optional<std::string> meant = nearest_name(name, names);
    throw UserError(fmt::format("'{}' is no quantity of a grain{}", name,
                                meant ? fmt::format("; did you mean '{}'?", *meant) : ""));
}

void check_grains(const Snapshot& s) {
    if (s.frame.size() == 0) throw UserError("there are no grains at this moment");
}

std::vector<double> along_axis(const Snapshot& s, const std::string& along) {
    return values_of(s, column_called(s, along));
}

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
    Bins all{low, mean_diameter(s), {}, 0};
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

}  // namespace

Answer profile_answer(const Snapshot& s, const std::string& along) {
    const std::vector<std::string> directions = {"height", "x", "y", "z", "r"};
    if (std::find(directions.begin(), directions.end(), along) == directions.end())
        throw UserError(fmt::format("'{}' is no direction; there are height, x, y, z and r", along));
    check_grains(s);
    const std::vector<double> at = along_axis(s, along);
    const bool across = along == "x" || along == "y";
    // Edges are multiples of the width, so that those of several moments agree.
    const double width = mean_diameter(s);
    const Bins all = bins_along(s, at, across ? std::floor(statistics_of(at).least / width) * width : 0);
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
    table.columns.push_back({"solid_volume", Dimension::number, "of these grains, m3"});
    for (std::size_t k = 0; k < all.bins.size(); ++k) table.rows.push_back(row_of(all, k));
    Answer answer{{std::move(table)}, {}};
    if (all.left_out > 0) answer.notes.push_back(fmt::format("{} grains lie outside the bins", all.left_out));
    return answer;
}

Answer histogram_answer(const Snapshot& s, const std::string& name, std::size_t bins) {
    check_grains(s);
    const int number = column_called(s, name);
    const GrainColumn& column = grain_columns()[static_cast<std::size_t>(number)];
    if (column.is_species) throw UserError("species have no order; ask for a quantity, as in \"speed\"");
    const std::vector<double> values = values_of(s, number);
    const Statistics all = statistics_of(values);
    if (all.count == 0) throw UserError(fmt::format("no grain has a '{}' at this moment", name));
    const double width = (all.most - all.least) / static_cast<double>(bins);
    std::vector<std::vector<std::int64_t>> counts(bins, std::vector<std::int64_t>(s.scene.species.size(), 0));
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) continue;
        const double place = width > 0 ? (values[i] - all.least) / width : 0;
        const std::size_t k = std::min(bins - 1, static_cast<std::size_t>(place));
        ++counts[k][static_cast<std::size_t>(s.frame.species[i])];
    }
    AnswerTable table{"histogram",
                      fmt::format("How many grains have which {}", name),
                      {{name + "_from", column.dimension, ""}, {name + "_to", column.dimension, ""}},
                      {}};
    for (const Species& species : s.scene.species)
        table.columns.push_back({"grains_" + species.name, Dimension::number, ""});
    for (std::size_t k = 0; k < bins; ++k) {
        std::vector<AnswerCell> row = {
            all.least + static_cast<double>(k) * width,
            k + 1 == bins ? all.most : all.least + static_cast<double>(k + 1) * width};
        for (const std::int64_t count : counts[k]) row.emplace_back(count);
        table.rows.push_back(std::move(row));
    }
    return {{std::move(table)}, {}};
}

}  // namespace grainreel
