// The section of a surface with a level plane: segments, and the pieces of the plane between them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/surface.hpp"

namespace grainreel {

// Number of level lines. Each line has two rays, so there are sixteen level rays to all sides. Two of the
// lines lie along x and y.
inline constexpr int kLevelAxes = 8;
Vec3 level_direction(int i);  // unit; i from 0 to 2 kLevelAxes - 1

// A trapezoid between two segments of the section and two lines of constant x.
struct LevelPiece {
    double x0, x1;              // m
    std::array<double, 2> low;  // m, y of its lower side at x0 and x1
    std::array<double, 2> high;
    int winding;  // number of closed parts around it; a part that faces inwards counts -1

    double area() const { return 0.5 * (x1 - x0) * (high[0] - low[0] + high[1] - low[1]); }  // m2
    double x() const { return 0.5 * (x0 + x1); }
    double y() const { return 0.25 * (low[0] + low[1] + high[0] + high[1]); }
};

class LevelSection {
  public:
    // `closed` says for each triangle whether its connected part of the surface has an inside.
    LevelSection(const Surface& surface, const std::vector<char>& closed, double z);

    // Whether rays to all sides meet the section.
    bool encloses(double x, double y) const;
    // All enclosed pieces, by rising x. They are exact, except for rounding, if the section has at most 512
    // corners.
    std::vector<LevelPiece> enclosed_pieces() const;

  private:
    // A segment of the section. The inside of a closed part lies to its left.
    struct Segment {
        Eigen::Vector2d a, b;
        bool closed;
        double at(double x) const { return a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y()); }
    };
    // The segments, sorted into bins by their places across one axis.
    struct Axis {
        Eigen::Vector2d along, across;
        double first = 0, per_width = 0;
        std::vector<std::uint32_t> begins;
        std::vector<std::int32_t> segments;
    };
    void cut(const Surface& surface, std::int32_t triangle, bool closed, double z);
    void sort_across(Axis& axis, int number);
    std::vector<double> borders() const;
    void add_pieces(double x0, double x1, std::vector<const Segment*>& crossed,
                    std::vector<LevelPiece>& pieces) const;

    std::vector<Segment> segments_;
    std::array<Axis, kLevelAxes> axes_;
};

}  // namespace grainreel
