// Observers of segregation: each class gives columns of measures.csv, by the formulas of segregation.hpp and
// unlike_neighbours.hpp.
#pragma once

#include <fmt/format.h>
#include <algorithm>
#include <numeric>
#include <string>

#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/measure/segregation/unlike_neighbours.hpp"

namespace grainreel::observers {

// Why a scene has no values that compare two species; empty where it may have some.
inline std::string without_two_kinds(const Scene& scene) {
    return scene.species.size() > 1 ? "" : "it compares two species, and the scene has one";
}

// Why Lacey's index has no value at any moment: a kind is too rare. Empty where it may have one, and where
// grains come or leave, so that shares change.
inline std::string with_few_of_a_kind(const Scene& scene) {
    const BigAndSmall kinds = big_and_small(scene.species);
    std::int64_t all = 0;
    for (const Species& species : scene.species) all += species.count;
    const bool stays = scene.feeds.empty() && scene.exits.empty() && !scene.container.outlet;
    if (all == 0 || !stays || scene.start.method == Start::Method::file) return "";
    const std::int64_t big = scene.species[kinds.big].count, rare = std::min(big, all - big);
    const double in_sample = static_cast<double>(rare) / static_cast<double>(all) *
                             grains_per_sample(static_cast<std::size_t>(all));
    if (in_sample >= kLeastOfRareKind) return "";
    return fmt::format(
        "{} of {} grains are {:.2g} in a sample of {:.0f}, and it needs {:g}; take height_difference, "
        "big_above_small or unlike_neighbours",
        rare, all, in_sample, grains_per_sample(static_cast<std::size_t>(all)), kLeastOfRareKind);
}

// Observer of the height of big grains above small ones.
class HeightDifference final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"height_difference", "height of big − small, in bed heights"}},
                 "1",
                 "`NAME_height_m` of the species of the largest mean diameter minus that of the smallest, "
                 "divided by the height above the floor below which 95 % of all centres lie; if all species "
                 "are equal in size, the first minus the second"}};
    }
    static std::string why_empty(const Scene& scene, const std::string&) { return without_two_kinds(scene); }
    void look(const ObservedState& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return add_no_values(row, 1);
        const BigAndSmall kinds = big_and_small(m.scene.species);
        const std::vector<double> mean = mean_heights(m.grains, m.scene.species.size(), m.floor_height());
        std::vector<double> heights = heights_above(m.grains, m.floor_height());
        row.push_back((mean[kinds.big] - mean[kinds.small]) / bed_height(heights));
    }
};

// Observer of the probability that a big grain lies above a small one.
class BigAboveSmall final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"big_above_small", "P(big above small)"}},
                 "1",
                 "probability that a grain of the largest species lies above one of the smallest: 0 all "
                 "below, 1/2 mixed, 1 all above"}};
    }
    static std::string why_empty(const Scene& scene, const std::string&) { return without_two_kinds(scene); }
    void look(const ObservedState& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return add_no_values(row, 1);
        const BigAndSmall kinds = big_and_small(m.scene.species);
        std::vector<double> big = heights_above(m.grains, m.floor_height(), kinds.big);
        std::vector<double> small = heights_above(m.grains, m.floor_height(), kinds.small);
        row.push_back(share_above(big, small));
    }
};

// Observer of the shares of big grains at the top and at the bottom of the bed.
class BigInQuarters final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"big_in_top_quarter", "share of big grains in the top quarter"}},
                 "1",
                 "share of the largest species' grains whose centres lie above 3/4 of the bed's height"},
                {{{"big_in_bottom_quarter", "share of big grains in the bottom quarter"}},
                 "1",
                 "the same below 1/4 of it"}};
    }
    static std::string why_empty(const Scene& scene, const std::string&) { return without_two_kinds(scene); }
    void look(const ObservedState& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return add_no_values(row, 2);
        const BigAndSmall kinds = big_and_small(m.scene.species);
        const std::vector<double> big = heights_above(m.grains, m.floor_height(), kinds.big);
        std::vector<double> all = heights_above(m.grains, m.floor_height());
        const double bed = bed_height(all), count = static_cast<double>(big.size());
        const auto higher = std::count_if(big.begin(), big.end(), [&](double h) { return h > 0.75 * bed; });
        const auto lower = std::count_if(big.begin(), big.end(), [&](double h) { return h < 0.25 * bed; });
        row.insert(row.end(), {static_cast<double>(higher) / count, static_cast<double>(lower) / count});
    }
};

// Observer of the shares of big grains beside the left and right walls.
class BigAtWalls final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"big_at_walls", "share of big grains at the walls"}},
             "1",
             "share of the largest species' grains beside the left or right wall or slant, or a cylinder's "
             "wall: no grain of the smallest mean diameter fits between"}};
    }
    static std::string why_empty(const Scene& scene, const std::string&) {
        if (scene.species.size() > 1 && !SideWalls(scene).any()) return "the container has no side walls";
        return without_two_kinds(scene);
    }
    BigAtWalls(const Scene& scene, const Plan&) : walls_(scene) {}

    void look(const ObservedState& m, std::vector<double>& row) override {
        if (!m.has_two_kinds() || !walls_.any()) return add_no_values(row, 1);
        const auto big = static_cast<std::int32_t>(big_and_small(m.scene.species).big);
        double beside = 0, all = 0;
        for (std::size_t i = 0; i < m.grains.size(); ++i) {
            if (m.grains.species[i] != big) continue;
            all += 1;
            beside += walls_.side_of(m.grains.place[i], m.pose) != Side::none;
        }
        row.push_back(beside / all);
    }

  private:
    const SideWalls walls_;
};

// Observer of the mixing of big grains with all others, by samples of equal count.
class Mixing final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"lacey", "Lacey mixing index"}}, "1", "Lacey's mixing index: 0 segregated, 1 randomly mixed"},
            {{{"intensity", "intensity of segregation"}},
             "1",
             "intensity of segregation by Danckwerts, from the samples of `lacey`: 1 segregated, about "
             "1/32 randomly mixed"}};
    }
    static std::string why_empty(const Scene& scene, const std::string& column) {
        const std::string one_kind = without_two_kinds(scene);
        return one_kind.empty() && column == "lacey" ? with_few_of_a_kind(scene) : one_kind;
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return add_no_values(row, 2);
        const BigAndSmall kinds = big_and_small(m.scene.species);
        const Grains& grains = m.grains;
        std::vector<std::size_t> by_id(grains.size());
        std::iota(by_id.begin(), by_id.end(), std::size_t{0});
        std::sort(by_id.begin(), by_id.end(), [&](auto a, auto b) { return grains.id[a] < grains.id[b]; });
        std::vector<Vec3> position;
        std::vector<std::uint8_t> marked;
        for (const std::size_t i : by_id) {
            position.push_back(grains.place[i].position);
            marked.push_back(static_cast<std::size_t>(grains.species[i]) == kinds.big);
        }
        const Samples samples = take_samples(position, marked);
        row.insert(row.end(), {lacey_index(samples), intensity_of_segregation(samples)});
    }
};

// Observer of unlike neighbours: whether grains of different species are neighbours as often as by chance.
class Unlike final : public Observer {
  public:
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"unlike_neighbours", "unlike pairs / chance"}},
                 "1",
                 "pairs of neighbours of different species over what chance would give: 0 segregated, 1 "
                 "randomly mixed"}};
    }
    static std::string why_empty(const Scene& scene, const std::string&) { return without_two_kinds(scene); }
    void look(const ObservedState& m, std::vector<double>& row) override {
        if (!m.has_two_kinds()) return add_no_values(row, 1);
        const BigAndSmall kinds = big_and_small(m.scene.species);
        const double gap = kNeighbourGap * m.scene.species[kinds.small].diameter.mean;
        row.push_back(unlike_neighbours(m.grains.place, m.grains.species, gap, m.period));
    }
};

}  // namespace grainreel::observers
