// Works out the sizes of a room from the level sections of its surface.
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/lists.hpp"
#include "engine/mesh/level_section.hpp"
#include "engine/mesh/mesh_edges.hpp"
#include "engine/mesh/room.hpp"

namespace grainreel {
namespace {

constexpr double slices_over_all = 64;
constexpr std::size_t most_borders = 64;
constexpr double same_height = 1e-9;  // as a share of the whole height
constexpr double fair_part = 0.2;     // as a share of the enclosed volume
constexpr int bisections = 40;
constexpr double wide_enough = 0.9;      // as a share of the largest area
constexpr std::size_t widest_tried = 8;  // levels, and places in each

// The part of a level section that has one winding number.
struct Part {
    double area = 0;
    Eigen::AlignedBox2d box;
    void add(const LevelPiece& piece) {
        area += piece.area();
        box.extend(Eigen::Vector2d(piece.x0, std::min(piece.low[0], piece.low[1])));
        box.extend(Eigen::Vector2d(piece.x1, std::max(piece.high[0], piece.high[1])));
    }
};

}  // namespace

struct EnclosedRoom::Level {
    double z;
    std::map<int, Part> parts;  // by winding number
};

class EnclosedRoom::Builder {
  public:
    explicit Builder(EnclosedRoom& room) : room_(room), surface_(*room.surface_) {}

    void build() {
        if (surface_.size() == 0) return;
        find_borders();
        for (std::size_t i = 0; i + 1 < borders_.size(); ++i) slice(borders_[i], borders_[i + 1]);
        choose_winding();
        keep_what_is_room();
        if (room_.slices_.empty()) return;
        add_up();
        find_widest();
        find_ends();
        const Vec3 &low = surface_.facts().low, &high = surface_.facts().high;
        room_.grid_ =
            RoomGrid(surface_, {Vec3(low.x(), low.y(), room_.base_), Vec3(high.x(), high.y(), room_.top_)},
                     [this](const Vec3& place) { return room_.holds_by_rays(place); });
    }

  private:
    struct Pair {
        double low, high;
        Level first, second;
    };

    // The area of a section is a polynomial of second order between the heights of two vertices, for which
    // Gauss's rule is exact. If there are more than 64 heights, only those at which the area jumps most are
    // taken.
    void find_borders() {
        const double low = surface_.facts().low.z(), high = surface_.facts().high.z();
        alike_ = same_height * (high - low);
        if (!(alike_ > 0)) return;
        borders_ = vertex_heights();
        if (borders_.size() > most_borders) borders_ = heights_of_largest_faces();
        std::erase_if(borders_, [&](double z) { return z < low + alike_ || z > high - alike_; });
        borders_.push_back(low);
        borders_.push_back(high);
        std::sort(borders_.begin(), borders_.end());
    }

    std::vector<double> vertex_heights() const {
        std::vector<double> heights;
        for (const Vec3& vertex : surface_.mesh().vertices) heights.push_back(vertex.z());
        std::sort(heights.begin(), heights.end());
        heights.erase(
            std::unique(heights.begin(), heights.end(), [&](double a, double b) { return b - a <= alike_; }),
            heights.end());
        return heights;
    }

    std::vector<double> heights_of_largest_faces() const {
        std::vector<std::pair<double, double>> faces;  // area, height
        for (const auto& [z, area] : level_faces()) faces.push_back({area, z});
        std::sort(faces.begin(), faces.end(), std::greater<>());
        std::vector<double> heights;
        for (std::size_t i = 0; i < std::min(faces.size(), most_borders); ++i)
            heights.push_back(faces[i].second);
        return heights;
    }

    // Areas (m2) of level triangles by height (m). Heights that are alike count as one.
    std::map<double, double> level_faces() const {
        std::map<double, double> areas;
        for (std::int32_t t = 0; t < surface_.size(); ++t) {
            const double a = surface_.corner(t, 0).z(), b = surface_.corner(t, 1).z(),
                         c = surface_.corner(t, 2).z();
            if (std::max({a, b, c}) - std::min({a, b, c}) > alike_) continue;
            auto place = areas.lower_bound(a - alike_);
            if (place == areas.end() || place->first > a + alike_) place = areas.emplace_hint(place, a, 0);
            place->second += surface_.area(t);
        }
        return areas;
    }

    void slice(double low, double high) {
        const double whole = borders_.back() - borders_.front();
        const auto count =
            static_cast<int>(std::max(1.0, std::round(slices_over_all * (high - low) / whole)));
        const double height = (high - low) / count;
        for (int i = 0; i < count; ++i) {
            const double bottom = low + i * height, top = i + 1 == count ? high : low + (i + 1) * height;
            const double middle = 0.5 * (bottom + top), away = 0.5 * (top - bottom) / std::sqrt(3.0);
            pairs_.push_back({bottom, top, level(middle - away), level(middle + away)});
        }
    }

    Level level(double z) const {
        Level level{z, {}};
        for (const LevelPiece& piece : LevelSection(surface_, room_.closed_, z).enclosed_pieces())
            level.parts[piece.winding].add(piece);
        return level;
    }

    void choose_winding() {
        std::map<int, double> volumes;
        double all = 0;
        for (const Pair& pair : pairs_)
            for (const Level* level : {&pair.first, &pair.second})
                for (const auto& [winding, part] : level->parts) {
                    volumes[winding] += part.area * (pair.high - pair.low);
                    all += part.area * (pair.high - pair.low);
                }
        const auto better = [&](const auto& a, const auto& b) {
            const bool fair_a = a.second >= fair_part * all, fair_b = b.second >= fair_part * all;
            if (fair_a != fair_b) return fair_a;
            if (fair_a && std::abs(a.first) != std::abs(b.first))
                return std::abs(a.first) < std::abs(b.first);
            return a.second > b.second;
        };
        const auto best = std::min_element(volumes.begin(), volumes.end(), better);
        if (best != volumes.end()) room_.winding_ = best->first;
    }

    const Part* part_of(const Level& level) const {
        const auto place = level.parts.find(room_.winding_);
        return place == level.parts.end() || !(place->second.area > 0) ? nullptr : &place->second;
    }

    void keep_what_is_room() {
        const auto empty = [&](const Pair& pair) {
            return part_of(pair.first) == nullptr && part_of(pair.second) == nullptr;
        };
        const auto first = std::find_if_not(pairs_.begin(), pairs_.end(), empty);
        const auto last = std::find_if_not(pairs_.rbegin(), pairs_.rend(), empty).base();
        for (auto pair = first; pair < last; ++pair) {
            Slice slice{pair->low, pair->high, {}, {}, {}};
            fill(
                slice.area, *pair, [](const Part& part) { return part.area; }, 0);
            fill(
                slice.half_width, *pair, [](const Part& part) { return 0.5 * part.box.sizes().y(); }, -1);
            fill(
                slice.half_depth, *pair, [](const Part& part) { return 0.5 * part.box.sizes().x(); }, -1);
            room_.slices_.push_back(slice);
        }
    }

    // Finds the place farthest from the surface among the middles of pieces in the wide levels.
    void find_widest() {
        std::vector<double> wide;
        double largest = 0;
        for (const Slice& slice : room_.slices_) largest = std::max(largest, slice.area.at_first);
        for (const Slice& slice : room_.slices_)
            if (slice.area.at_first >= wide_enough * largest) wide.push_back(0.5 * (slice.low + slice.high));
        double farthest = -1;
        for (std::size_t i = 0; i < widest_tried; ++i) {
            const double z = wide[i * (wide.size() - 1) / (widest_tried - 1)];
            std::vector<LevelPiece> pieces = LevelSection(surface_, room_.closed_, z).enclosed_pieces();
            std::erase_if(pieces, [&](const LevelPiece& piece) { return piece.winding != room_.winding_; });
            for (std::size_t k = 0; k < std::min(pieces.size(), widest_tried); ++k) {
                const LevelPiece& piece =
                    pieces[(2 * k + 1) * pieces.size() / (2 * std::min(pieces.size(), widest_tried))];
                const Vec3 place(piece.x(), piece.y(), z);
                const auto found = surface_.nearest(place, std::numeric_limits<double>::infinity());
                if (found && found->point.squared > farthest) {
                    farthest = found->point.squared;
                    room_.widest_ = place;
                }
            }
        }
        room_.open_above_ = !surface_.meets(room_.widest_, Vec3(0, 0, 1));
        room_.open_below_ = !surface_.meets(room_.widest_, Vec3(0, 0, -1));
    }

    // Fills a line from the sections at two heights. `missing` is used for a height without room. If it is
    // below zero, such a height takes the number of the other height.
    template <class Number>
    void fill(Line& line, const Pair& pair, Number&& number, double missing) const {
        const Part *const first = part_of(pair.first), *const second = part_of(pair.second);
        line.at_first = first ? number(*first) : missing;
        line.at_second = second ? number(*second) : missing;
        if (line.at_first < 0) line.at_first = std::max(0.0, line.at_second);
        if (line.at_second < 0) line.at_second = line.at_first;
    }

    void add_up() {
        double below = 0;
        for (Slice& slice : room_.slices_) {
            slice.volume = 0.5 * (slice.area.at_first + slice.area.at_second) * (slice.high - slice.low);
            slice.volume_below = below;
            below += slice.volume;
        }
    }

    // Finds the lowest and the highest level with room. They lie at the border of a slice, unless the nearest
    // section without room is in the same slice.
    void find_ends() {
        const Slice &first = room_.slices_.front(), &last = room_.slices_.back();
        room_.base_ = first.low;
        room_.top_ = last.high;
        const auto pair_at = [&](double low) {
            return std::find_if(pairs_.begin(), pairs_.end(),
                                [&](const Pair& pair) { return pair.low == low; });
        };
        const auto lowest = pair_at(first.low), highest = pair_at(last.low);
        if (part_of(lowest->first) == nullptr)
            room_.base_ = end_between(lowest->first.z, lowest->second.z);
        else if (lowest != pairs_.begin() && !is_border(first.low))
            room_.base_ = end_between(lowest[-1].second.z, lowest->first.z);
        if (part_of(highest->second) == nullptr)
            room_.top_ = end_between(highest->second.z, highest->first.z);
        else if (highest + 1 != pairs_.end() && !is_border(last.high))
            room_.top_ = end_between(highest[1].first.z, highest->second.z);
    }

    bool is_border(double z) const { return contains(borders_, z); }

    double end_between(double without, double with) const {
        for (int i = 0; i < bisections && std::abs(with - without) > alike_; ++i) {
            const double z = 0.5 * (with + without);
            const Level here = level(z);
            (part_of(here) == nullptr ? without : with) = z;
        }
        return with;
    }

    EnclosedRoom& room_;
    const Surface& surface_;
    double alike_ = 0;  // m, heights that differ by less are one
    std::vector<double> borders_;
    std::vector<Pair> pairs_;
};

EnclosedRoom::EnclosedRoom(std::shared_ptr<const Surface> surface)
    : surface_(std::move(surface)),
      closed_(in_closed_part(surface_->mesh())),
      any_closed_(contains(closed_, 1)) {
    Builder(*this).build();
}

}  // namespace grainreel
