#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/statistics.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {
namespace {

struct Way {
    std::size_t grain = 0;  // of the later frame
    Vec3 moved{0, 0, 0};    // m, in the container's frame
};

std::vector<Way> ways_between(const Snapshot& before, const Snapshot& after) {
    const double period = period_of_depth(after.scene.container);
    const Vec3 carried =
        container_offset(after.scene, after.frame) - container_offset(before.scene, before.frame);
    std::vector<Way> ways;
    for (std::size_t i = 0; i < after.frame.size(); ++i) {
        const auto then = before.place_of(after.frame.id[i]);
        if (!then) continue;
        Vec3 moved = after.frame.position[i] - before.frame.position[*then] - carried;
        if (std::abs(moved.x()) < 1.5 * period) moved.x() = nearest_image(moved.x(), period);
        ways.push_back({i, moved});
    }
    return ways;
}

AnswerTable statistics_table(const Snapshot& after, const std::vector<Way>& ways) {
    AnswerTable table{"ways",
                      "Ways of the grains in the container's frame",
                      {{"species", Dimension::number},
                       {"grains", Dimension::number, "that are there at both moments"},
                       {"mean", Dimension::length},
                       {"most", Dimension::length},
                       {"mean_up", Dimension::length},
                       {"deviation_up", Dimension::length, "standard deviation of the sample"}},
                      {}};
    for (std::size_t k = 0; k < after.scene.species.size(); ++k) {
        std::vector<double> length, up;
        for (const Way& way : ways) {
            if (static_cast<std::size_t>(after.frame.species[way.grain]) != k) continue;
            length.push_back(way.moved.norm());
            up.push_back(way.moved.z());
        }
        const Statistics lengths = statistics_of(length), ups = statistics_of(up);
        table.rows.push_back({after.scene.species[k].name, static_cast<std::int64_t>(lengths.count),
                              lengths.mean, lengths.most, ups.mean, ups.deviation});
    }
    return table;
}

}  // namespace

Answer compare_answer(const Snapshot& before, const Snapshot& after, std::size_t most) {
    std::vector<Way> ways = ways_between(before, after);
    if (ways.empty()) throw UserError("no grain is there at both moments");
    Answer answer{{statistics_table(after, ways)}, {}};
    std::stable_sort(ways.begin(), ways.end(),
                     [](const Way& a, const Way& b) { return a.moved.norm() > b.moved.norm(); });
    AnswerTable list{"moved_most",
                     fmt::format("The {} that moved most", std::min(most, ways.size())),
                     {{"id", Dimension::number},
                      {"species", Dimension::number},
                      {"way", Dimension::length},
                      {"up", Dimension::length},
                      {"height", Dimension::length, "at the later moment"}},
                     {}};
    for (std::size_t k = 0; k < std::min(most, ways.size()); ++k) {
        const std::size_t i = ways[k].grain;
        list.rows.push_back({static_cast<std::int64_t>(after.frame.id[i]),
                             name_of_body(after, after.frame.id[i]), ways[k].moved.norm(), ways[k].moved.z(),
                             after.height(i)});
    }
    if (!list.rows.empty()) answer.tables.push_back(std::move(list));
    return answer;
}

}  // namespace grainreel
