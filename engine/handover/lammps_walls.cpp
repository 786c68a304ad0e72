#include "engine/handover/decks.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace grainreel {

namespace {

constexpr double kEndless = 1000;   // m: as far as a cylinder goes, so that no grain sees its ends
constexpr double kThickness = 0.5;  // of a plate, over the smallest radius

std::string word(const std::string& name, std::size_t number) {
    std::string word = fmt::format("w{}_", number);
    for (const char c : name) word += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return word;
}

class Regions {
  public:
    Regions(const CarriedScene& carried, bool opened)
        : carried_(carried), faces_(opened ? carried.opened : carried.faces) {
        double smallest = INFINITY;
        for (const CarriedType& type : carried.types) smallest = std::min(smallest, type.smallest / 2);
        thick_ = kThickness * smallest;
    }

    std::vector<LammpsRegion> all() {
        for (std::size_t f = 0; f < faces_.size(); ++f) add_face(f);
        return std::move(regions_);
    }

  private:
    void add_face(std::size_t f) {
        const Face& face = faces_[f];
        const std::string name = word(face.name, f);
        if (face.kind == Face::Kind::cylinder)
            return add(f, name,
                       fmt::format("cylinder z {} {} {} {} {} side in", face.point.x(), face.point.y(),
                                   face.radius, -kEndless, kEndless));
        if (face.ends && face.gap > 0) return add_slot(f, name);
        if (face.ends && face.normal.z() > 0 && face.normal.y() != 0) return add_slant(f, name);
        // Walls that end go on below: what falls through the slot does not reach them.
        add(f, name, fmt::format("plane {} {} side in", three(face.point), three(face.normal)));
    }
    // A floor with a slot along x: a thin block to each side. A wide gap leaves none.
    void add_slot(std::size_t f, const std::string& name) {
        const double half = carried_.scene.container.floor_half_width(), gap = faces_[f].gap;
        if (gap >= half) return;
        const double x = beyond();
        for (const double side : {-1.0, 1.0})
            add(f, fmt::format("{}_{}_open", name, side < 0 ? "left" : "right"),
                fmt::format("block {} {} {} {} {} 0.0 side out", -x, x, std::min(side * gap, side * half),
                            std::max(side * gap, side * half), -thick_));
    }
    // A slant that ends at the floor: a prism, sheared along y.
    void add_slant(std::size_t f, const std::string& name) {
        const Container& c = carried_.scene.container;
        const double x = beyond(), foot = c.floor_half_width(), out = c.half_width - foot;
        const bool left = faces_[f].normal.y() > 0;
        add(f, name + "_open",
            fmt::format("prism {} {} {} {} 0.0 {} 0.0 0.0 {} side out", -x, x,
                        left ? -foot - 2 * thick_ : foot, left ? -foot : foot + 2 * thick_, c.slant_height,
                        left ? -out : out));
    }
    double beyond() const { return carried_.scene.container.depth; }  // m, farther than the container

    void add(std::size_t f, const std::string& name, const std::string& shape) {
        LammpsRegion region{name, {}, {}};
        region.text = fmt::format("region {} {} units box{}", name, shape, motion(f, region.variables));
        regions_.push_back(region);
    }
    std::string motion(std::size_t f, std::vector<std::string>& variables) const {
        const Body& body = faces_[f].body;
        const bool driven = body.driven && !carried_.drive.empty() && !carried_.rides();
        std::string text;
        if (driven || !body.velocity.isZero(0)) {
            text += " move";
            for (int axis = 0; axis < 3; ++axis) {
                const double along = driven ? carried_.drive.direction[axis] : 0, speed = body.velocity[axis];
                if (along == 0 && speed == 0) {
                    text += " NULL";
                    continue;
                }
                std::string way;
                if (along != 0) way = fmt::format("{}*v_shift", peer_number(along));
                if (speed != 0) way += fmt::format("{}{}*v_t", way.empty() ? "" : "+", peer_number(speed));
                const std::string variable = fmt::format("move{}{}", f, "xyz"[axis]);
                variables.push_back(fmt::format("variable {} equal {}", variable, way));
                text += " v_" + variable;
            }
        }
        if (body.turn && !carried_.turns[f].empty())
            text +=
                fmt::format(" rotate v_angle{} {} {}", f, three(body.turn->through), three(body.turn->axis));
        return text;
    }

    const CarriedScene& carried_;
    const std::vector<Face>& faces_;
    double thick_ = 0;  // m
    std::vector<LammpsRegion> regions_;
};

}  // namespace

std::vector<LammpsRegion> lammps_regions(const CarriedScene& carried, bool opened) {
    return Regions(carried, opened).all();
}

std::vector<LammpsRegion> lammps_exits(const CarriedScene& carried) {
    std::vector<LammpsRegion> all;
    const auto add = [&](const std::string& shape) {
        const std::string name = fmt::format("exit{}", all.size());
        all.push_back({name, fmt::format("region {} {} units box", name, shape), {}});
    };
    for (const ExitBox& exit : carried.scene.exits)
        add(fmt::format("block {} {} {} {} {} {} side {}", exit.low.x(), exit.high.x(), exit.low.y(),
                        exit.high.y(), exit.low.z(), exit.high.z(), exit.outside ? "out" : "in"));
    if (const auto& outlet = carried.scene.container.outlet; outlet && !carried.scene.container.tray)
        add(fmt::format("block INF INF INF INF INF {} side in", -outlet->exit_depth));
    return all;
}

}  // namespace grainreel
