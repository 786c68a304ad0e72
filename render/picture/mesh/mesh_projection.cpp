// Projects meshes: which sides and edges are seen, how they are lit, and where cuts open them. Hot code.
#include "render/picture/mesh/mesh_projection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/picture/spheres/light/lamp.hpp"

namespace grainreel {
namespace {

constexpr float kKeyShare = 0.62f;  // share of the key light on walls; the sky gives the rest

// The share of its strength that a colour keeps where the surface is turned away from the light. The colour
// must still be found on the colour bar.

// Widths of lines, as shares of a main line's width, and their strengths.
constexpr float kFeatureWidth = 0.8f, kOutlineWidth = 1;
constexpr float kSolidLine = 0.85f, kGlassLine = 0.42f, kOutline = 0.7f;
// An edge becomes an edge of glass while its last solid face turns edge-on. This is the sine of the angle
// over which it changes.
constexpr float kFade = 0.14f;

// The thickness of a pane, in panes seen straight on. A pane that is seen at a slant is thicker to the eye.
float panes_seen(float cosine) {
    const float slant = 1 - cosine;
    return 1 + 3 * slant * slant * slant;
}

float smooth(float share) {
    const float s = std::clamp(share, 0.0f, 1.0f);
    return s * s * (3 - 2 * s);
}

// The nearness of a plane's points, as a linear function of the pixel's place from (0, 0) on.
ScreenPlane nearness_of(const Sight& sight, const Eigen::Vector3f& normal, float distance) {
    const float per_pixel = 1 / sight.focal;
    const float x = normal.x() * per_pixel, y = -normal.y() * per_pixel;
    ScreenPlane plane;
    // In perspective 1/z = normal . (slopes, 1) / distance; else -z = (normal . (x, y, 0) - distance) /
    // normal.z.
    const float by = sight.orthographic ? normal.z() : distance;
    plane.x = x / by, plane.y = y / by;
    const float middle = (sight.orthographic ? -distance : normal.z()) / by;
    plane.at = middle - plane.x * sight.centre_x - plane.y * sight.centre_y;
    return plane;
}

}  // namespace

void MeshProjection::take(const View& view, const Sight& sight, const Cut& cut,
                          const std::vector<DrawnMesh>& meshes, const MeshPaints& paints, Team& team) {
    sight_ = sight;
    space_ = DrawnSpace::of(sight, cut, static_cast<float>(0.02 * view.nearest));
    port_ = {view.port.width, view.port.height};
    paints_ = paints;
    solid_.clear(), glass_.clear(), planes_.clear(), lines_.clear(), sections_.clear();
    section_colour_ = 0xff000000u;
    for (std::size_t c = 0; c < 3; ++c)
        section_colour_ |= static_cast<std::uint32_t>(std::lround(paints.section[c])) << (8 * c);
    Eigen::Matrix3d axes;
    axes << view.right.transpose(), view.up.transpose(), view.forward.transpose();
    up_ = (axes * paints.up).cast<float>();
    for (const DrawnMesh& mesh : meshes) {
        const Eigen::Matrix3d turn = axes * mesh.pose.rotation.toRotationMatrix();
        const Vec3 place = axes * (mesh.pose.place - view.eye);
        turn_ = turn.cast<float>();
        vertices_.resize(mesh.shape->vertices.size());
        whole_.resize(vertices_.size());
        team.run([&](int member) {
            const auto [begin, end] = TeamMember{team, member}.part_of(vertices_.size());
            for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
                vertices_[i] = (turn * mesh.shape->vertices[i] + place).cast<float>();
                whole_[i] = space_.holds(vertices_[i]);
            }
        });
        take_mesh(mesh, team);
    }
    sort_into_bands();
}

MeshProjection::Seen MeshProjection::look_at(const MeshShape& shape, std::size_t t) const {
    const Eigen::Vector3f normal = turn_ * shape.normals[t].cast<float>();
    const auto& [a, b, c] = shape.triangles[t];
    const Eigen::Vector3f middle = (vertices_[a] + vertices_[b] + vertices_[c]) / 3;
    // A corner decides the side, so that it changes just where the triangle is edge-on.
    const float height = sight_.orthographic ? normal.z() : normal.dot(vertices_[a]);
    const float length = sight_.orthographic ? 1 : std::max(middle.norm(), 1e-30f);
    const bool front = height < 0;
    const MeshShape::Sides& sides = shape.sides[t];
    return {front ? sides.front : sides.back, front, std::min(std::abs(height) / length, 1.0f)};
}

float MeshProjection::lit(const Eigen::Vector3f& normal) const {
    static const Lamp lamp;
    const float falls = normal.dot(Eigen::Vector3f(lamp.to_key[0], lamp.to_key[1], lamp.to_key[2]));
    return kKeyShare * std::max(0.0f, falls) + (1 - kKeyShare) * 0.5f * (1 + normal.dot(up_));
}

void MeshProjection::take_mesh(const DrawnMesh& mesh, Team& team) {
    const MeshShape& shape = *mesh.shape;
    seen_.resize(shape.triangles.size());
    std::vector<Share> shares(static_cast<std::size_t>(team.size()));
    team.run([&](int member) {
        const auto [begin, end] = TeamMember{team, member}.part_of(shape.triangles.size());
        for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
            seen_[t] = look_at(shape, t);
            add_triangle(mesh, t, shares[member]);
        }
    });
    team.run([&](int member) {
        const auto [begin, end] = TeamMember{team, member}.part_of(shape.edges.size());
        for (auto e = static_cast<std::size_t>(begin); e < static_cast<std::size_t>(end); ++e)
            add_edge(shape, shape.edges[e], shares[member]);
    });
    join(shares);
    add_sections(shares);
}

// Joins the shares in the order of the threads, which is also the order of the triangles.
void MeshProjection::join(std::vector<Share>& shares) {
    for (Share& share : shares) {
        const auto first = static_cast<std::uint32_t>(planes_.size());
        for (ScreenTriangle& t : share.solid) t.number += first;
        solid_.insert(solid_.end(), share.solid.begin(), share.solid.end());
        planes_.insert(planes_.end(), share.planes.begin(), share.planes.end());
        glass_.insert(glass_.end(), share.glass.begin(), share.glass.end());
        lines_.insert(lines_.end(), share.lines.begin(), share.lines.end());
    }
}

void MeshProjection::add_triangle(const DrawnMesh& mesh, std::size_t t, Share& share) {
    const Seen& seen = seen_[t];
    const MeshShape& shape = *mesh.shape;
    const int first_cut = sight_.orthographic ? 0 : 1;
    const bool material = shape.sides[t].front == Face::unseen || shape.sides[t].back == Face::unseen;
    if (seen.face == Face::unseen && (!material || space_.count == first_cut)) return;
    const float side = seen.front ? 1.0f : -1.0f;
    Piece piece;
    piece.count = 3;
    bool whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(shape.triangles[t][k]);
        piece.corner[k].at = vertices_[v];
        whole = whole && whole_[v];
        if (seen.face != Face::solid) continue;
        piece.corner[k].shade = lit(side * (turn_ * shape.corners[t][k]));
        if (mesh.corners) piece.corner[k].own = Eigen::Vector3f((*mesh.corners)[t][k].data());
    }
    for (int i = 0; !whole && i < space_.count && piece.count > 0; ++i) {
        std::array<Eigen::Vector3f, 2> ends;
        if (clip(space_.half[i], piece, &ends) && i >= first_cut)
            add_section_line(i, ends, seen, material, share);
    }
    if (piece.count >= 3 && seen.face != Face::unseen) add_piece(mesh, t, seen, piece, share);
}

// Adds the line where a cut goes through a triangle.
void MeshProjection::add_section_line(int half, const std::array<Eigen::Vector3f, 2>& ends, const Seen& seen,
                                      bool material, Share& share) const {
    ScreenLine line{};
    if (!set_up(sight_, space_, ends[0], ends[1], half, line)) return;
    line.half_width = 0.5f * kOutlineWidth * paints_.pen;
    line.glass = seen.face == Face::glass && !material;
    line.strength = kSolidLine;
    share.lines.push_back(line);
    if (material) share.sections[half].push_back({line.from.x(), line.from.y(), line.to.x(), line.to.y()});
}

// Adds the sections. They are seen from the side that the cut takes away.
void MeshProjection::add_sections(std::vector<Share>& shares) {
    for (int i = sight_.orthographic ? 0 : 1; i < space_.count; ++i) {
        MeshSection section;
        for (Share& share : shares) {
            const auto& edges = share.sections[i];
            section.edges.insert(section.edges.end(), edges.begin(), edges.end());
        }
        const Eigen::Vector3f normal = -space_.half[i].normal;
        const float distance = -space_.half[i].distance;
        const bool faces = sight_.orthographic ? normal.z() < 0 : distance < 0;
        if (section.edges.empty() || !faces) continue;
        float x0 = 1e9f, y0 = 1e9f, x1 = -1e9f, y1 = -1e9f;
        for (const MeshSection::Edge& e : section.edges) {
            x0 = std::min({x0, e.x0, e.x1}), x1 = std::max({x1, e.x0, e.x1});
            y0 = std::min({y0, e.y0, e.y1}), y1 = std::max({y1, e.y0, e.y1});
        }
        const auto pixel = [](float value, int size) {
            return static_cast<int>(std::clamp(std::floor(value), 0.0f, static_cast<float>(size)));
        };
        section.x0 = pixel(x0, port_.width), section.x1 = pixel(x1 + 1, port_.width);
        section.y0 = pixel(y0, port_.height), section.y1 = pixel(y1 + 1, port_.height);
        section.near = nearness_of(sight_, normal, distance);
        planes_.push_back({normal, distance});
        section.number = static_cast<std::uint32_t>(planes_.size());
        sections_.push_back(std::move(section));
    }
}

void MeshProjection::add_piece(const DrawnMesh& mesh, std::size_t t, const Seen& seen, const Piece& piece,
                               Share& share) {
    for (int k = 1; k + 1 < piece.count; ++k) {
        ScreenTriangle triangle;
        triangle.blended = piece.corner[0].own.x() >= 0 && mesh.corners && seen.face == Face::solid;
        if (!set_up(sight_, port_, piece.corner[0], piece.corner[k],
                    piece.corner[static_cast<std::size_t>(k) + 1], triangle))
            continue;
        if (seen.face == Face::glass) {
            triangle.tint = panes_seen(seen.cosine);
            share.glass.push_back(triangle);
            continue;
        }
        const std::array<float, 3>* own = mesh.colours ? &(*mesh.colours)[t] : nullptr;
        if (own && (*own)[0] < 0) own = nullptr;
        for (std::size_t c = 0; c < 3; ++c) {
            const float dark = own ? kDarkColour * (*own)[c] : paints_.dark[c];
            const float lit = own ? (*own)[c] : paints_.lit[c];
            triangle.colour[c] = dark;
            triangle.brighter[c] = lit - dark;
        }
        const Eigen::Vector3f normal =
            (seen.front ? 1.0f : -1.0f) * (turn_ * mesh.shape->normals[t].cast<float>());
        share.planes.push_back({normal, normal.dot(vertices_[mesh.shape->triangles[t][0]])});
        triangle.number = static_cast<std::uint32_t>(share.planes.size());
        share.solid.push_back(triangle);
    }
}

// A number that is above 0 where the front of the smooth surface faces the eye.
float MeshProjection::towards_eye(const MeshShape& shape, std::int32_t triangle, std::size_t corner) const {
    const auto t = static_cast<std::size_t>(triangle);
    const Eigen::Vector3f normal = turn_ * shape.corners[t][corner];
    if (sight_.orthographic) return -normal.z();
    return -normal.dot(vertices_[shape.triangles[t][corner]]);
}

// Whether the smooth surface turns away from the eye at an edge, and not only single triangles of it. The
// outline of a twisted surface goes through its triangles and not along their edges, so it has no line.
bool MeshProjection::is_outline(const MeshShape& shape, const MeshShape::Edge& edge) const {
    if (edge.right < 0 || edge.rippled) return false;
    if (seen_[edge.left].front == seen_[edge.right].front) return false;
    return towards_eye(shape, edge.left, edge.left_corner) *
               towards_eye(shape, edge.right, edge.right_corner) <
           0;
}

// Adds feature edges wherever a face at them is seen, and other edges where they are outlines.
void MeshProjection::add_edge(const MeshShape& shape, const MeshShape::Edge& edge, Share& share) const {
    const Seen& left = seen_[edge.left];
    const Seen* right = edge.right >= 0 ? &seen_[edge.right] : nullptr;
    if (left.face == Face::unseen && (!right || right->face == Face::unseen)) return;
    if (!edge.feature && !is_outline(shape, edge)) return;
    float turned = 0;  // cosine of the solid face that faces the eye most directly
    bool glass = true;
    for (const Seen* one : {&left, right}) {
        if (!one || one->face != Face::solid) continue;
        glass = false;
        turned = std::max(turned, one->cosine);
    }
    ScreenLine line{};
    if (!set_up(sight_, space_, vertices_[edge.from], vertices_[edge.to], -1, line)) return;
    line.glass = glass;
    line.half_width = 0.5f * paints_.pen * (edge.feature ? kFeatureWidth : kOutlineWidth);
    line.strength = edge.feature
                        ? kGlassLine + (glass ? 0 : smooth(turned / kFade) * (kSolidLine - kGlassLine))
                        : (glass ? kGlassLine : kOutline);
    share.lines.push_back(line);
}

void MeshProjection::sort_into_bands() {
    bands_.resize(static_cast<std::size_t>((port_.height + kBand - 1) / kBand));
    for (Band& band : bands_) band.solid.clear(), band.glass.clear(), band.lines.clear();
    const auto put = [&](std::vector<std::uint32_t> Band::*into, std::size_t i, int y0, int y1) {
        for (int band = y0 / kBand; band * kBand < y1; ++band)
            (bands_[band].*into).push_back(static_cast<std::uint32_t>(i));
    };
    for (std::size_t i = 0; i < solid_.size(); ++i) put(&Band::solid, i, solid_[i].y0, solid_[i].y1);
    for (std::size_t i = 0; i < glass_.size(); ++i) put(&Band::glass, i, glass_[i].y0, glass_[i].y1);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const ScreenLine& line = lines_[i];
        const float wide = line.half_width + 1;
        const float top = std::min(line.from.y(), line.to.y()) - wide,
                    bottom = std::max(line.from.y(), line.to.y()) + wide;
        if (!(bottom > 0) || !(top < static_cast<float>(port_.height))) continue;
        put(&Band::lines, i, static_cast<int>(std::max(top, 0.0f)),
            static_cast<int>(std::min(bottom, static_cast<float>(port_.height - 1))) + 1);
    }
}

}  // namespace grainreel
