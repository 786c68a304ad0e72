// How a grain lies in the bed: its neighbours, the walls beside it, the surface above it.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/numbers.hpp"
#include "engine/measure/segregation/unlike_neighbours.hpp"
#include "engine/measure/surface/surface.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/questions/expressions/grain_columns.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

// Distance (m) from the grain's surface to the nearest of the faces for which `is_meant` is true.
template <class IsMeant>
std::vector<double> gaps_to_faces(const Snapshot& s, const GrainList& grains, const IsMeant& is_meant) {
    std::vector<Face> faces = faces_of(s.scene);
    std::erase_if(faces, [&](const Face& face) { return !is_meant(face); });
    std::vector<double> gaps;
    for (const std::size_t i : grains) {
        double least = std::numeric_limits<double>::infinity();
        for (const Face& face : faces) {
            const BodyPose pose = s.frame.body(static_cast<std::size_t>(face.body.number));
            const double gap =
                face.body.turns()
                    ? distance_to(face, Vec3(0, 0, 0), pose.at_rest(s.frame.position[i])).distance
                    : distance_to(face, pose.place, s.frame.position[i]).distance;
            least = std::min(least, gap);
        }
        gaps.push_back(std::isfinite(least) ? least - s.frame.radius[i] : kUnknown);
    }
    return gaps;
}

// Distance (m) from the grain's surface to the nearest mesh; infinite where none is within a hundred radii.
double gap_to_meshes(const Snapshot& s, std::size_t i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < s.scene.meshes.size(); ++m) {
        const std::size_t body = static_cast<std::size_t>(first_mesh_body(s.scene)) + m;
        const Vec3 place = s.frame.body(body).at_rest(s.frame.position[i]);
        std::optional<Surface::Nearest> nearest;
        for (double reach = 2; !nearest && reach < 200; reach *= 3)
            nearest = s.scene.meshes[m].surface->nearest(place, reach * s.frame.radius[i]);
        if (nearest) least = std::min(least, std::sqrt(nearest->point.squared) - s.frame.radius[i]);
    }
    return least;
}

std::vector<double> wall_gap(const Snapshot& s, const GrainList& grains) {
    std::vector<double> gaps = gaps_to_faces(s, grains, [](const Face&) { return true; });
    if (s.scene.meshes.empty()) return gaps;
    for (std::size_t k = 0; k < grains.size(); ++k) {
        const double gap = std::fmin(gaps[k], gap_to_meshes(s, grains[k]));
        gaps[k] = std::isfinite(gap) ? gap : kUnknown;
    }
    return gaps;
}

std::vector<double> side_gap(const Snapshot& s, const GrainList& grains) {
    return gaps_to_faces(s, grains, [](const Face& face) {
        return face.body.number == kContainerBody &&
               (face.kind == Face::Kind::cylinder || std::abs(face.normal.y()) > 1e-9);
    });
}

LargeArray<Place> places_of_all(const Snapshot& s) {
    LargeArray<Place> places;
    for (std::size_t i = 0; i < s.frame.size(); ++i)
        places.push_back({s.frame.position[i], s.frame.radius[i]});
    return places;
}

// Depth (m) below the surface, whose heights are those of the observer `bed_surface`.
std::vector<double> below_surface(const Snapshot& s, const GrainList& grains) {
    SurfaceAxes frame = surface_frame(s.scene);
    if (!(frame.right > frame.left) || s.frame.size() == 0)
        return std::vector<double>(grains.size(), kUnknown);
    const Vec3 offset = container_offset(s.scene, s.frame);
    LargeArray<Place> places = places_of_all(s);
    for (Place& one : places) one.position -= Vec3(offset.x(), offset.y(), 0);
    const BedOutline surface = surface_of(std::span<const Place>(places.data(), places.size()), frame);
    std::vector<double> depths;
    for (const std::size_t i : grains) {
        const double bin = std::floor((s.frame.position[i].y() - offset.y() - surface.left) / surface.bin);
        const double last = static_cast<double>(surface.height.size()) - 1;
        if (surface.height.empty()) {
            depths.push_back(kUnknown);
            continue;
        }
        const auto k = static_cast<std::size_t>(std::clamp(bin, 0.0, last));
        depths.push_back(surface.height[k] - s.frame.position[i].z());
    }
    return depths;
}

// Sums over a grain's neighbours.
struct Around {
    double all = 0, unlike = 0;
    double mass = 0;         // kg, with the grain's own mass
    Vec3 momentum{0, 0, 0};  // with the grain's own momentum
};

class AllAround {
  public:
    AllAround(const Snapshot& s, const GrainList& grains) : s_(s), around_(s.frame.size()) {
        for (const std::size_t i : grains) add_body(i, i);
        const double gap = gap_of_neighbours(s.scene), period = period_of_depth(s.scene.container);
        const LargeArray<Place> places = places_of_all(s);
        constexpr std::size_t few = 8;  // with fewer grains it is quicker to look at all
        if (grains.size() > few) {
            NeighbourPairs(places, gap, period).each([&](std::int32_t a, std::int32_t b) {
                add(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
                add(static_cast<std::size_t>(b), static_cast<std::size_t>(a));
            });
            return;
        }
        for (const std::size_t i : grains)
            for (std::size_t k = 0; k < places.size(); ++k)
                if (k != i && are_neighbours(places[static_cast<std::ptrdiff_t>(i)],
                                             places[static_cast<std::ptrdiff_t>(k)], gap, period))
                    add(i, k);
    }
    const Around& operator()(std::size_t grain) const { return around_[grain]; }

  private:
    void add_body(std::size_t to, std::size_t other) {
        around_[to].mass += s_.mass(other);
        around_[to].momentum += s_.mass(other) * s_.frame.velocity[other];
    }
    void add(std::size_t to, std::size_t other) {
        around_[to].all += 1;
        around_[to].unlike += s_.frame.species[to] != s_.frame.species[other];
        add_body(to, other);
    }

    const Snapshot& s_;
    std::vector<Around> around_;
};

template <class Value>
std::vector<double> from_around(const Snapshot& s, const GrainList& grains, const Value& value) {
    const AllAround around(s, grains);
    std::vector<double> values;
    for (const std::size_t i : grains) values.push_back(value(around(i), i));
    return values;
}

std::vector<double> neighbours(const Snapshot& s, const GrainList& grains) {
    return from_around(s, grains, [](const Around& of, std::size_t) { return of.all; });
}

std::vector<double> unlike_share(const Snapshot& s, const GrainList& grains) {
    return from_around(
        s, grains, [](const Around& of, std::size_t) { return of.all > 0 ? of.unlike / of.all : kUnknown; });
}

std::vector<double> fluctuation(const Snapshot& s, const GrainList& grains) {
    return from_around(s, grains, [&](const Around& of, std::size_t i) {
        return (s.frame.velocity[i] - of.momentum / of.mass).norm();
    });
}

}  // namespace

double gap_of_neighbours(const Scene& scene) {
    double least = std::numeric_limits<double>::infinity();
    for (const Species& one : scene.species) least = std::min(least, one.diameter.mean);
    return kNeighbourGap * least;
}

std::vector<GrainColumn> bed_columns() {
    using enum Dimension;
    return {
        {"wall_gap", length, "from its surface to the nearest wall; below 0 where they overlap", wall_gap},
        {"side_gap", length, "the same of side walls and slants alone", side_gap},
        {.name = "depth",
         .dimension = length,
         .about = "of the centre below the bed's surface above it",
         .of = below_surface,
         .costly = true},
        {.name = "neighbours",
         .dimension = number,
         .about = "grains closer than a quarter of the smallest species' diameter",
         .of = neighbours,
         .costly = true},
        {.name = "unlike_share",
         .dimension = number,
         .about = "share of other species among these",
         .of = unlike_share,
         .costly = true},
        {.name = "fluctuation",
         .dimension = speed,
         .about = "speed against the mean velocity of itself and these, by mass",
         .of = fluctuation,
         .needs = Needs::velocities,
         .costly = true},
    };
}

}  // namespace grainreel
