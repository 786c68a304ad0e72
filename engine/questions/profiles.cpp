// How grains are spread in a bed: profiles along a column, with the solid fraction of each bin, and the
// radial distribution of pairs. questions.hpp declares both questions.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/questions/expressions/grain_columns.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/statistics.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

constexpr std::size_t most_bins = 10000;

struct Bin {
    std::int64_t grains = 0;
    double speed = 0, upward = 0;  // m/s, sums over the grains whose velocity is known
    std::int64_t known = 0;        // number of these
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
            all.bins.push_back({0, 0, 0, 0, std::vector<double>(s.scene.species.size(), 0)});
        Bin& bin = all.bins[k];
        ++bin.grains;
        if (s.frame.velocity[i].allFinite()) {
            ++bin.known;
            bin.speed += s.frame.velocity[i].norm();
            bin.upward += s.frame.velocity[i].z();
        }
        bin.volume[s.frame.species[i]] += 4.0 / 3.0 * std::numbers::pi * math::cube(s.frame.radius[i]);
    }
    return all;
}

// The ratio as a cell, empty where `of` is 0.
AnswerCell ratio(double sum, double of) {
    if (of <= 0) return {};
    return sum / of;
}

std::vector<AnswerCell> row_of(const Bins& all, std::size_t k) {
    const Bin& bin = all.bins[k];
    const double edge = all.low + static_cast<double>(k) * all.width;
    const auto known = static_cast<double>(bin.known);
    const double solid = std::accumulate(bin.volume.begin(), bin.volume.end(), 0.0);
    std::vector<AnswerCell> row = {edge, edge + all.width, bin.grains, ratio(bin.speed, known),
                                   ratio(bin.upward, known)};
    for (const double volume : bin.volume) row.push_back(ratio(volume, solid));
    row.emplace_back(solid);
    return row;
}

// Adds bins up to the top of the highest grain, which may lie in a higher bin than its centre.
void add_bins_of_tops(const Snapshot& s, const std::vector<double>& at, Bins& all) {
    constexpr double hair = 1e-9;  // as a share of a bin
    double highest = 0;            // in bins
    for (std::size_t i = 0; i < at.size(); ++i) {
        const double top = (at[i] + s.frame.radius[i] - all.low) / all.width - hair;
        if (top < static_cast<double>(most_bins)) highest = std::max(highest, std::ceil(top));
    }
    const Bin empty{0, 0, 0, 0, std::vector<double>(s.scene.species.size(), 0)};
    all.bins.resize(std::max(all.bins.size(), static_cast<std::size_t>(highest)), empty);
}

// Volume (m3) of the part below `height` of a sphere of this radius about height 0: pi r^3 (2 + 3 t - t^3)
// / 3 with t = height / r (a spherical segment; Bronshtein and Semendyayev, 3.3.4.6).
double sphere_below(double radius, double height) {
    const double t = std::clamp(height / radius, -1.0, 1.0);
    return std::numbers::pi / 3 * radius * radius * radius * (2 + 3 * t - t * t * t);
}

// Divides the bed from `low` up (m, in the container's frame) into `count` slices of equal height. Returns
// for each slice the volume of its grains divided by the volume inside the container; NaN where that is 0
// (below the floor, above the rim, in empty space). Grains that are glued to walls do not count.
std::vector<double> solid_fractions(const Snapshot& s, double low, double height, std::size_t count) {
    std::vector<double> fractions(count, kUnknown);
    const Container& container = s.scene.container;
    if (container.shape == Container::Shape::none) return fractions;
    // The edge of a slice, limited to the container.
    const auto edge = [&](std::size_t k) {
        return std::clamp(low + static_cast<double>(k) * height, container.base(), container.height);
    };
    std::vector<double> solid(count, 0);
    for (std::size_t i = 0; i < s.frame.size(); ++i) {
        const double z = (s.frame.position[i] - container_offset(s.scene, s.frame)).z(),
                     r = s.frame.radius[i];
        const double first = std::floor((z - r - low) / height), last = std::floor((z + r - low) / height);
        const double most = static_cast<double>(count) - 1;
        if (!(last >= 0 && first <= most)) continue;
        const auto from = static_cast<std::size_t>(std::max(first, 0.0)),
                   to = static_cast<std::size_t>(std::min(last, most));
        for (std::size_t k = from; k <= to; ++k)
            solid[k] += sphere_below(r, edge(k + 1) - z) - sphere_below(r, edge(k) - z);
    }
    for (std::size_t k = 0; k < count; ++k) {
        const double room = container.volume_below(edge(k + 1)) - container.volume_below(edge(k));
        if (room > 0) fractions[k] = solid[k] / room;
    }
    return fractions;
}

// Adds the column of solid fractions. Where the floor alone moves, heights above it are not heights in the
// container.
void add_solid_fraction(const Snapshot& s, const Bins& all, bool above_floor, AnswerTable& table) {
    table.columns.push_back(
        {"solid_fraction", Dimension::number,
         "volume of the parts of grains that are there, divided by the room in the container"});
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
    if (!contains(directions, along))
        throw UserError("'{}' is no direction; there are height, x, y, z and r", along);
    if (s.frame.size() == 0) throw UserError("there are no grains at this moment");
    const std::vector<double> at = values_of(s, column_called(s, along));
    const bool across = along == "x" || along == "y";
    // Edges are multiples of the width, so those of several moments agree.
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
    if (all.left_out > 0)
        answer.notes.push_back(fmt::format("outside the bins: {}", counted(all.left_out, "grain")));
    return answer;
}

namespace {

constexpr double farthest = 4;         // mean diameters
constexpr std::size_t bin_count = 80;  // number of bins up to `farthest`

struct Box {
    Vec3 low, high;
};

Box box_of(const Snapshot& s, double period) {
    Box box{s.frame.position.front(), s.frame.position.front()};
    for (const Vec3& at : s.frame.position) {
        box.low = box.low.cwiseMin(at);
        box.high = box.high.cwiseMax(at);
    }
    if (period > 0) box.low.x() = -0.5 * period, box.high.x() = 0.5 * period;
    return box;
}

// Distance (m) to the nearest face of the box; a periodic depth has none.
double room_about(const Vec3& at, const Box& box, double period) {
    double room =
        std::min({at.y() - box.low.y(), box.high.y() - at.y(), at.z() - box.low.z(), box.high.z() - at.z()});
    if (period == 0) room = std::min({room, at.x() - box.low.x(), box.high.x() - at.x()});
    return room;
}

// Centres sorted into cells, those of one cell one after the other. A cell is narrower than the reach,
// because then fewer centres are looked at that are too far away.
class Neighbourhood {
  public:
    Neighbourhood(const Snapshot& s, const Box& box, double reach, double period)
        : low_(box.low), reach_(reach), period_(period) {
        const Vec3 size = box.high - box.low;
        constexpr double most_cells = 1 << 20;
        double width = reach / kParts;
        while ((size / width).array().ceil().max(1).prod() > most_cells) width *= 2;
        for (int a = 0; a < 3; ++a) {
            count_[a] = std::max(1, static_cast<int>(size[a] / width));
            width_[a] = size[a] / count_[a];
            spread_[a] = static_cast<int>(std::ceil(reach / width_[a]));
        }
        sort(s.frame.position);
    }

    std::size_t size() const { return at_.size(); }
    // The place of centre k; centres are numbered in the order of the cells.
    const Vec3& place(std::size_t k) const { return at_[k]; }

    // Calls look(k, distance) for each centre that is nearer to centre i than the reach and comes after it.
    template <class Look>
    void after(std::size_t i, const Look& look) const {
        const std::array<int, 3> here = cell_of(at_[i]);
        const bool round = period_ > 0;
        const bool whole = round && 2 * spread_[0] + 1 >= count_[0];
        const int x_from = whole ? 0 : here[0] - spread_[0],
                  x_to = whole ? count_[0] - 1 : here[0] + spread_[0];
        for (int x = x_from; x <= x_to; ++x) {
            if (!round && (x < 0 || x >= count_[0])) continue;
            const int column = round ? (x + count_[0]) % count_[0] : x;
            for (int y = std::max(0, here[1] - spread_[1]);
                 y <= std::min(count_[1] - 1, here[1] + spread_[1]); ++y) {
                // Cells along z follow each other.
                const std::size_t from = start_[cell({column, y, std::max(0, here[2] - spread_[2])})];
                const std::size_t to =
                    start_[cell({column, y, std::min(count_[2] - 1, here[2] + spread_[2])}) + 1];
                for (std::size_t k = std::max(from, i + 1); k < to; ++k) {
                    Vec3 apart = at_[k] - at_[i];
                    if (round) apart.x() = nearest_image(apart.x(), period_);
                    const double square = apart.squaredNorm();
                    if (square < reach_ * reach_) look(k, std::sqrt(square));
                }
            }
        }
    }

  private:
    static constexpr int kParts = 3;  // about so many cells are as long as the reach

    void sort(const std::vector<Vec3>& places) {
        std::vector<std::size_t> own;
        start_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2] + 1, 0);
        for (const Vec3& at : places) {
            own.push_back(cell(cell_of(at)));
            ++start_[own.back() + 1];
        }
        for (std::size_t k = 1; k < start_.size(); ++k) start_[k] += start_[k - 1];
        std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
        at_.resize(places.size());
        for (std::size_t i = 0; i < places.size(); ++i) at_[next[own[i]]++] = places[i];
    }
    std::array<int, 3> cell_of(const Vec3& at) const {
        std::array<int, 3> cell{};
        for (int a = 0; a < 3; ++a) {
            double from = at[a] - low_[a];
            if (a == 0 && period_ > 0) from = nearest_image(at[a], period_) - low_[a];
            cell[a] = std::clamp(static_cast<int>(from / width_[a]), 0, count_[a] - 1);
        }
        return cell;
    }
    std::size_t cell(const std::array<int, 3>& at) const {
        return (static_cast<std::size_t>(at[0]) * count_[1] + at[1]) * count_[2] + at[2];
    }

    const Vec3 low_;
    const double reach_, period_;            // m
    std::array<int, 3> count_{}, spread_{};  // cells along an axis, and on either side within the reach
    Vec3 width_;                             // m
    std::vector<std::size_t> start_;         // index in at_ where each cell begins, and one past the last
    std::vector<Vec3> at_;                   // m
};

}  // namespace

Answer pair_distribution_answer(const Snapshot& s) {
    if (s.frame.size() < 2) throw UserError("there are fewer than two grains at this moment");
    const double period = period_of_depth(s.scene.container);
    const double most = farthest * s.bin(), width = most / static_cast<double>(bin_count);
    const Box box = box_of(s, period);
    const double volume = (box.high - box.low).prod();
    if (!(volume > 0))
        throw UserError("the grains lie in one plane; the distribution needs a bed of some depth");
    const double density = static_cast<double>(s.frame.size()) / volume;
    const Neighbourhood near(s, box, most, period);
    std::vector<double> pairs(bin_count + 1, 0), centres(bin_count, 0);
    std::vector<std::size_t> whole(near.size());  // by centre: number of bins whose spheres lie in the box
    for (std::size_t i = 0; i < near.size(); ++i) {
        const double room = room_about(near.place(i), box, period);
        whole[i] = static_cast<std::size_t>(std::clamp(room / width, 0.0, double(bin_count)));
        for (std::size_t k = 0; k < whole[i]; ++k) ++centres[k];
    }
    for (std::size_t i = 0; i < near.size(); ++i)
        near.after(i, [&](std::size_t other, double distance) {
            const auto k = static_cast<std::size_t>(distance / width);
            pairs[k] += (k < whole[i]) + (k < whole[other]);
        });
    AnswerTable table{"pair_distribution",
                      "Radial distribution of the centres, against a uniform bed in the box about all grains",
                      {{"r_from", Dimension::length, "", AnswerColumn::kKey},
                       {"r_to", Dimension::length, "", AnswerColumn::kKey},
                       {"g", Dimension::number, "", "centres"},
                       {"centres", Dimension::number, "that are so far from the surface of the box"}},
                      {},
                      true};
    for (std::size_t k = 0; k < bin_count; ++k) {
        const double from = static_cast<double>(k) * width, to = from + width;
        const double shell = 4.0 / 3.0 * std::numbers::pi * (to * to * to - from * from * from);
        AnswerCell g;
        if (centres[k] > 0) g = pairs[k] / (centres[k] * density * shell);
        table.rows.push_back({from, to, g, static_cast<std::int64_t>(centres[k])});
    }
    return {{std::move(table)}, {}};
}

}  // namespace grainreel
