#include "engine/step/geometry/patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/mathematics.hpp"
#include "engine/mesh/surface.hpp"

namespace grainreel {

namespace {

// Relative difference below which two squared distances count as distances from one point.
constexpr double kSame = 1e-10;
bool is_nearer(double one, double other) {
    return one < other * (1 - kSame);
}

// Returns 0 on a face, 1 on an edge, 2 at a corner.
int rank(Feature feature) {
    return feature == Feature::face ? 0 : feature < Feature::corner0 ? 1 : 2;
}
int edge_of(Feature feature) {
    return static_cast<int>(feature) - static_cast<int>(Feature::edge0);
}
int corner_of(Feature feature) {
    return static_cast<int>(feature) - static_cast<int>(Feature::corner0);
}

bool has_vertex(const TriangleMesh::Triangle& triangle, std::int32_t vertex) {
    return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

// Relative to a patch's distance: what is nearer to it than this does not lie before it.
constexpr double kTouching = 1e-9;

TouchedPlace touched_at(const Patch& patch) {
    return {patch.normal, patch.distance, patch.on_face};
}

bool is_before(const Patch& one, const Patch& other) {
    return one.distance != other.distance ? one.distance < other.distance : one.triangle < other.triangle;
}

}  // namespace

// Roundings in files leave the parts of one plane a little apart, so what lies a thousandth of the radius
// before a plane counts as lying in it.
bool stands_for(const TouchedPlace& nearer, const TouchedPlace& other, double radius) {
    static const double one_place = math::cos(kSmoothAngle);
    constexpr double kInPlane = 1e-3;
    const double cosine = nearer.normal.dot(other.normal);
    return cosine > one_place ||
           (nearer.on_face && cosine * other.distance > nearer.distance - kInPlane * radius);
}

void Patches::begin(const Surface& surface, const Vec3& centre, double radius) {
    surface_ = &surface;
    centre_ = centre;
    radius_ = radius;
    squared_reach_ = radius * radius;
    touching_.clear();
    patches_.clear();
}

// Where the nearest point is on the face, the distance from the plane is taken, which is exact and changes
// evenly as the grain moves.
void Patches::add(std::int32_t triangle) {
    NearestPoint nearest = surface_->nearest(triangle, centre_);
    const double plane = surface_->normal(triangle).dot(centre_ - surface_->corner(triangle, 0));
    if (nearest.feature == Feature::face) nearest.squared = plane * plane;
    if (nearest.squared < squared_reach_)
        touching_.push_back({triangle, static_cast<int>(touching_.size()), plane, nearest});
}

void Patches::find() {
    const int count = static_cast<int>(touching_.size());
    if (count == 0) return;
    if (count > 1) {
        std::sort(touching_.begin(), touching_.end(),
                  [](const Touching& a, const Touching& b) { return a.triangle < b.triangle; });
        for (int t = 0; t < count; ++t) touching_[t].group = t;
        for (int t = 0; t < count; ++t) join_over_edges(t);
    }
    if (are_one_group()) {
        const double least =
            std::min_element(touching_.begin(), touching_.end(), [](const Touching& a, const Touching& b) {
                return a.nearest.squared < b.nearest.squared;
            })->nearest.squared;
        int best = 0;
        for (int t = 1; t < count; ++t)
            if (comes_before(touching_[t], touching_[best], least)) best = t;
        if (is_minimum(best)) add_patch(0, best);
        return;
    }
    for (int t = 0; t < count; ++t) is_minimum(t);  // joins triangles that meet in their nearest point
    least_.assign(touching_.size(), std::numeric_limits<double>::infinity());
    best_.assign(touching_.size(), -1);
    for (int t = 0; t < count; ++t) {
        double& least = least_[group_of(t)];
        least = std::min(least, touching_[t].nearest.squared);
    }
    for (int t = 0; t < count; ++t) {
        const int group = group_of(t);
        int& best = best_[group];
        if (best < 0 || comes_before(touching_[t], touching_[best], least_[group])) best = t;
    }
    // Adds the patches by rising triangle.
    for (int t = 0; t < count; ++t)
        if (const int group = group_of(t); best_[group] == t && is_minimum(t)) add_patch(group, t);
    if (patches_.size() > 1) keep_those_that_count();
}

int Patches::holder_of(std::int32_t triangle) const {
    const int t = place_of(triangle);
    return t < 0 ? -1 : touching_[t].patch;
}

// Place of a triangle among the triangles that touch, or -1.
int Patches::place_of(std::int32_t triangle) const {
    const auto at =
        std::lower_bound(touching_.begin(), touching_.end(), triangle,
                         [](const Touching& t, std::int32_t number) { return t.triangle < number; });
    return at == touching_.end() || at->triangle != triangle ? -1 : static_cast<int>(at - touching_.begin());
}

int Patches::group_of(int t) {
    while (touching_[t].group != t) t = touching_[t].group = touching_[touching_[t].group].group;
    return t;
}

void Patches::join(int one, int other) {
    const int a = group_of(one), b = group_of(other);
    touching_[std::max(a, b)].group = std::min(a, b);
}

bool Patches::are_one_group() {
    for (int t = 1; t < static_cast<int>(touching_.size()); ++t)
        if (group_of(t) != 0) return false;
    return true;
}

void Patches::join_over_edges(int t) {
    for (int edge = 0; edge < 3; ++edge) {
        const std::int32_t next = surface_->neighbour(touching_[t].triangle, edge).triangle;
        if (next <= touching_[t].triangle) continue;  // no neighbour, or one that has been asked already
        if (const int other = place_of(next); other >= 0 && is_one_patch_over(t, edge, other)) join(t, other);
    }
}

// The nearer triangle decides on which side the centre lies, because the centre may see the other triangle
// only edge-on. If both have the same nearest point, the triangle from whose plane the centre is farther away
// decides.
bool Patches::is_one_patch_over(int t, int edge, int other) const {
    using Turn = Neighbour::Turn;
    const Touching &one = touching_[t], &two = touching_[other];
    const Neighbour* seen = &surface_->neighbour(one.triangle, edge);
    if (seen->turn == Turn::flat || seen->turn == Turn::smooth) return true;
    const bool first_is_nearer = is_nearer(one.nearest.squared, two.nearest.squared);
    const bool second_is_nearer = is_nearer(two.nearest.squared, one.nearest.squared);
    const bool from_second =
        second_is_nearer || (!first_is_nearer && std::abs(two.plane) > std::abs(one.plane));
    double side = one.plane;
    if (from_second) {
        side = two.plane;
        for (int e = 0; e < 3; ++e)
            if (surface_->neighbour(two.triangle, e).triangle == one.triangle)
                seen = &surface_->neighbour(two.triangle, e);
    }
    return (seen->turn == Turn::convex) == (side >= 0);
}

// Whether the distance to the surface has a minimum at a triangle's nearest point. All triangles that meet in
// this point, and so are as near, are joined with it.
bool Patches::is_minimum(int t) {
    const Feature feature = touching_[t].nearest.feature;
    if (feature == Feature::face || touching_.size() == 1) return true;
    const std::int32_t number = touching_[t].triangle;
    const double squared = touching_[t].nearest.squared;
    const bool at_edge = rank(feature) == 1;
    const int first = at_edge ? edge_of(feature) : corner_of(feature),
              second = (first + (at_edge ? 1 : 2)) % 3;
    // In most cases the triangle beyond the edge, or one beyond the two edges of the corner, is nearer.
    for (const int edge : {first, at_edge ? first : second}) {
        const std::int32_t next = surface_->neighbour(number, edge).triangle;
        const int other = next < 0 ? -1 : place_of(next);
        if (other >= 0 && is_nearer(touching_[other].nearest.squared, squared)) return false;
    }
    const TriangleMesh& mesh = surface_->mesh();
    const TriangleMesh::Triangle& own = mesh.triangles[number];
    const std::int32_t one = own[first];
    const std::int32_t two = at_edge ? own[(first + 1) % 3] : one;
    bool minimum = true;
    for (std::size_t o = 0; o < touching_.size(); ++o) {
        const TriangleMesh::Triangle& more = mesh.triangles[touching_[o].triangle];
        if (!has_vertex(more, one) || !has_vertex(more, two)) continue;
        if (is_nearer(touching_[o].nearest.squared, squared))
            minimum = false;
        else
            join(t, static_cast<int>(o));
    }
    return minimum;
}

// `least` is the least squared distance in their group, in m2.
bool Patches::comes_before(const Touching& one, const Touching& other, double least) const {
    constexpr double kEqual = 1e-12;
    const bool near = one.nearest.squared <= least * (1 + kEqual);
    const bool other_near = other.nearest.squared <= least * (1 + kEqual);
    if (near != other_near) return near;
    const int own = rank(one.nearest.feature), others = rank(other.nearest.feature);
    return near && (own != others ? own < others : one.triangle < other.triangle);
}

void Patches::add_patch(int group, int best) {
    const int number = static_cast<int>(patches_.size());
    for (int t = 0; t < static_cast<int>(touching_.size()); ++t)
        if (group_of(t) == group) touching_[t].patch = number;
    const Touching& t = touching_[best];
    const Vec3& normal = surface_->normal(t.triangle);
    Patch patch{t.triangle, t.nearest.at, t.plane > 0 ? Vec3(-normal) : normal, std::abs(t.plane),
                t.nearest.feature == Feature::face};
    if (!patch.on_face) {
        patch.distance = std::sqrt(t.nearest.squared);
        if (patch.distance > 0) patch.normal = (t.nearest.at - centre_) / patch.distance;
    }
    patches_.push_back(patch);
}

// Leaves out the patches that do not count. What is left out decides about others as what stays does, so that
// the answer changes evenly as the grain moves.
void Patches::keep_those_that_count() {
    const int count = static_cast<int>(patches_.size());
    heir_.resize(patches_.size());
    bool all = true;
    for (int p = 0; p < count; ++p) {
        const Patch& patch = patches_[p];
        heir_[p] = p;
        for (int o = 0; o < count; ++o) {
            const Patch& other = patches_[o];
            if (is_before(other, patch) && stands_for(touched_at(other), touched_at(patch), radius_) &&
                (heir_[p] == p || is_before(other, patches_[heir_[p]])))
                heir_[p] = o;
        }
        if (heir_[p] == p && !is_free(patch)) heir_[p] = -1;
        all = all && heir_[p] == p;
    }
    if (!all) renumber(heir_);
}

// Only a triangle whose plane lies between can stand in the way. In most corners there is none.
bool Patches::is_free(const Patch& patch) const {
    const double least = kTouching * patch.distance;
    const auto may_stand_between = [&](const Touching& t) {
        const double behind = surface_->normal(t.triangle).dot(patch.at - surface_->corner(t.triangle, 0));
        return t.plane > 0 ? behind < -least : t.plane < 0 && behind > least;
    };
    return !std::any_of(touching_.begin(), touching_.end(), may_stand_between) ||
           !surface_->meets(centre_, patch.normal, (1 - kTouching) * patch.distance);
}

// Closes the gaps of the patches that are left out, and hands their triangles to those that count.
void Patches::renumber(const std::vector<int>& heir) {
    std::vector<int> number(patches_.size(), -1);
    std::size_t kept = 0;
    for (std::size_t p = 0; p < patches_.size(); ++p)
        if (heir[p] == static_cast<int>(p)) {
            number[p] = static_cast<int>(kept);
            patches_[kept++] = patches_[p];
        }
    patches_.resize(kept);
    for (Touching& t : touching_) {
        while (t.patch >= 0 && heir[t.patch] != t.patch) t.patch = heir[t.patch];
        if (t.patch >= 0) t.patch = number[t.patch];
    }
}

void Patches::leave_out(std::int32_t triangle) {
    heir_.resize(patches_.size());
    for (std::size_t p = 0; p < patches_.size(); ++p)
        heir_[p] = patches_[p].triangle == triangle ? -1 : static_cast<int>(p);
    renumber(heir_);
}

}  // namespace grainreel
