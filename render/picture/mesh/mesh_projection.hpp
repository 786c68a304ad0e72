// Meshes as the camera sees them at one moment: triangles, solid or of glass, and the lines along their
// edges, in pixels and sorted into bands of rows. Hot code.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "engine/base/team.hpp"
#include "engine/state/pose.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/mesh/mesh_shape.hpp"
#include "render/picture/mesh/screen_setup.hpp"
#include "render/picture/spheres/light/wall_light.hpp"

namespace grainreel {

struct DrawnMesh {
    std::shared_ptr<const MeshShape> shape;
    BodyPose pose;
    // sRGB, 0 to 255: the colour of each triangle that shows a quantity. Triangles with numbers below 0 look
    // as plain walls do, and so do all triangles when this is null. Glass stays glass.
    const std::vector<std::array<float, 3>>* colours = nullptr;
    // The same for the corners of triangles that share their colours with those around them; triangles with
    // numbers below 0 have one colour.
    using CornerColours = std::array<std::array<float, 3>, 3>;
    const std::vector<CornerColours>* corners = nullptr;
};

// sRGB, 0 to 255.
struct MeshPaints {
    std::array<float, 3> dark, lit;  // solid walls that are turned away from the light and towards it
    std::array<float, 3> section;    // material that is cut open
    Vec3 up{0, 0, 1};                // unit, where the light of the sky comes from
    float pen = 1;                   // pixels, the width of a main line
};

// The surface where a cut opens the material of a mesh: the area inside an odd number of its outlines.
struct MeshSection {
    struct Edge {
        float x0, y0, x1, y1;  // pixels
    };
    std::vector<Edge> edges;
    ScreenPlane near;                    // px0 and py0 are 0
    std::uint32_t number = 0;            // as ScreenTriangle::number
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // pixels; high ends excluded
};

class MeshProjection {
  public:
    static constexpr int kBand = 16;  // rows

    void take(const View& view, const Sight& sight, const Cut& cut, const std::vector<DrawnMesh>& meshes,
              const MeshPaints& paints, Team& team);

    // The plane of a solid triangle. Numbers begin with 1.
    using Plane = SurfacePlane;
    const std::vector<Plane>& planes() const { return planes_; }
    const Plane& plane(std::uint32_t number) const { return planes_[number - 1]; }
    // For each band of rows, the numbers of the triangles and lines in it, rising.
    struct Band {
        std::vector<std::uint32_t> solid, glass, lines;
    };
    const std::vector<Band>& bands() const { return bands_; }
    const ScreenTriangle& solid(std::uint32_t i) const { return solid_[i]; }
    const ScreenTriangle& glass(std::uint32_t i) const { return glass_[i]; }
    const ScreenLine& line(std::uint32_t i) const { return lines_[i]; }
    const std::vector<MeshSection>& sections() const { return sections_; }
    std::uint32_t section_colour() const { return section_colour_; }  // as a pixel
    bool empty() const { return solid_.empty() && glass_.empty() && lines_.empty(); }

  private:
    using Face = MeshShape::Face;
    // A triangle as the eye sees it.
    struct Seen {
        Face face;
        bool front;
        float cosine;  // cosine of the angle between its normal and the line of sight; > 0
    };
    // The part of a mesh that one thread projects.
    struct Share {
        std::vector<ScreenTriangle> solid, glass;
        std::vector<Plane> planes;
        std::vector<ScreenLine> lines;
        std::array<std::vector<MeshSection::Edge>, 3> sections;  // one for each half-space
    };

    void take_mesh(const DrawnMesh& mesh, Team& team);
    void add_triangle(const DrawnMesh& mesh, std::size_t t, Share& share);
    void add_sections(std::vector<Share>& shares);
    void add_section_line(int half, const std::array<Eigen::Vector3f, 2>& ends, const Seen& seen,
                          bool material, Share& share) const;
    bool is_outline(const MeshShape& shape, const MeshShape::Edge& edge) const;
    float towards_eye(const MeshShape& shape, std::int32_t triangle, std::size_t corner) const;
    void add_piece(const DrawnMesh& mesh, std::size_t t, const Seen& seen, const Piece& piece, Share& share);
    void add_edge(const MeshShape& shape, const MeshShape::Edge& edge, Share& share) const;
    void join(std::vector<Share>& shares);
    void sort_into_bands();
    Seen look_at(const MeshShape& shape, std::size_t t) const;
    float lit(const Eigen::Vector3f& normal) const;

    // What take() was given last.
    Sight sight_;
    DrawnSpace space_;
    PortSize port_{1, 1};
    MeshPaints paints_;
    Eigen::Matrix3f turn_;  // turns directions of the mesh at hand from its place at rest into the view
    Eigen::Vector3f up_;    // where the light of the sky comes from, in the view
    std::vector<Eigen::Vector3f> vertices_;
    std::vector<char> whole_;  // for each vertex: whether it is within the drawn space
    std::vector<Seen> seen_;

    std::vector<ScreenTriangle> solid_, glass_;
    std::vector<Plane> planes_;
    std::vector<ScreenLine> lines_;
    std::vector<MeshSection> sections_;
    std::uint32_t section_colour_ = 0;
    std::vector<Band> bands_;
};

}  // namespace grainreel
