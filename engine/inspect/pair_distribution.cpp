#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/nearest_image.hpp"
#include "engine/inspect/questions.hpp"
#include "engine/inspect/statistics.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {
namespace {

constexpr double reach = 4;            // mean diameters
constexpr std::size_t bin_count = 80;  // up to there

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

// m, to the nearest face of the box; a periodic depth has none.
double room_about(const Vec3& at, const Box& box, double period) {
    double room =
        std::min({at.y() - box.low.y(), box.high.y() - at.y(), at.z() - box.low.z(), box.high.z() - at.z()});
    if (period == 0) room = std::min({room, at.x() - box.low.x(), box.high.x() - at.x()});
    return room;
}

// Grains in cells as wide as the reach.
class Neighbourhood {
  public:
    Neighbourhood(const Snapshot& s, const Box& box, double width, double period)
        : frame_(s.frame), low_(box.low), width_(width), period_(period) {
        columns_ = std::max(1, static_cast<int>(period / width));
        for (std::size_t i = 0; i < frame_.size(); ++i) cells_[cell_of(frame_.position[i])].push_back(i);
    }

    // look(distance) for each grain that is nearer to grain i than the width.
    template <class Look>
    void around(std::size_t i, const Look& look) const {
        const Cell here = cell_of(frame_.position[i]);
        for (const int x : along_depth(here[0]))
            for (int y = here[1] - 1; y <= here[1] + 1; ++y)
                for (int z = here[2] - 1; z <= here[2] + 1; ++z) {
                    const auto found = cells_.find({x, y, z});
                    if (found == cells_.end()) continue;
                    for (const std::size_t k : found->second) {
                        Vec3 apart = frame_.position[k] - frame_.position[i];
                        apart.x() = nearest_image(apart.x(), period_);
                        if (k != i && apart.norm() < width_) look(apart.norm());
                    }
                }
    }

  private:
    using Cell = std::array<int, 3>;

    Cell cell_of(const Vec3& at) const {
        const Vec3 place = (at - low_) / width_;
        Cell cell{};
        for (int k = 0; k < 3; ++k) cell[k] = static_cast<int>(std::floor(place[k]));
        if (period_ > 0) {
            const double wide = period_ / columns_;
            cell[0] = static_cast<int>(std::floor((at.x() - low_.x()) / wide));
            cell[0] = ((cell[0] % columns_) + columns_) % columns_;
        }
        return cell;
    }

    // Each column once, also where there are fewer than three round the period.
    std::vector<int> along_depth(int x) const {
        if (period_ == 0) return {x - 1, x, x + 1};
        std::vector<int> columns;
        for (int k = x - 1; k <= x + 1; ++k) columns.push_back((k + columns_) % columns_);
        std::sort(columns.begin(), columns.end());
        columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
        return columns;
    }

    const Frame& frame_;
    Vec3 low_;
    double width_, period_;
    int columns_ = 1;  // of cells round a periodic depth
    std::map<Cell, std::vector<std::size_t>> cells_;
};

}  // namespace

Answer pair_distribution_answer(const Snapshot& s) {
    if (s.frame.size() < 2) throw UserError("there are fewer than two grains at this moment");
    const double diameter = [&] {
        double sum = 0;
        for (const double radius : s.frame.radius) sum += 2 * radius;
        return sum / static_cast<double>(s.frame.size());
    }();
    const double period = period_of_depth(s.scene.container);
    const double most = reach * diameter, width = most / static_cast<double>(bin_count);
    const Box box = box_of(s, period);
    const double volume = (box.high - box.low).prod();
    if (!(volume > 0))
        throw UserError("the grains lie in one plane; the distribution needs a bed of some depth");
    const double density = static_cast<double>(s.frame.size()) / volume;
    const Neighbourhood near(s, box, most, period);
    std::vector<double> pairs(bin_count, 0), centres(bin_count, 0);
    for (std::size_t i = 0; i < s.frame.size(); ++i) {
        const double room = room_about(s.frame.position[i], box, period);
        const auto whole = static_cast<std::size_t>(std::clamp(room / width, 0.0, double(bin_count)));
        if (whole == 0) continue;
        for (std::size_t k = 0; k < whole; ++k) ++centres[k];
        near.around(i, [&](double distance) {
            const auto k = static_cast<std::size_t>(distance / width);
            if (k < whole) ++pairs[k];
        });
    }
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
