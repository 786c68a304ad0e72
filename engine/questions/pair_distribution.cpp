#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/statistics.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {
namespace {

constexpr double farthest = 4;         // mean diameters
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

// Centres in cells, the grains of a cell one after the other. A cell is a part of the reach wide: with small
// cells fewer of the centres that are looked at are too far away.
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
    // In the order of the cells.
    const Vec3& place(std::size_t k) const { return at_[k]; }

    // look(k, distance) for each centre that is nearer to centre i than the reach, and comes after it.
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
    static constexpr int kParts = 3;  // cells, about, along the reach

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
    std::vector<std::size_t> start_;         // of each cell in at_, and one past the last
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
    std::vector<std::size_t> whole(near.size());  // bins of each centre that lie in the box all round
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
